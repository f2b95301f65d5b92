// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "io/archive/checked_archive.h"
#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/maps/map_source_readers.h"
#include "io/maps/occupancy_grid.h"
#include "sigloc/io/map_files.h"

namespace sigloc
{
using mrpt::maps::COccupancyGridMap2D;

namespace
{
// A cell of MRPT's grid holds the probability of being free; never seen is 0.5. One observation of
// a default sensor model moves it to 0.65 or 0.35. A single hit already is structure, but only a
// cell that is hit repeatedly stops a beam.
constexpr float kFreeFrom = 0.6F;
constexpr float kWallBelow = 0.45F;
constexpr float kSolidWallBelow = 0.3F;

CellState stateOf(float free_probability)
{
  if (free_probability < kSolidWallBelow) return CellState::solid_wall;
  if (free_probability < kWallBelow) return CellState::wall;
  return free_probability >= kFreeFrom ? CellState::free : CellState::unknown;
}

}  // namespace

OccupancyRaster rasterOf(const COccupancyGridMap2D& grid)
{
  OccupancyRaster raster;
  raster.frame.origin = {static_cast<double>(grid.getXMin()), static_cast<double>(grid.getYMin())};
  raster.frame.resolution = static_cast<double>(grid.getResolution());
  raster.frame.width = grid.getSizeX();
  raster.frame.height = grid.getSizeY();
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);

  using Cell = COccupancyGridMap2D::cellType;
  // MRPT counts from -127, but files hold -128 too.
  constexpr int kLowest = std::numeric_limits<Cell>::min();
  constexpr int kHighest = std::numeric_limits<Cell>::max();
  constexpr Cell kLowestOfMrpt = COccupancyGridMap2D::OCCGRID_CELLTYPE_MIN;
  std::array<CellState, kHighest - kLowest + 1> state_of_cell{};
  for (int cell = kLowest; cell <= kHighest; ++cell)
  {
    state_of_cell[static_cast<std::size_t>(cell - kLowest)] =
        stateOf(COccupancyGridMap2D::l2p(std::max(static_cast<Cell>(cell), kLowestOfMrpt)));
  }
  for (const Cell cell : grid.getRawMap())
  {
    raster.cells.push_back(state_of_cell[static_cast<std::size_t>(cell - kLowest)]);
  }
  return raster;
}

namespace detail
{
CellState stateOfOccupancy(double occupied)
{
  return stateOf(static_cast<float>(1 - occupied));
}

void requireWallAndFree(const OccupancyRaster& raster, const std::filesystem::path& path)
{
  if (const auto reason = unusableGrid(raster))
  {
    detail::fail(path, *reason);
  }
}

OccupancyRaster readGridmap(const std::filesystem::path& path, const ReadingOptions& reading)
{
  if (isMultiMap(path)) return readMetricMap(path, reading);
  COccupancyGridMap2D grid;
  readObjectFile(path, grid);
  OccupancyRaster raster = rasterOf(grid);
  requireWallAndFree(raster, path);
  return raster;
}
}  // namespace detail
}  // namespace sigloc
