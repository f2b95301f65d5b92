// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "sigloc/matching/SignatureMatcher.h"
#include "tracking/tracks/RelocationSchedule.h"
#include "tracking/tracks/ScanHistory.h"
#include "tracking/tracks/TrackSet.h"

namespace sigloc
{
/// What a relocation searches with. The references must outlive it.
struct RelocationInput
{
  const SignatureMatcher& matcher;
  const ObservedScene& scene;
  const DenseScan& scan;  ///< of the scene
  std::optional<PoseRegion> region;  ///< that the search is limited to, if any
  bool moved;  ///< since the scan before
};

/// Relocates tracks in a map with a dense field. A relocation does not depend on the tracks. So it
/// is evidence for a track, may overrule all of them, and starts tracks at poses without one.
/// \cite algorithm section 8, "Relocate"
class DenseRelocation
{
 public:
  explicit DenseRelocation(const TrackerOptions& options) : past_(options) {}

  /// Goes on by one step.
  void move(const std::optional<MotionIncrement>& motion) { past_.move(motion); }

  /// Stores a scan, taken after `travelled` [m] in all.
  void remember(const DenseScan& scan, double travelled) { past_.remember(scan, travelled); }

  /// Relocates. Returns false where that gives no answer. New tracks take the ids from `next_id`
  /// on. Eq. (8.7), (8.9), (8.24)
  bool run(TrackSet& set, RelocationSchedule& schedule, const RelocationInput& input,
           std::uint64_t& next_id) const;

 private:
  ScanHistory past_;
};
}  // namespace sigloc
