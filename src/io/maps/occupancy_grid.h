// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/map/DenseField.h"

namespace sigloc::detail
{
/// A grid as programs hand it over: the message of ROS, or an array.
struct OccupancyGrid
{
  std::uint32_t width = 0;  ///< [cells]
  std::uint32_t height = 0;  ///< [cells]
  double resolution = 0;  ///< [m]
  mrpt::math::TPose2D origin;  ///< of the lower left corner in the map. Rows run along its x.
  /// width * height, row by row from the lower left: the probability of a wall, in [0, 1]; NaN
  /// where never seen.
  std::vector<float> occupied;
};

/// Returns the raster of a grid. Throws std::invalid_argument for one that makes no map. It has no
/// cells, more than kMostCells or another number of them, or cells of an unusable size. Its origin
/// is not finite or beyond reach. A probability is outside [0, 1]. It has no wall or no free cell.
OccupancyRaster rasterOfOccupancy(const OccupancyGrid& grid);

/// Returns the state of a cell that is occupied with this probability.
CellState stateOfOccupancy(double occupied);

/// Returns why no map can be made of a raster, or nullopt where one can. It needs a wall, a free
/// cell, and cells of a usable size.
std::optional<std::string> unusableGrid(const OccupancyRaster& raster);

/// Returns a raster whose lower left corner is at its frame's origin and whose rows are turned by
/// `yaw` [rad], as one along the axes. A cell has the state of the turned cell in which its middle
/// is. Throws std::invalid_argument where that has too many cells, or reaches too far.
OccupancyRaster turned(OccupancyRaster raster, double yaw);
}  // namespace sigloc::detail
