// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/occupancy_grid.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "map/map_values.h"

namespace sigloc::detail
{
OccupancyRaster rasterOfOccupancy(const OccupancyGrid& grid)
{
  OccupancyRaster raster;
  raster.frame = {{grid.origin.x, grid.origin.y}, grid.resolution, grid.width, grid.height};
  if (!std::isfinite(grid.origin.phi)) throw std::invalid_argument("the grid's turn is no number");
  if (const auto flaw = flawOf(raster.frame)) throw std::invalid_argument(*flaw);
  if (grid.occupied.size() != std::size_t{grid.width} * grid.height)
  {
    throw std::invalid_argument("the number of cells is not width times height");
  }
  raster.cells.reserve(grid.occupied.size());
  for (const float occupied : grid.occupied)
  {
    if (occupied < 0 || occupied > 1)
    {
      throw std::invalid_argument("a cell's probability of a wall is outside [0, 1]");
    }
    raster.cells.push_back(std::isnan(occupied) ? CellState::unknown
                                                : stateOfOccupancy(static_cast<double>(occupied)));
  }
  raster = turned(std::move(raster), grid.origin.phi);
  if (const auto reason = unusableGrid(raster)) throw std::invalid_argument(*reason);
  return raster;
}

std::optional<std::string> unusableGrid(const OccupancyRaster& raster)
{
  if (auto reason = unusableCells(raster.frame.resolution)) return reason;
  const auto has = [&raster](auto&& state)
  { return std::any_of(raster.cells.begin(), raster.cells.end(), state); };
  if (!has(isWall)) return "the grid has no wall";
  if (!has([](CellState cell) { return cell == CellState::free; }))
  {
    return "the grid has no free cell";
  }
  return std::nullopt;
}

OccupancyRaster turned(OccupancyRaster image, double yaw)
{
  constexpr double kSameTurn = 1e-6;  // [rad]
  if (std::abs(mrpt::math::wrapToPi(yaw)) <= kSameTurn) return image;
  const RasterFrame& from = image.frame;
  const mrpt::math::TPose2D map_from_image(from.origin.x, from.origin.y, yaw);
  const double width = from.width * from.resolution;
  const double height = from.height * from.resolution;
  mrpt::math::TPoint2D low = from.origin;
  mrpt::math::TPoint2D high = from.origin;
  for (const mrpt::math::TPoint2D corner :
       {mrpt::math::TPoint2D(width, 0), {0, height}, {width, height}})
  {
    const mrpt::math::TPoint2D at = map_from_image.composePoint(corner);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  OccupancyRaster raster;
  raster.frame.origin = low;
  raster.frame.resolution = from.resolution;
  raster.frame.width = static_cast<std::uint32_t>(std::ceil((high.x - low.x) / from.resolution));
  raster.frame.height = static_cast<std::uint32_t>(std::ceil((high.y - low.y) / from.resolution));
  // A thin image takes much room when it is turned.
  if (const auto flaw = flawOf(raster.frame)) throw std::invalid_argument(*flaw);
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);
  for (std::uint32_t y = 0; y < raster.frame.height; ++y)
  {
    for (std::uint32_t x = 0; x < raster.frame.width; ++x)
    {
      const mrpt::math::TPoint2D middle(low.x + (x + 0.5) * from.resolution,
                                        low.y + (y + 0.5) * from.resolution);
      const mrpt::math::TPoint2D at = map_from_image.inverseComposePoint(middle);
      const double column = std::floor(at.x / from.resolution);
      const double row = std::floor(at.y / from.resolution);
      const bool inside = column >= 0 && row >= 0 && column < from.width && row < from.height;
      raster.cells.push_back(inside ? image.cells[static_cast<std::size_t>(row) * from.width +
                                                  static_cast<std::size_t>(column)]
                                    : CellState::unknown);
    }
  }
  return raster;
}
}  // namespace sigloc::detail
