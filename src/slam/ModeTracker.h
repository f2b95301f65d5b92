// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/TrackerOptions.h"
#include "slam/particle_modes.h"
#include "tracking/DenseRelocation.h"
#include "tracking/tracks/RelocationSchedule.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// The modes of a particle filter as tracks. Their poses and weights are the particles'; what
/// speaks for being in the map, when to relocate and what to claim is as for the tracks of
/// HypothesisTracker. \cite algorithm section 9
class ModeTracker
{
 public:
  explicit ModeTracker(const TrackerOptions& options)
      : options_(options), set_(options), relocation_(options), schedule_(options)
  {
  }

  /// Forgets all modes. A pose that is `known` waits for its first relocation.
  void forget(bool known);

  /// Moves the modes as the robot moved. Returns the same as TrackSet::predict(). Eq. (8.2)
  Travel predict(const std::optional<MotionIncrement>& motion);

  /// Takes the modes of the particles. One within 0.75 m and 20 degrees of a mode before keeps its
  /// identity and evidence.
  void gather(const std::vector<ParticleMode>& modes, const SignatureMatcher& matcher);

  /// Judges the modes by a scan that is not blind. Relocates where that is due, within a region if
  /// one is given, and returns whether it did. Eq. (8.21)
  bool judge(const ObservedScene& scene, const SignatureMatcher& matcher,
             const std::optional<PoseRegion>& region);

  /// The poses that the last step's relocation has started, and their shares of the weight of all
  /// modes.
  std::vector<ParticleMode> started() const;

  /// The belief of the modes. \cite algorithm section 8, "Publish"
  Belief publish(const SignatureMatcher& matcher, bool blind);

 private:
  bool relocateByFeatures(const ObservedScene& scene, const SignatureMatcher& matcher,
                          const std::optional<PoseRegion>& region);

  TrackerOptions options_;
  TrackSet set_;
  DenseRelocation relocation_;
  RelocationSchedule schedule_;
  std::uint64_t next_id_ = 1;
};
}  // namespace sigloc
