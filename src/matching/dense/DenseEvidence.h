// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>

namespace sigloc
{
/// A pose that the dense field is to score.
struct PoseProposal
{
  float x = 0;  ///< [m]
  float y = 0;  ///< [m]
  float phi = 0;  ///< [rad], not wrapped
};

/// How the dense field explains a scan at a pose. All shares are of the returns used, in [0, 1].
struct DenseEvidence
{
  /// Score per share of beams through walls, and per share of returns in free space.
  static constexpr double kPenalty = 0.5;

  double sharp = 0;  ///< mean likelihood by the ridges of walls, eq. (6.14), in [0, 1]
  double fine = 0;  ///< mean likelihood, sigma 0.12 m, in [0, 1]
  double coarse = 0;  ///< mean likelihood, sigma 0.25 m, in [0, 1]
  double through_wall = 0;  ///< share of beams that pass a solid wall before their end
  double in_free = 0;  ///< share that ends in free cells, more than 0.4 m from any wall
  double unknown = 0;  ///< share that ends in unknown cells, more than 0.4 m from any wall
  double score = 0;  ///< poses are ranked by it, in about [-1, 1], \cite algorithm eq. (6.8)
  std::uint64_t through = 0;  ///< bit i: of the beams that were tested, the i-th passes a wall
};

/// How the map explains one return.
struct ExplainedReturn
{
  float share = 0;  ///< explained share, in [0, 1]
  bool unknown = false;  ///< ends in unknown area, so that the map says nothing about it
  bool off_walls = false;  ///< passes a solid wall, or ends in mapped area and on no wall
};

/// A pose that is left at the end of the cascade.
struct RankedPose
{
  mrpt::math::TPose2D pose;
  DenseEvidence evidence;
};
}  // namespace sigloc
