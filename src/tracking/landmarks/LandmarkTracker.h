// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// How tracks are updated, weighed and proposed in a map that no dense field backs: by the features
/// alone. Works on the tracks of a `HypothesisTracker`, which decides when.
/// \cite algorithm section 8, "By features alone"
class LandmarkTracker
{
 public:
  /// The matcher has a feature verifier.
  LandmarkTracker(std::shared_ptr<const SignatureMatcher> matcher, const TrackerOptions& options);

  /// Takes in a step, before the tracks are moved on. False when nothing seen is of a kind that the
  /// map holds: the step can only predict.
  bool addScan(TrackSet& set, const std::optional<MotionIncrement>& motion,
               const ObservedScene& scene);

  /// Pairs what was seen with the map at each track; ambiguous tracks split. Eq. (8.12) to (8.15)
  void update(TrackSet& set, double travelled, std::uint64_t& next_id);

  /// Weighs tracks by their log-odds and confirms them by what is new to them. Eq. (8.16) to (8.18)
  void weigh(TrackSet& set, double travel) const;

  /// Looks for places that no track holds, in a local map of the last steps or, once the belief is
  /// settled, in the present one. Returns false where too little is seen for an answer.
  /// Eq. (8.9), (8.19)
  bool relocate(TrackSet& set, const std::optional<PoseRegion>& region, double fresh_share,
                bool settled, std::uint64_t& next_id);

  /// Keeps the present step for local maps to come.
  void remember();

  /// True when clutter has explained what was lately seen better than the track does. Eq. (8.20)
  static bool doubts(const Track& track);

  /// True when what is seen now speaks against the track, if not enough to doubt it.
  static bool contradicts(const Track& track);

  /// False while what was seen lately is too little to tell that the robot is not here.
  bool seesEnoughToTell() const;

  /// Share of what was seen that the track pairs, in [0, 1].
  double reliabilityOf(const Track& track) const;

 private:
  struct Step
  {
    MotionIncrement motion;  // since the step before
    std::vector<Feature> features;
  };
  std::vector<Feature> gathered() const;
  RelocationResult localize(const std::optional<PoseRegion>& region, bool settled) const;
  void weighElsewhere(TrackSet& set, const RelocationResult& result, double fresh_share) const;
  Track startAt(const Candidate& candidate, std::uint64_t id) const;

  std::shared_ptr<const SignatureMatcher> matcher_;
  TrackerOptions options_;
  std::vector<bool> mapped_types_;
  bool gathers_ = true;  // the map holds places, which a local map can gather
  std::vector<Feature> seen_;  // in the present step, of the kinds that the map holds
  std::deque<Step> recent_;
  MotionIncrement since_recent_;  // since the last of `recent_`
  bool doubted_ = false;  // in the step before
};
}  // namespace sigloc
