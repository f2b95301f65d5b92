// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/evidence/ObservedCells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cell_key.h"

namespace sigloc
{
namespace
{
constexpr double kCell = 0.5;  // [m]

std::uint64_t cellAt(double x, double y)
{
  const auto at = [](double along)
  {
    constexpr double kFarthest = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(std::floor(along / kCell), -kFarthest, kFarthest));
  };
  return cellKey(at(x), at(y));
}
}  // namespace

ObservedCells observedCells(const DenseScan& scan, const mrpt::math::TPose2D& frame_from_robot)
{
  const double c = std::cos(frame_from_robot.phi);
  const double s = std::sin(frame_from_robot.phi);
  std::vector<std::uint64_t> cell_of_return;
  cell_of_return.reserve(scan.size());
  ObservedCells view;
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const auto x = static_cast<double>(scan.x[i]);
    const auto y = static_cast<double>(scan.y[i]);
    cell_of_return.push_back(
        cellAt(frame_from_robot.x + c * x - s * y, frame_from_robot.y + s * x + c * y));
    if (scan.isolated[i] == 0) view.cells.push_back(cell_of_return.back());
  }
  std::sort(view.cells.begin(), view.cells.end());
  view.cells.erase(std::unique(view.cells.begin(), view.cells.end()), view.cells.end());
  view.cell_of.assign(scan.size(), ObservedCells::kNowhere);
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    if (scan.isolated[i] != 0) continue;
    const auto at = std::lower_bound(view.cells.begin(), view.cells.end(), cell_of_return[i]);
    view.cell_of[i] = static_cast<std::uint32_t>(at - view.cells.begin());
  }
  return view;
}
}  // namespace sigloc
