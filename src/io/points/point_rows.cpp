// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/points/number_fields.h"
#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kFewestPoints = 100;
constexpr double kApart = 0.15;  // [m] landmarks nearer to each other are not told apart
constexpr double kFarthest = 1e7;  // [m]

using Row = std::vector<std::string_view>;

bool names(const Row& row, std::string_view name)
{
  return std::find(row.begin(), row.end(), name) != row.end();
}

/// Returns the point of a row without names, or nullopt for a row that is none.
std::optional<mrpt::math::TPoint3Df> pointOf(const Row& row)
{
  constexpr std::size_t kPlanar = 2;
  if (row.size() < kPlanar) return std::nullopt;
  const auto x = toNumber(row[0]);
  const auto y = toNumber(row[1]);
  const auto z = row.size() > kPlanar ? toNumber(row[2]) : std::optional(0.0);
  if (!x || !y || !z || std::abs(*x) > kFarthest || std::abs(*y) > kFarthest) return std::nullopt;
  return mrpt::math::TPoint3Df(static_cast<float>(*x), static_cast<float>(*y),
                               static_cast<float>(*z));
}

/// Returns whether most points have another near them.
bool areDense(const PointList& points)
{
  const auto key_of = [](double x, double y)
  {
    const auto column = static_cast<std::int32_t>(std::floor(x / kApart));
    const auto row = static_cast<std::int32_t>(std::floor(y / kApart));
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U) |
           static_cast<std::uint32_t>(row);
  };
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    cells[key_of(static_cast<double>(points[i].x), static_cast<double>(points[i].y))].push_back(i);
  const auto has_neighbour = [&](std::size_t i)
  {
    const auto x = static_cast<double>(points[i].x);
    const auto y = static_cast<double>(points[i].y);
    for (const double dx : {-kApart, 0.0, kApart})
    {
      for (const double dy : {-kApart, 0.0, kApart})
      {
        const auto cell = cells.find(key_of(x + dx, y + dy));
        if (cell == cells.end()) continue;
        // Of a cell with several points one is near enough: not all need to be looked at.
        const std::size_t other =
            cell->second.front() != i ? cell->second.front() : cell->second.back();
        if (other != i && std::hypot(static_cast<double>(points[other].x) - x,
                                     static_cast<double>(points[other].y) - y) <= kApart)
          return true;
      }
    }
    return false;
  };
  std::size_t near = 0;
  for (std::size_t i = 0; i < points.size(); ++i) near += has_neighbour(i) ? 1 : 0;
  return 2 * near > points.size();
}
}  // namespace

std::optional<PointList> pointRowsOf(const std::filesystem::path& path)
{
  PointList points;
  bool named = false;
  std::size_t columns = 0;  // of the first row
  std::size_t last = 0;  // line with a row
  std::optional<std::size_t> odd;  // the first line with a row that is not like the first
  for (TextLines lines(path); lines.next();)
  {
    const std::size_t i = lines.index();
    std::string_view line = lines.line();
    const bool comment = !line.empty() && (line.front() == '#' || line.front() == '%');
    if (comment) line.remove_prefix(1);
    const Row row = columnsIn(line, path, i);
    if (row.empty()) continue;
    if (points.empty() && names(row, "x") && names(row, "y"))
    {
      // Names in the order of a cloud; any other order, and a radius, are those of landmarks.
      named = row.size() > 2 && row[0] == "x" && row[1] == "y" && row[2] == "z";
      if (!named) return std::nullopt;
      continue;
    }
    if (comment) continue;
    const auto point = pointOf(row);
    if (columns == 0) columns = row.size();
    if (!odd && (!point || row.size() != columns)) odd = i;
    if (point) points.push_back(*point);
    last = i;
  }
  if (points.empty() || (!named && points.size() < kFewestPoints)) return std::nullopt;
  if (!areDense(points)) return std::nullopt;
  if (odd && *odd == last) fail(path, "its last row is cut off or damaged");
  if (odd) failAtLine(path, *odd, fmt::format("no point of {} numbers as the others", columns));
  return points;
}
}  // namespace sigloc::detail
