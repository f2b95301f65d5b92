// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "features/feature_values.h"

namespace sigloc
{
namespace
{
constexpr double kReach = 1e5;  // [m], where single floats are 8 mm apart
constexpr double kFinest = 0.005;  // [m] of cells
constexpr double kCoarsest = 1.0;
constexpr double kLargestError = 100.0;  // [m] of a map
constexpr double kRounding = 1e-6;  // relative, of sums of cells

bool isWithin(double value, double low, double high)
{
  return value >= low && value <= high;  // false for NaN
}
}  // namespace

std::optional<std::string> beyondReach(double x, double y)
{
  if (std::abs(x) <= kReach && std::abs(y) <= kReach) return std::nullopt;
  return fmt::format(
      "reaches ({:.10g}, {:.10g}) m; beyond {:.0f} m from the origin places are kept no better "
      "than a centimetre: shift the map's origin to where the robot is",
      x, y, kReach);
}

std::optional<std::string> unusableCells(double resolution)
{
  if (isWithin(resolution, kFinest, kCoarsest)) return std::nullopt;
  return fmt::format("cells of {:g} m, not of {:g} to {:g} m", resolution, kFinest, kCoarsest);
}

std::optional<std::string> flawOf(const RasterFrame& frame, double most_cells)
{
  if (auto reason = unusableCells(frame.resolution)) return reason;
  const double cells = static_cast<double>(frame.width) * frame.height;
  if (!isWithin(cells, 1, most_cells))
  {
    return fmt::format("a raster of {} x {} cells, not of 1 to {:g}", frame.width, frame.height,
                       most_cells);
  }
  if (auto reason = beyondReach(frame.origin.x, frame.origin.y)) return reason;
  return beyondReach(frame.origin.x + frame.width * frame.resolution,
                     frame.origin.y + frame.height * frame.resolution);
}

namespace
{
std::optional<std::string> flawOfTiles(const DenseField& field)
{
  const std::size_t rows = (field.frame.height + DenseField::kTileSide - 1) / DenseField::kTileSide;
  const std::size_t stored = field.cells.size() / DenseField::kTileCells;
  const bool sound = field.tiles.size() == field.tileColumns() * rows && stored > 0 &&
                     stored * DenseField::kTileCells == field.cells.size() &&
                     std::all_of(field.tiles.begin(), field.tiles.end(),
                                 [&](std::uint32_t tile) { return tile < stored; });
  if (sound) return std::nullopt;
  return fmt::format("a raster of {} tiles and {} cells in a frame of {} x {}", field.tiles.size(),
                     field.cells.size(), field.frame.width, field.frame.height);
}
}  // namespace

std::optional<std::string> flawOf(const DenseField& field)
{
  if (auto reason = flawOf(field.frame, field.isTiled() ? kMostTiledCells : kMostCells))
  {
    return reason;
  }
  const std::size_t cells = std::size_t{field.frame.width} * field.frame.height;
  if (field.isTiled())
  {
    if (auto reason = flawOfTiles(field)) return reason;
  }
  else if (field.cells.size() != cells)
  {
    return fmt::format("a raster of {} cells in a frame of {}", field.cells.size(), cells);
  }
  const double whole = static_cast<double>(cells) * field.frame.resolution * field.frame.resolution;
  if (!isWithin(field.free_area, 0, whole * (1 + kRounding)) || field.wall_cells > cells)
  {
    return fmt::format("a raster of {:g} m^2 with {:g} m^2 of free area and {} wall cells", whole,
                       field.free_area, field.wall_cells);
  }
  return std::nullopt;
}

std::optional<std::string> flawOf(const MapErrorModel& error)
{
  if (isWithin(error.relative_constant, 0, kLargestError) && isWithin(error.relative_slope, 0, 1) &&
      isWithin(error.common_sigma, 0, kLargestError) && isWithin(error.common_turn_sigma, 0, M_PI))
  {
    return std::nullopt;
  }
  return fmt::format("a map error of {:g} m, {:g} m/m, {:g} m and {:g} rad",
                     error.relative_constant, error.relative_slope, error.common_sigma,
                     error.common_turn_sigma);
}

namespace
{
std::optional<std::string> wallBeyondReach(const Feature& feature)
{
  if (!isSegment(feature.type)) return std::nullopt;
  const mrpt::math::TPoint2D start = segmentStart(feature);
  const mrpt::math::TPoint2D end = segmentEnd(feature);
  auto flaw = beyondReach(start.x, start.y);
  return flaw ? flaw : beyondReach(end.x, end.y);
}
}  // namespace

std::optional<std::string> flawOf(const std::vector<Feature>& features)
{
  double outline = 0;
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    const mrpt::math::TPoint2D& at = features[k].position;
    auto flaw = std::isfinite(at.x) && std::isfinite(at.y) ? beyondReach(at.x, at.y) : std::nullopt;
    if (flaw) return flaw;
    flaw = flawOf(features[k], features.size());
    if (flaw) return fmt::format("feature {} {}", k, *flaw);
    flaw = wallBeyondReach(features[k]);
    if (flaw) return flaw;
    outline += outlineLength(features[k]);
  }
  if (outline <= kLongestOutline) return std::nullopt;
  return fmt::format("its features are {:g} m long together, not at most {:g} m", outline,
                     kLongestOutline);
}
}  // namespace sigloc
