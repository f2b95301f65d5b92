// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/landmarks/FeatureSpacing.h"
#include "tracking/tracks/RelocationSchedule.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// Updates, weighs and proposes tracks by features alone, in a map without a dense field. Works on
/// the tracks of a `HypothesisTracker`, which calls it.
/// \cite algorithm section 10
class LandmarkTracker
{
 public:
  /// The matcher must have a feature verifier.
  LandmarkTracker(std::shared_ptr<const SignatureMatcher> matcher, const TrackerOptions& options);

  /// Adds the scan of a step, before the tracks are predicted. Returns false when no feature is of
  /// a type that the map has; such a step can only predict. Eq. (8.12)
  bool addScan(TrackSet& set, const std::optional<MotionIncrement>& motion,
               const ObservedScene& scene);

  /// Pairs the features with the map at each track, after `travelled` [m] in all. Ambiguous tracks
  /// split, and the new ones take their ids from `next_id`. Eq. (8.13) to (8.15)
  void update(TrackSet& set, double travelled, std::uint64_t& next_id);

  /// Weighs tracks by their log-odds, `travel` [m] after the step before, and confirms them by
  /// features that are new to them. Eq. (8.16) to (8.18)
  void weigh(TrackSet& set, double travel) const;

  /// Relocates with a local map of the last steps or, once the belief is `settled`, with the
  /// present step alone. The schedule tells how far it counts as new evidence. Returns false where
  /// it gives no answer. Eq. (8.9), (8.19)
  bool relocate(TrackSet& set, RelocationSchedule& schedule,
                const std::optional<PoseRegion>& region, bool settled, std::uint64_t& next_id);

  /// Stores the present step for later local maps.
  void remember();

  /// True when clutter has lately explained the features much better than the track. Eq. (8.20)
  static bool doubts(const Track& track);

  /// True when the present step has enough features for the verdict *not here*.
  bool seesEnoughToTell() const;

  /// Share of the features seen that the track pairs, in [0, 1].
  double reliabilityOf(const Track& track) const;

 private:
  struct Step
  {
    MotionIncrement motion;  // since the step before
    std::vector<Feature> features;
  };
  std::vector<Feature> gathered() const;
  RelocationResult localize(const std::optional<PoseRegion>& region, bool settled) const;
  void weighNewTracksAgainstOlder(TrackSet& set) const;
  Track startAt(const Candidate& candidate, std::uint64_t id) const;

  std::shared_ptr<const SignatureMatcher> matcher_;
  TrackerOptions options_;
  FeatureSpacing spacing_;
  std::vector<bool> mapped_types_;
  bool gathers_ = true;  // the map has no walls, so local maps of several steps are used
  std::vector<Feature> seen_;  // in the present step, of the types that the map has
  std::deque<Step> recent_;
  MotionIncrement since_recent_;  // since the last of `recent_`
  bool doubted_ = false;  // the heaviest track was suspicious in the step before
};
}  // namespace sigloc
