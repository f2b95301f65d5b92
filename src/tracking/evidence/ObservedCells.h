// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "matching/dense/DenseVerifier.h"

namespace sigloc
{
/// The cells of 0.5 m in which a scan's returns end, in the frame that the robot's pose is given
/// in.
struct ObservedCells
{
  static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint64_t> cells;  ///< every cell once, ascending
  std::vector<std::uint32_t> cell_of;  ///< of each return: index into cells, kNowhere if isolated
};

/// Number of cells from which on a scan counts in full: 7 m of walls. \cite algorithm eq. (8.7)
constexpr std::size_t kCellsOfView = 14;

/// [m] of travel after which what was seen is forgotten: the errors of the odometry have grown, and
/// what has changed since is told anew. \cite algorithm section 8
constexpr double kMemory = 10.0;

/// Returns the cells of a scan seen from `frame_from_robot`.
ObservedCells observedCells(const DenseScan& scan, const mrpt::math::TPose2D& frame_from_robot);
}  // namespace sigloc
