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
/// One pose hypothesis that is being tracked.
struct TrackedHypothesis
{
  GaussianPose pose;  ///< map_from_robot
  double weight = 0;  ///< probability, in [0, 1]
  std::uint64_t id = 0;  ///< the same from step to step; merged tracks keep the older id
  std::uint32_t age = 0;  ///< steps since it was proposed
};

/// What speaks for a hypothesis being in this map at all. \cite algorithm section 8, "Publish"
struct InMapEvidence
{
  double relocations = 0;  ///< kappa, log-odds from relocations, eq. (8.7)
  double way = 0;  ///< gamma, log-odds from what came into view on the way, eq. (8.21)
  double unexplained = 0;  ///< share of the mapped area seen that is off all walls, in [0, 1]
  double cells = 0;  ///< mapped area seen [cells of 0.5 m]
  double followed = 0;  ///< [m] driven since it was proposed
  double searched = 0;  ///< [m] driven unlocalized before it was proposed
  double score = 0;  ///< of the last scan, in about [-1, 1]
};

/// Where the robot may be after a step: weighted Gaussian poses, heaviest first, and the weight of
/// "somewhere else". All weights sum to one.
struct Belief
{
  std::vector<TrackedHypothesis> hypotheses;
  double elsewhere = 1;  ///< probability that the robot is at none of the hypotheses, in [0, 1]
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;  ///< of the verdict's claim, in [0, 1]
  /// How well the first hypothesis explains the latest scan with enough returns, in [0, 1].
  /// \cite algorithm eq. (8.11)
  double reliability = 0;
  std::string reason;  ///< one line for people: why lost, which rivals remain

  /// Probability of the first hypothesis, whatever the verdict; 0 where there is none.
  double probabilityOfFirst() const { return hypotheses.empty() ? 0 : hypotheses.front().weight; }
};
}  // namespace sigloc
