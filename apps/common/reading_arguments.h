// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "number_option.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
/// The options of every command that reads a map or a log: what these do not tell by themselves.
struct ReadingArguments
{
  std::optional<double> resolution;
  std::vector<double> heights;

  // The object must live as long as the command.
  void declare(CLI::App& command)
  {
    constexpr double kFinest = 0.005;
    constexpr double kCoarsest = 1;
    constexpr double kHighest = 100;
    command.add_option("--resolution", resolution, "[m] a pixel, of a map that is an image alone")
        ->check(numberFrom(kFinest, kCoarsest));
    command
        .add_option("--heights", heights,
                    "LOW,HIGH [m] above the robot's base, or the map's origin: which 3D points "
                    "count as walls (default: 0.2,1.5)")
        ->delimiter(',')
        ->expected(2)
        ->check(numberFrom(-kHighest, kHighest));
  }

  /// Returns `reading` with what was given in place of its own. Throws std::runtime_error for a
  /// resolution that none of the maps needs, and for heights with nothing between them.
  ReadingOptions in(const std::vector<std::filesystem::path>& maps,
                    ReadingOptions reading = {}) const
  {
    if (resolution && std::none_of(maps.begin(), maps.end(), isMapImage))
    {
      throw std::runtime_error(maps.front().string() +
                               ": has its own resolution, or needs none; leave --resolution out");
    }
    if (resolution) reading.image_resolution = *resolution;
    if (!heights.empty())
    {
      if (!(heights[0] < heights[1]))
        throw std::runtime_error("--heights LOW,HIGH: LOW is not below HIGH");
      reading.min_height = heights[0];
      reading.max_height = heights[1];
    }
    return reading;
  }
};
}  // namespace sigloc
