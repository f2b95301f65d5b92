// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Programs name the formats in their help, before they load the library. So nothing is called here
// that needs MRPT's libraries.
#include "io/maps/map_formats.h"

#include <fmt/format.h>

#include "sigloc/io/map_files.h"

namespace sigloc
{
namespace detail
{
const std::vector<MapFormat>& mapFormats()
{
  static const std::vector<MapFormat> kFormats = {
      {MapKind::simplemap, "simplemap", {".simplemap"}},
      {MapKind::gridmap, "grid map", {".gridmap"}},
      {MapKind::metric_map, "metric map", {".metricmap"}},
      {MapKind::ros_map, "ROS map", {".yaml", ".yml"}},
      {MapKind::image, "image with its resolution", {".pgm", ".png"}},
      {MapKind::carmen_log, "CARMEN log", {".log", ".clf", ".carmen"}},
      {MapKind::landmarks, "landmark file", {".csv"}},
      {MapKind::rows, "landmarks or points", {".txt"}},
      {MapKind::points, "points", {".ply", ".pcd"}},
      {MapKind::sigmap, "sigmap", {".sigmap"}},
  };
  return kFormats;
}
}  // namespace detail

std::string mapFormatNames()
{
  std::string names;
  for (const detail::MapFormat& format : detail::mapFormats())
  {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", format.name,
                         fmt::join(format.extensions, " "));
  }
  return names;
}
}  // namespace sigloc
