// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Every kind of map: its reader, its name for messages, and the extensions in lower case, which
/// `.gz` or `.zst` may follow. A new one is a row here and its reader. A macro, because a launcher
/// that links no reader names them, too.
#define SIGLOC_MAP_FORMATS(FORMAT)                                           \
  FORMAT(simplemap, readSimplemap, "simplemap", ".simplemap")                \
  FORMAT(gridmap, readGridmap, "grid map", ".gridmap")                       \
  FORMAT(metric_map, readMetricMap, "metric map", ".metricmap")              \
  FORMAT(ros_map, readRosMap, "ROS map", ".yaml", ".yml")                    \
  FORMAT(image, readMapImage, "image with its resolution", ".pgm", ".png")   \
  FORMAT(carmen_log, readCarmenMap, "CARMEN log", ".log", ".clf", ".carmen") \
  FORMAT(landmarks, readLandmarks, "landmark file", ".csv")                  \
  FORMAT(rows, readRows, "landmarks or points", ".txt")                      \
  FORMAT(points, readPointMap, "points", ".ply", ".pcd")                     \
  FORMAT(sigmap, loadSigmap, "sigmap", ".sigmap")

namespace sigloc::detail
{
enum class MapKind
{
#define SIGLOC_KIND(kind, ...) kind,
  SIGLOC_MAP_FORMATS(SIGLOC_KIND)
#undef SIGLOC_KIND
};

/// A kind of file that maps come in.
struct MapFormat
{
  MapKind kind;
  const char* name;
  std::vector<std::string> extensions;
};

const std::vector<MapFormat>& mapFormats();

/// The kind that a file's name tells, if any.
std::optional<MapKind> mapKindOf(const std::filesystem::path& path);
}  // namespace sigloc::detail
