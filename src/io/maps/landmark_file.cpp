// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "features/feature_values.h"
#include "io/archive/file_fault.h"
#include "io/maps/map_source_readers.h"
#include "io/text_rows.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
constexpr double kDefaultSigma = 0.05;  // [m]
constexpr double kMostMetres = 1e7;

/// The column of each quantity; -1: there is none.
struct Columns
{
  int x = 0;
  int y = 1;
  int radius = 2;
  int sigma = 3;
  int label = -1;
};

/// Returns the columns a header row names, or nullopt for a row that names no x and y.
std::optional<Columns> columnsOf(const std::vector<std::string_view>& row)
{
  const auto find = [&](std::string_view name)
  {
    const auto at = std::find(row.begin(), row.end(), name);
    return at == row.end() ? -1 : static_cast<int>(at - row.begin());
  };
  Columns columns{find("x"), find("y"), find("radius"), find("sigma"), find("label")};
  if (columns.radius < 0) columns.radius = find("r");
  if (columns.x < 0 || columns.y < 0) return std::nullopt;
  return columns;
}

Feature toLandmark(const std::vector<std::string_view>& row, const Columns& columns,
                   const std::filesystem::path& path, std::size_t line)
{
  const auto value = [&](int column, const char* name, double missing)
  {
    if (column < 0 || static_cast<std::size_t>(column) >= row.size()) return missing;
    const auto number = toNumber(row[static_cast<std::size_t>(column)]);
    if (!number || std::abs(*number) > kMostMetres)
    {
      failAtLine(path, line, std::string("bad ") + name);
    }
    return *number;
  };
  const auto needed = static_cast<std::size_t>(std::max(columns.x, columns.y)) + 1;
  if (row.size() < needed) failAtLine(path, line, "too few columns");
  Feature landmark;
  landmark.position = {value(columns.x, "x", 0), value(columns.y, "y", 0)};
  landmark.size = value(columns.radius, "radius", 0);
  const double sigma = value(columns.sigma, "sigma", kDefaultSigma);
  if (landmark.size < 0) failAtLine(path, line, "negative radius");
  if (!(sigma > 0)) failAtLine(path, line, "sigma is not positive");
  const double label = value(columns.label, "label", -1);
  if (label != std::floor(label)) failAtLine(path, line, "label is no whole number");
  landmark.position_covariance(0, 0) = landmark.position_covariance(1, 1) = sigma * sigma;
  landmark.label = static_cast<std::int32_t>(label);
  if (landmark.size > 0)
  {
    landmark.type = FeatureType::circle;
    landmark.size_variance = sigma * sigma;
  }
  return landmark;
}
}  // namespace

FeatureMap readLandmarks(const std::filesystem::path& path)
{
  std::vector<Feature> landmarks;
  Crowding crowding;
  Columns columns;
  for (TextLines lines(path); lines.next();)
  {
    const std::size_t i = lines.index();
    std::string_view line = lines.line();
    const bool comment = !line.empty() && line.front() == '#';
    if (comment) line.remove_prefix(1);
    const auto row = columnsIn(line, path, i);
    if (row.empty()) continue;
    if (const auto named = landmarks.empty() ? columnsOf(row) : std::nullopt)
    {
      columns = *named;
    }
    else if (!comment)
    {
      if (line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos)
      {
        failAtLine(path, i, "both ',' and ';' in it: write decimal points");
      }
      landmarks.push_back(toLandmark(row, columns, path, i));
      if (const auto flaw = crowding.add(landmarks.back()))
        failAtLine(path, i, "a landmark that " + *flaw);
    }
  }
  if (landmarks.empty()) fail(path, "no landmark in it");
  if (const auto flaw = flawOf(landmarks)) fail(path, *flaw);
  return FeatureMap(std::move(landmarks));
}
}  // namespace sigloc::detail
