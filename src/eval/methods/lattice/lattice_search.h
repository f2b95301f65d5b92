// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "eval/methods/lattice/DenseSearchSpace.h"

namespace sigloc
{
/// The best poses of a lattice, best first, and what finding them cost.
struct LatticeSearchResult
{
  std::vector<LatticePose> best;
  std::uint64_t poses_scored = 0;  ///< lattice poses, or blocks of them, that were looked up
};

/// Scores every free pose of the lattice and returns the best `options().refined` ones. It is the
/// reference for recall: nothing is pruned.
LatticeSearchResult searchExhaustively(const DenseSearchSpace& space,
                                       const std::vector<mrpt::math::TPoint2D>& points);

/// Finds the same poses by depth-first branch and bound over a pyramid of max-pooled grids, as
/// Cartographer's loop closure does. \cite Hess, Kohler, Rapp, Andor, "Real-time loop closure in 2D
/// LIDAR SLAM" (ICRA 2016)
class BranchAndBoundSearch
{
 public:
  /// Keeps a reference to `space`.
  explicit BranchAndBoundSearch(const DenseSearchSpace& space);

  LatticeSearchResult search(const std::vector<mrpt::math::TPoint2D>& points) const;

 private:
  struct Level
  {
    std::vector<std::uint8_t> maxima;  ///< the likelihood's maximum over the window from each cell
    std::vector<std::uint8_t> any_free;  ///< per block of positions, row by row
    std::uint32_t block_columns = 0;
    std::uint32_t block_rows = 0;
  };
  struct Run;

  const DenseSearchSpace& space_;
  std::vector<Level> levels_;  ///< level h: blocks of 2^h x 2^h positions
};
}  // namespace sigloc
