// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace sigloc::detail
{
/// How the shades of a ROS map's image are read. The names are those of the key `mode`.
enum class RosMapMode
{
  trinary,  ///< wall, free or unknown by the thresholds
  scale,  ///< the same, and a probability between them
  raw,  ///< the shade is the probability in percent; above 100 is unknown
};

/// What a ROS map's yaml says.
struct RosMapHeader
{
  std::filesystem::path image;
  RosMapMode mode = RosMapMode::trinary;
  bool negate = false;  ///< white is occupied
  mrpt::math::TPose2D origin;  ///< of the image's lower left corner in the map
  double resolution = 0;  ///< [m]
  double free_threshold = 0;  ///< occupancy below is free ...
  double occupied_threshold = 1;  ///< ... and above a wall
};

/// Reads the yaml of a ROS map: keys with a scalar, and `origin` with three numbers, in a line or
/// one a line. Keys of no meaning here are skipped. Throws std::runtime_error ("path: reason") for
/// other text, for more than 64 kB of it, and for values that make no map.
RosMapHeader parseRosMapYaml(std::string_view text, const std::filesystem::path& path);

/// Reads the file, with the image as a path that can be opened.
RosMapHeader readRosMapHeader(const std::filesystem::path& path);
}  // namespace sigloc::detail
