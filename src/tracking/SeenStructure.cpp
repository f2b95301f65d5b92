// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SeenStructure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sigloc
{
namespace
{
constexpr double kCell = 0.5;  // [m]
constexpr double kMemory = 10.0;  // [m] of travel
constexpr std::size_t kFullView = 14;  // cells: 7 m of walls

std::uint64_t cellOf(double x, double y)
{
  const auto column = static_cast<std::int32_t>(std::floor(x / kCell));
  const auto row = static_cast<std::int32_t>(std::floor(y / kCell));
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U) |
         static_cast<std::uint32_t>(row);
}
}  // namespace

double SeenStructure::add(const DenseScan& scan, const mrpt::math::TPose2D& map_from_robot,
                          double travelled)
{
  const double c = std::cos(map_from_robot.phi);
  const double s = std::sin(map_from_robot.phi);
  std::vector<std::uint64_t> cells;
  cells.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    if (scan.isolated[i] != 0) continue;
    const auto x = static_cast<double>(scan.x[i]);
    const auto y = static_cast<double>(scan.y[i]);
    cells.push_back(cellOf(map_from_robot.x + c * x - s * y, map_from_robot.y + s * x + c * y));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::size_t fresh = 0;
  for (const std::uint64_t cell : cells)
  {
    const auto [known, is_new] = last_seen_.try_emplace(cell, travelled);
    fresh += is_new || travelled - known->second > kMemory;
    known->second = travelled;
  }
  return static_cast<double>(fresh) / static_cast<double>(std::max(kFullView, cells.size()));
}
}  // namespace sigloc
