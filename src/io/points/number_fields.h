// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/points/point_files.h"

// What the readers of files of points share.
namespace sigloc::detail
{
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A kind of number in a binary file.
struct NumberKind
{
  std::string_view name;
  std::size_t bytes;
  double (*read)(const char* at, bool swapped);
};

/// Returns the kind of a name, or null. The names are those of PLY, and those of PCD's TYPE and
/// SIZE together: F4.
const NumberKind* kindOf(std::string_view name);

/// Returns the whole number from 0 to 4e9 that a word spells.
std::optional<std::size_t> countIn(std::string_view word);

constexpr std::size_t kMostHead = 65536;  // bytes of a header
constexpr std::uint64_t kLongestRow = 4096;  // bytes of a point as text

/// What a header tells of the data up to the last point.
struct PointData
{
  double least = 0;  ///< bytes it takes
  double most = 0;  ///< bytes in which it is, the header included
};

/// Reads what a file of points holds up to there. Throws std::runtime_error "path: reason" for a
/// file that is damaged, or smaller than its data.
std::string bytesOfPoints(GzipInput& input, const PointData& data);

/// Takes the next line off a text.
std::string_view takeLine(std::string_view& text);

/// Where the coordinates are in a row of numbers.
using Places = std::array<std::size_t, 3>;

/// Reads `count` rows of a text. Rows with a word for a number, such as "nan", are no points.
/// Throws std::runtime_error "path: reason" where there are fewer.
PointList textRows(std::string_view text, std::size_t count, const Places& places,
                   const std::filesystem::path& path);

/// Adds a point, unless a coordinate is no number.
void addPoint(PointList& points, double x, double y, double z);
}  // namespace sigloc::detail
