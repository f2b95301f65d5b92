// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "io/archive/gzip_input.h"
#include "io/maps/map_source_readers.h"
#include "io/points/points_raster.h"

namespace sigloc::detail
{
OccupancyRaster readPointMap(const std::filesystem::path& path, const ReadingOptions& reading)
{
  const PointList points = extensionOf(path) == ".ply" ? readPly(path) : readPcd(path);
  OccupancyRaster raster = rasterOfPoints(points, reading, path);
  requireWallAndFree(raster, path);
  return raster;
}

MapSource readRows(const std::filesystem::path& path, const ReadingOptions& reading)
{
  const auto points = pointRowsOf(path);
  if (!points) return readLandmarks(path);
  OccupancyRaster raster = rasterOfPoints(*points, reading, path);
  requireWallAndFree(raster, path);
  return raster;
}

std::string warningOfRows(const std::filesystem::path& path)
{
  if (!pointRowsOf(path)) return {};
  return std::string("its rows are taken as points of walls, not as landmarks; it ") + kNoFreeSpace;
}
}  // namespace sigloc::detail
