// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/evidence/VisitedCells.h"

#include <algorithm>
#include <vector>

#include "tracking/evidence/ObservedCells.h"

namespace sigloc
{
double VisitedCells::add(const DenseScan& scan, const mrpt::math::TPose2D& map_from_robot,
                         double travelled)
{
  const std::vector<std::uint64_t> cells = observedCells(scan, map_from_robot).cells;
  std::size_t fresh = 0;
  for (const std::uint64_t cell : cells)
  {
    const auto [known, is_new] = last_seen_.try_emplace(cell, travelled);
    fresh += is_new || travelled - known->second > kMemory;
    known->second = travelled;
  }
  return static_cast<double>(fresh) / static_cast<double>(std::max(kCellsOfView, cells.size()));
}
}  // namespace sigloc
