// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/RelocationResult.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sigloc
{
/// One pose hypothesis that is being followed.
struct TrackedHypothesis
{
  GaussianPose pose;  ///< map_from_robot
  double weight = 0;  ///< probability
  std::uint64_t id = 0;  ///< stays with the track while it lives; merged tracks keep the older id
  std::uint32_t age = 0;  ///< steps since it was proposed
};

/// What is known of the robot's place after a step: weighted Gaussians, heaviest first, and the
/// weight of "somewhere else"; all weights sum to one.
struct Belief
{
  std::vector<TrackedHypothesis> hypotheses;
  double elsewhere = 1;
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;  ///< of the verdict's claim
  /// In [0, 1]: how well the first hypothesis explains the latest look at enough to tell.
  double reliability = 0;
  std::string reason;  ///< one line for people: why lost, which rivals remain
};
}  // namespace sigloc
