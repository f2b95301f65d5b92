// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// A pose is claimed from this probability on. \cite algorithm section 7
constexpr double kLocalizedProbability = 0.99;
/// Without a dense field, "somewhere else" keeps this probability at least. In the tracker it is
/// the least weight that starts new tracks. A published probability may be lower.
/// \cite algorithm eq. (7.4), (8.25)
constexpr double kLeastElsewhere = 0.002;

/// What is claimed about the robot's pose. \cite algorithm section 7, "The verdict"
enum class Verdict : std::uint8_t
{
  localized = 0,  ///< one pose has a probability of at least 0.99
  ambiguous = 1,  ///< several poses, or a line of poses, explain the scan
  not_here = 2,  ///< no pose in the map explains the scan
  too_little_seen = 3,  ///< too few returns or features, or too short a search, for any other
};

/// Returns "localized", "ambiguous", "not here" or "too little seen".
const char* toString(Verdict verdict);

/// Returns a probability for people, with so many digits after the point. It is never rounded up:
/// what is below the 0.99 of a claim must not look like it.
std::string probabilityText(double probability, int digits = 3);

/// Observed feature `observed` is assumed to be map feature `mapped` (indices).
struct FeaturePairing
{
  std::uint32_t observed = 0;
  std::uint32_t mapped = 0;
};

/// The cost of generating and verifying hypotheses, in operations. Times never enter results.
struct MatchingCounters
{
  std::uint64_t signature_pairs = 0;  ///< pairs of signatures, or of key points, compared
  std::uint64_t hypotheses = 0;  ///< poses proposed: from bases, key points or minimal sets
  std::uint64_t checks = 0;  ///< location-dependent checks of a pairing at a pose
  std::uint64_t visits = 0;  ///< cells and list entries read to find map features
  std::uint64_t poses_scored = 0;  ///< poses scored in the dense field
  std::uint64_t cut_short = 0;  ///< searches that ended at their budget, before they were complete
  std::uint64_t settled_by_pairs = 0;  ///< searches that pairs of key points ended, mode (f)
};

/// How many of the constraints that a scan's features give on the pose the map meets.
/// \cite algorithm eq. (7.5)
struct ConstraintCounts
{
  std::uint32_t walls = 0;  ///< walls that are mapped where they are seen
  std::uint32_t missing_walls = 0;  ///< walls that are seen in mapped area, and not mapped there
  std::uint32_t wall_ends = 0;  ///< ends of walls that are mapped where they are seen
};

/// A pose that the robot may be at.
struct Candidate
{
  GaussianPose pose;  ///< map_from_robot
  double score = 0;  ///< dense score in about [-1, 1], or log-odds for maps without a field
  double probability = 0;  ///< that it is the right one; all sum to 1 with `elsewhere`
  double explained = 0;  ///< mean of the fine and the coarse likelihood, in [0, 1]
  double through_wall = 0;  ///< share of the beams that pass through mapped walls, in [0, 1]
  double in_free = 0;  ///< share of the returns that end in known free space, in [0, 1]
  /// All 0 for a score of more than 0.2 below the first candidate's.
  ConstraintCounts constraints;
  std::vector<FeaturePairing> pairings;  ///< empty where the dense field has scored the pose
};

/// The result of one relocation. The candidates are given best first and are mutually more than
/// 0.5 m or 17 degrees apart.
struct RelocationResult
{
  std::vector<Candidate> candidates;
  Verdict verdict = Verdict::too_little_seen;
  /// Of the verdict: that of the first candidate where localized, that it is not the first where
  /// ambiguous, and `elsewhere` for *not here* and *too little seen*.
  double probability = 0;
  double elsewhere = 1;  ///< probability that the robot is at none of the candidates
  double view = 2 * M_PI;  ///< [rad] angular coverage of the returns, 0 without any
  /// False where the search by features ended at its budget: what it missed may be right. Poses
  /// that a dense search left unrefined are told by `counters.cut_short` alone.
  bool complete = true;
  MatchingCounters counters;
};

/// A caller's prior of where the robot may be: an axis-aligned box [m] and a heading range [rad],
/// in the map frame.
struct PoseRegion
{
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
  double heading = 0;
  double heading_tolerance = 3.15;  ///< to either side; more than pi: any heading

  /// True for a pose in the box and the range, borders included.
  bool contains(const mrpt::math::TPose2D& pose) const;
};
}  // namespace sigloc
