// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "sigloc/io/RawlogReader.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// What a map input file holds, in the core's terms.
using MapSource = std::variant<std::vector<PosedScans>, OccupancyRaster, FeatureMap>;

/// Reads `.simplemap`, `.gridmap`, `.metricmap`, a ROS map `.yaml`, a CARMEN log with corrected
/// poses (`.log`, `.clf`, `.carmen`), or a ready `.sigmap`. `.gz` or `.zst` may follow. Reads an
/// image alone where `reading` tells its scale, and points (`.ply`, `.pcd`, `.txt`) within its
/// heights. Reads landmarks (`.csv`, `.txt`): rows `x y [radius] [sigma]`. Throws
/// std::runtime_error naming the path and the reason for a missing, empty, truncated, foreign or
/// unusable file. Throws the same for a map that reaches farther than 100 km from its origin.
MapSource readMapSource(const std::filesystem::path& path, const ReadingOptions& reading = {});

/// Returns the kinds of map that readMapSource() reads, for messages: "simplemap (.simplemap),
/// ...".
std::string mapFormatNames();

/// Whether a file is named as an image alone, whose resolution only `ReadingOptions` tells.
bool isMapImage(const std::filesystem::path& path);

/// Returns a line on the key frames of a simplemap that are left out, or that are taken to be on
/// one floor. For a ROS map the line is on thresholds that would make free what was never seen. It
/// is empty when there is nothing to tell. The same errors.
std::string warningOfMapSource(const std::filesystem::path& path);

/// Returns a line on a map in which no robot is likely to be found, or an empty one. It has more
/// wall than free space, cells above 0.5 m, less than 4 m^2 of free space, or less than 10
/// features.
std::string warningOfMap(const FeatureMap& map);

/// Returns the files that a map source is read from: `path`, and the image that a ROS map names.
/// Throws std::runtime_error ("path: reason") for a ROS map that cannot be read.
std::vector<std::filesystem::path> filesOfMapSource(const std::filesystem::path& path);

/// Reads a map source and builds the feature map; a `.sigmap` is returned as it is.
FeatureMap buildMapFromFile(const std::filesystem::path& path, const MapBuildingOptions& building,
                            const FeatureExtractorOptions& extraction,
                            const MapProgress& progress = {}, const ReadingOptions& reading = {});

/// A map, and whether it came out of a cache.
struct CachedMap
{
  FeatureMap map;
  bool reused = false;  ///< it was read from the cache
  double build_seconds = 0;  ///< [s] to build it, or to read it from the cache
};

/// Returns the map of `source`, reusing `cache` (a `.sigmap`) when its provenance shows that
/// neither the source's bytes nor the options have changed. Otherwise builds it and rewrites
/// `cache`. `reused` is set accordingly. A cache that cannot be read is rebuilt, and one that
/// cannot be written is left out; neither is an error. Throws std::runtime_error ("path: reason")
/// for a source that cannot be read.
CachedMap mapWithCache(const std::filesystem::path& source, const std::filesystem::path& cache,
                       const MapBuildingOptions& building,
                       const FeatureExtractorOptions& extraction, const MapProgress& progress = {},
                       const ReadingOptions& reading = {});

/// Returns the file in the user's cache folder in which the map of `source` is kept. The folder is
/// `$XDG_CACHE_HOME/sigloc`, else `$HOME/.cache/sigloc`. Empty where neither variable is an
/// absolute path.
std::filesystem::path mapCacheFile(const std::filesystem::path& source);

/// Returns the scans of the key frames, with poses in the map frame. Scans that cannot be used are
/// left out.
std::vector<PosedScans> posedScansOf(const mrpt::maps::CSimpleMap& simplemap);

/// Returns the cells of a grid map in their order; walls are in the middle of their cells.
OccupancyRaster rasterOf(const mrpt::maps::COccupancyGridMap2D& grid);

/// Writes a `.sigmap` (compressed by zstd, versioned, checksummed) atomically: to a temporary file
/// that is renamed. Throws std::runtime_error naming the path and the reason.
void saveSigmap(const FeatureMap& map, const std::filesystem::path& path);

/// Reads a `.sigmap` of this or an earlier version. Throws std::runtime_error naming the path and
/// the reason for a missing, truncated, corrupt or foreign file, and for a map that reaches beyond
/// 100 km of its origin.
FeatureMap loadSigmap(const std::filesystem::path& path);

/// The body of a `.sigmap` and of a serialized `SignatureMap`. Reading throws std::runtime_error
/// for one that is cut off or has a value that no map has.
void writeFeatureMap(const FeatureMap& map, mrpt::serialization::CArchive& out);
FeatureMap readFeatureMap(mrpt::serialization::CArchive& in);
}  // namespace sigloc
