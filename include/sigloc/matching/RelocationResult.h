// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// From this probability on a pose is claimed.
constexpr double kLocalizedProbability = 0.99;

/// What is claimed about the robot's place.
enum class Verdict : std::uint8_t
{
  localized = 0,  ///< one pose holds with probability >= 0.99
  ambiguous = 1,  ///< several poses, or a line of poses, explain what is seen
  not_here = 2,  ///< nothing in the map explains what is seen
  too_little_seen = 3,  ///< too few returns or features to tell anything
};

/// "localized", "ambiguous", "not here", "too little seen".
const char* toString(Verdict verdict);

/// Observed feature `observed` is taken to be map feature `mapped` (indices).
struct FeaturePairing
{
  std::uint32_t observed = 0;
  std::uint32_t mapped = 0;
};

/// What generating and verifying cost, in operations; times never enter results.
struct MatchingCounters
{
  std::uint64_t signature_pairs = 0;  ///< (observed, mapped) signatures compared
  std::uint64_t hypotheses = 0;  ///< base pairings turned into a pose
  std::uint64_t checks = 0;  ///< location-dependent checks of a pairing at a pose
  std::uint64_t poses_scored = 0;  ///< poses looked up in the dense field
  std::uint64_t cut_short = 0;  ///< searches that ended at their budget, unfinished
};

/// A place the robot could be at.
struct Candidate
{
  GaussianPose pose;  ///< map_from_robot
  double score = 0;  ///< dense score in about [-1, 1], or log-odds for maps without a field
  double probability = 0;  ///< of this pose being the right one; with `elsewhere` they sum to 1
  double explained = 0;  ///< share of the returns that end on mapped structure
  double through_wall = 0;  ///< share of the beams that pass through mapped walls
  double in_free = 0;  ///< share of the returns that end in known free space
  std::uint32_t explained_constraints =
      0;  ///< what the map explains of the features seen; 0 far behind the first
  std::vector<FeaturePairing> pairings;
};

/// The answer of one relocation: candidates best first, mutually more than 0.5 m or 17 degrees
/// apart.
struct RelocationResult
{
  std::vector<Candidate> candidates;
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;  ///< of the verdict's claim; for `localized`, of the first candidate
  double elsewhere = 1;  ///< probability of standing where no candidate is
  double view = 2 * M_PI;  ///< [rad] of the directions that something was seen in
  MatchingCounters counters;
};

/// Where the robot may be, as a caller's prior: axis-aligned box [m] and heading range [rad].
struct PoseRegion
{
  double x_min, x_max, y_min, y_max;
  double heading = 0;
  double heading_tolerance = 3.15;

  bool contains(const mrpt::math::TPose2D& pose) const;
};
}  // namespace sigloc
