// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sigloc::detail
{
enum class MapKind
{
  simplemap,
  gridmap,
  metric_map,
  ros_map,
  image,
  carmen_log,
  landmarks,
  rows,
  points,
  sigmap,
};

/// A kind of file that maps come in.
struct MapFormat
{
  MapKind kind;
  const char* name;  ///< for messages
  std::vector<std::string> extensions;  ///< lower case; `.gz` or `.zst` may follow
};

/// Every kind of map: a new one is a row there and its reader.
const std::vector<MapFormat>& mapFormats();
}  // namespace sigloc::detail
