// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <unordered_map>

#include "matching/dense/DenseVerifier.h"

namespace sigloc
{
/// The cells of the map, 0.5 m wide, that a track has seen so far. A second scan of the same walls
/// repeats the errors and the likeness of the first, so only new cells are evidence.
class VisitedCells
{
 public:
  /// Adds the cells in which the returns end, seen from `map_from_robot`. Returns the share of them
  /// that was not seen within the last 10 m of travel, in [0, 1]. Fewer than kCellsOfView cells
  /// count as that many; isolated returns do not count. `travelled` [m] counts from any start and
  /// never falls. \cite algorithm eq. (8.7)
  double add(const DenseScan& scan, const mrpt::math::TPose2D& map_from_robot, double travelled);

 private:
  std::unordered_map<std::uint64_t, double> last_seen_;  // cell: travelled [m]
};
}  // namespace sigloc
