// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/containers/yaml.h>
#include <mrpt/img/CImage.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/gzip_input.h"
#include "io/maps/map_reach.h"
#include "io/maps/map_source_readers.h"
#include "io/QuietOutput.h"
#include "map/raster_limits.h"
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

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason)
{
  throw std::runtime_error(path.string() + ": " + reason);
}

CellState stateOf(float free_probability)
{
  if (free_probability < kSolidWallBelow) return CellState::solid_wall;
  if (free_probability < kWallBelow) return CellState::wall;
  return free_probability >= kFreeFrom ? CellState::free : CellState::unknown;
}

/// The fields of a ROS map's yaml besides the image.
struct RosMapHeader
{
  std::filesystem::path image;
  mrpt::math::TPose2D origin;  ///< of the image's lower left corner in the map
  double resolution = 0;  ///< [m]
  double free_threshold = 0;  ///< occupancy below is free ...
  double occupied_threshold = 1;  ///< ... and above a wall
  bool raw = false;  ///< a pixel is the occupancy [%], above 100 unknown
};

void check(const RosMapHeader& header, const std::filesystem::path& path)
{
  constexpr double kSameTurn = 1e-6;  // [rad]
  if (const auto reason = unusableCells(header.resolution)) fail(path, *reason);
  if (const auto reason = detail::beyondReach(header.origin.x, header.origin.y))
  {
    fail(path, *reason);
  }
  if (!(std::abs(mrpt::math::wrapToPi(header.origin.phi)) <= kSameTurn))
  {
    fail(path, "an origin with a yaw is not supported");
  }
  const bool ordered = header.free_threshold >= 0 && header.occupied_threshold <= 1 &&
                       header.free_threshold <= header.occupied_threshold;
  if (!ordered) fail(path, "needs 0 <= free_thresh <= occupied_thresh <= 1");
}

RosMapHeader readRosMapHeader(const std::filesystem::path& path)
{
  detail::requireFile(path);
  RosMapHeader header;
  try
  {
    const detail::QuietOutput quiet;
    const auto yaml = mrpt::containers::yaml::FromFile(path.string());
    header.image = yaml["image"].as<std::string>();
    header.resolution = yaml["resolution"].as<double>();
    const auto origin = yaml["origin"];
    header.origin = {origin(0).as<double>(), origin(1).as<double>(), origin(2).as<double>()};
    header.free_threshold = yaml["free_thresh"].as<double>();
    header.occupied_threshold = yaml["occupied_thresh"].as<double>();
    header.raw = yaml.has("mode") && yaml["mode"].as<std::string>() == "raw";
  }
  catch (const std::exception&)
  {
    fail(path,
         "not a ROS map: 'image', 'resolution', 'origin: [x, y, yaw]', 'free_thresh' and "
         "'occupied_thresh' are needed");
  }
  check(header, path);
  if (header.image.is_relative()) header.image = path.parent_path() / header.image;
  return header;
}
/// Throws std::runtime_error where the image cannot be read.
OccupancyRaster readRawImage(const RosMapHeader& header)
{
  constexpr int kWall = 100;  // [%]
  mrpt::img::CImage image;
  if (!image.loadFromFile(header.image.string(), 0)) throw std::runtime_error("no image");
  OccupancyRaster raster;
  raster.frame.origin = {header.origin.x, header.origin.y};
  raster.frame.resolution = header.resolution;
  raster.frame.width = static_cast<std::uint32_t>(image.getWidth());
  raster.frame.height = static_cast<std::uint32_t>(image.getHeight());
  raster.cells.reserve(std::size_t{raster.frame.width} * raster.frame.height);
  for (std::uint32_t row = raster.frame.height; row-- > 0;)  // an image begins at the top
  {
    for (std::uint32_t column = 0; column < raster.frame.width; ++column)
    {
      const int occupancy = *image.ptr<std::uint8_t>(column, row);
      const bool known = occupancy <= kWall;
      raster.cells.push_back(known ? stateOf(1.0F - static_cast<float>(occupancy) / kWall)
                                   : CellState::unknown);
    }
  }
  return raster;
}

OccupancyRaster usable(OccupancyRaster raster, const std::filesystem::path& path)
{
  if (const auto reason = unusableCells(raster.frame.resolution)) fail(path, *reason);
  const auto& cells = raster.cells;
  if (std::none_of(cells.begin(), cells.end(), isWall)) fail(path, "the grid has no wall");
  if (std::find(cells.begin(), cells.end(), CellState::free) == cells.end())
  {
    fail(path, "the grid has no free cell");
  }
  return raster;
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
OccupancyRaster readGridmap(const std::filesystem::path& path)
{
  COccupancyGridMap2D grid;
  readObjectFile(path, grid);
  return usable(rasterOf(grid), path);
}

std::filesystem::path imageOfRosMap(const std::filesystem::path& path)
{
  return readRosMapHeader(path).image;
}

OccupancyRaster readRosMap(const std::filesystem::path& path)
{
  const RosMapHeader header = readRosMapHeader(path);
  requireFile(header.image);
  OccupancyRaster raster;
  try
  {
    const QuietOutput quiet;
    raster = header.raw
                 ? readRawImage(header)
                 : sigloc::rasterOf(COccupancyGridMap2D::FromROSMapServerYAML(path.string()));
  }
  catch (const std::exception&)
  {
    fail(path, "its image '" + header.image.string() + "' cannot be read");
  }
  return usable(std::move(raster), path);
}
}  // namespace detail
}  // namespace sigloc
