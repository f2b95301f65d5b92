// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sigloc/io/map_files.h"
#include "sigloc/map/map_building.h"

namespace sigloc::detail
{
// One reader a file format; all throw std::runtime_error "path: reason".

std::vector<PosedScans> readSimplemap(const std::filesystem::path& path,
                                      const ReadingOptions& reading = {});
/// A grid map, or several maps as readMetricMap() takes them.
OccupancyRaster readGridmap(const std::filesystem::path& path, const ReadingOptions& reading = {});

/// A file of one map of MRPT, or of several in a CMultiMetricMap: the first grid map with walls and
/// free cells, else the first map of points. Landmarks in it are not read.
OccupancyRaster readMetricMap(const std::filesystem::path& path, const ReadingOptions& reading);
/// Returns a line where points are taken or landmarks left out, else an empty one.
std::string warningOfMetricMap(const std::filesystem::path& path);
/// True for a file whose object is a CMultiMetricMap.
bool isMultiMap(const std::filesystem::path& path);

/// Returns what is odd of a field's areas and scale, as warningOfMap() does, or an empty text.
std::string warningOfField(const DenseField& field);

/// Throws for a raster without a wall or a free cell, or with cells of an unusable size.
void requireWallAndFree(const OccupancyRaster& raster, const std::filesystem::path& path);

/// Free, wall and unknown by nav2's rules for the file's mode and thresholds; its image is a PGM or
/// PNG. One difference: shade 205, with which map savers write what was never seen, stays unknown
/// where mode or thresholds would make it free. With `negate` that is shade 50.
OccupancyRaster readRosMap(const std::filesystem::path& path);
/// The same for an image alone: trinary, with the thresholds that map_saver writes, and its lower
/// left corner at the map's origin. Throws where `reading` does not tell its scale.
OccupancyRaster readMapImage(const std::filesystem::path& path, const ReadingOptions& reading);
/// Returns a line where that difference matters, else an empty one.
std::string warningOfRosMap(const std::filesystem::path& path);
/// Returns the image file that a ROS map names, as a path that can be opened.
std::filesystem::path imageOfRosMap(const std::filesystem::path& path);

/// FLASER and ROBOTLASER1 messages with the (corrected) laser pose they carry. A FLASER message of
/// n beams covers 180 degrees from -90 in steps of 180/n (n even) or 180/(n-1) degrees (n odd). The
/// robot frame is the laser's: its mount does not affect a map.
std::vector<PosedScans> readCarmenMap(const std::filesystem::path& path);

/// A `.ply` or `.pcd` file.
OccupancyRaster readPointMap(const std::filesystem::path& path, const ReadingOptions& reading);

/// A text of points where it holds such, else of landmarks.
MapSource readRows(const std::filesystem::path& path, const ReadingOptions& reading);
/// Returns a line where a text is taken for points, else an empty one.
std::string warningOfRows(const std::filesystem::path& path);

/// Rows `x y [radius] [sigma]` in metres; a header row, also behind '#', may name the columns
/// (x, y, radius or r, sigma, label; others are ignored). A radius makes a circle, else a point.
FeatureMap readLandmarks(const std::filesystem::path& path);
}  // namespace sigloc::detail
