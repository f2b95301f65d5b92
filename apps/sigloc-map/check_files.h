// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "map_check.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
/// The names of a check's files in its folder.
struct CheckFiles
{
  static constexpr const char* kPlaces = "places.csv";
  static constexpr const char* kTwins = "twins.csv";
  static constexpr const char* kSummary = "summary.json";
  static constexpr const char* kPicture = "check.png";
};

/// Throws std::runtime_error where a check could replace an input, or a file that no check wrote.
void checkCheckFolder(const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& inputs);

/// Writes all but the picture.
void writeCheckFiles(const MapCheck& check, const std::string& map,
                     const std::filesystem::path& folder);

/// What is printed: a table of one line each, and the worst twins.
std::string checkTable(const MapCheck& check);

/// Reads poses, one a row: `x y deg` in metres and degrees; lines that begin with # are comments.
/// Throws std::runtime_error ("file: reason"), also for a pose outside the bounds.
std::vector<mrpt::math::TPose2D> readPoses(const std::filesystem::path& file,
                                           const PlanarBox& bounds);
}  // namespace sigloc
