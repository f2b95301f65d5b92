// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "io/points/point_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/map/DenseField.h"

namespace sigloc::detail
{
/// Returns the raster of a map of points [m]: a cell with a point within the heights of `reading`
/// is wall. Points that are all at one height are taken whatever it is. Cells are of 5 cm, or of up
/// to 20 cm where points are so far apart that walls would have gaps.
///
/// Points tell no free space. A cell is guessed to be free where walls are seen all around it.
/// Throws std::runtime_error ("path: reason") for points that make no map.
OccupancyRaster rasterOfPoints(const PointList& points, const ReadingOptions& reading,
                               const std::filesystem::path& path);

/// A line that tells of that guess.
constexpr const char* kNoFreeSpace =
    "holds points only, no free space; where a robot can be is guessed from the walls around";
}  // namespace sigloc::detail
