// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/points_raster.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/points/number_fields.h"
#include "map/map_values.h"
#include "map/RayCaster.h"

namespace sigloc::detail
{
namespace
{
using mrpt::math::TPoint2D;

constexpr double kMargin = 0.5;  // [m] around the walls

/// Returns the points that a planar laser would see, seen from above.
std::vector<TPoint2D> pointsInBand(const PointList& points, const ReadingOptions& reading,
                                   const std::filesystem::path& path)
{
  constexpr double kFlat = 0.01;  // [m]
  if (points.empty()) fail(path, "no point in it");
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const auto lowest = static_cast<double>(low->z);
  const auto highest = static_cast<double>(high->z);
  const bool flat = highest - lowest < kFlat;
  std::vector<TPoint2D> kept;
  for (const auto& point : points)
  {
    const auto z = static_cast<double>(point.z);
    if (flat || (z >= reading.min_height && z <= reading.max_height))
      kept.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
  }
  if (kept.empty())
  {
    fail(path, fmt::format("no point at a height of {:g} to {:g} m; they are at {:.2f} to {:.2f} "
                           "m, see --heights",
                           reading.min_height, reading.max_height, lowest, highest));
  }
  return kept;
}

RasterFrame frameAround(const std::vector<TPoint2D>& points, double resolution,
                        const std::filesystem::path& path)
{
  TPoint2D low = points.front();
  TPoint2D high = points.front();
  for (const TPoint2D& point : points)
  {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  }
  for (const TPoint2D& corner : {low, high})
  {
    if (const auto reason = beyondReach(corner.x, corner.y)) fail(path, *reason);
  }
  RasterFrame frame;
  frame.resolution = resolution;
  frame.origin = {low.x - kMargin, low.y - kMargin};
  frame.width = static_cast<std::uint32_t>(std::ceil((high.x - low.x + 2 * kMargin) / resolution));
  frame.height = static_cast<std::uint32_t>(std::ceil((high.y - low.y + 2 * kMargin) / resolution));
  if (const auto flaw = flawOf(frame)) fail(path, *flaw);
  // So that no memory is taken for a map of a few points that lie far apart.
  constexpr double kMostOfPoint = 2e4;
  constexpr double kAlways = 1e6;
  const double cells = static_cast<double>(frame.width) * frame.height;
  if (cells > std::max(kAlways, kMostOfPoint * static_cast<double>(points.size())))
  {
    fail(path, fmt::format("{} points are too few for a map of {:.0f} m x {:.0f} m", points.size(),
                           high.x - low.x, high.y - low.y));
  }
  return frame;
}

/// A point in its cell.
struct Hit
{
  std::size_t cell;
  double x;  // [cells] from its middle
  double y;
};

/// Returns the hits in the order of their cells.
std::vector<Hit> hitsOf(const std::vector<TPoint2D>& points, const RasterFrame& frame)
{
  std::vector<Hit> hits;
  hits.reserve(points.size());
  for (const TPoint2D& point : points)
  {
    const double x = (point.x - frame.origin.x) / frame.resolution;
    const double y = (point.y - frame.origin.y) / frame.resolution;
    hits.push_back({static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x),
                    x - std::floor(x) - 0.5, y - std::floor(y) - 0.5});
  }
  std::stable_sort(hits.begin(), hits.end(),
                   [](const Hit& a, const Hit& b) { return a.cell < b.cell; });
  return hits;
}

/// Returns the raster with its walls; all else is unknown.
OccupancyRaster wallsOf(const std::vector<Hit>& hits, const RasterFrame& frame)
{
  const std::size_t size = std::size_t{frame.width} * frame.height;
  OccupancyRaster raster{frame, std::vector<CellState>(size, CellState::unknown), {}};
  raster.hits.resize(size);
  for (auto hit = hits.begin(); hit != hits.end();)
  {
    const std::size_t cell = hit->cell;
    double x = 0;
    double y = 0;
    int count = 0;
    for (; hit != hits.end() && hit->cell == cell; ++hit, ++count)
    {
      x += hit->x;
      y += hit->y;
    }
    const auto unit = [count](double sum)
    { return static_cast<std::int8_t>(std::lround(sum / count / WallHits::kUnit)); };
    raster.cells[cell] = CellState::solid_wall;
    raster.hits[cell] = {unit(x), unit(y),
                         static_cast<std::uint8_t>(std::min<int>(count, WallHits::kMostWeight))};
  }
  return raster;
}

/// Returns whether walls are lines of cells: most wall cells have two others beside them. It is
/// asked before memory is taken for all cells.
bool areLines(const std::vector<Hit>& hits, std::size_t width)
{
  constexpr double kMost = 0.7;
  std::vector<std::size_t> walls;
  for (const Hit& hit : hits)
  {
    if (walls.empty() || walls.back() != hit.cell) walls.push_back(hit.cell);
  }
  std::size_t linked = 0;
  for (const std::size_t wall : walls)
  {
    std::ptrdiff_t beside = 0;
    // No wall is at the border, because of the margin.
    for (const std::size_t middle : {wall - width, wall, wall + width})
    {
      const auto first = std::lower_bound(walls.begin(), walls.end(), middle - 1);
      const auto last = first + std::min<std::ptrdiff_t>(3, walls.end() - first);
      beside += std::upper_bound(first, last, middle + 1) - first;
    }
    linked += beside >= 3 ? 1 : 0;  // with itself
  }
  return static_cast<double>(linked) >= kMost * static_cast<double>(walls.size());
}

constexpr double kBlock = 0.4;  // [m] side of the blocks that are guessed to be free or not
constexpr double kRange = 30;  // [m] how far from a place its walls may be

/// The blocks of cells that are guessed to be free or not, each by its middle.
class Blocks
{
 public:
  Blocks(const std::vector<Hit>& hits, const RasterFrame& frame)
      : half_(static_cast<std::uint32_t>(std::lround(kBlock / 2 / frame.resolution))),
        reach_(static_cast<std::uint32_t>(kRange / (half_ * frame.resolution)) + 2),
        columns_((frame.width + half_ - 1) / half_),
        rows_((frame.height + half_ - 1) / half_),
        sums_(std::size_t{columns_ + 1} * (rows_ + 1))
  {
    for (const Hit& hit : hits)
    {
      const auto x = static_cast<std::uint32_t>(hit.cell % frame.width);
      const auto y = static_cast<std::uint32_t>(hit.cell / frame.width);
      ++sums_[indexOf(x / half_ + 1, y / half_ + 1)];
    }
    for (std::uint32_t y = 1; y <= rows_; ++y)
    {
      for (std::uint32_t x = 1; x <= columns_; ++x)
      {
        sums_[indexOf(x, y)] +=
            sums_[indexOf(x - 1, y)] + sums_[indexOf(x, y - 1)] - sums_[indexOf(x - 1, y - 1)];
      }
    }
  }

  std::uint32_t side() const { return 2 * half_; }  // [cells]
  std::uint32_t columns() const { return columns_ / 2; }  // whose middle is in the frame
  std::uint32_t rows() const { return rows_ / 2; }

  /// Returns whether there are walls to each of the four sides of a block's middle. Without them,
  /// the rays to one side all meet none.
  bool hasWallsAround(std::uint32_t column, std::uint32_t row) const
  {
    const std::uint32_t x = 2 * column + 1;
    const std::uint32_t y = 2 * row + 1;
    const std::uint32_t left = x - std::min(x, reach_);
    const std::uint32_t below = y - std::min(y, reach_);
    const std::uint32_t right = std::min(x + reach_, columns_);
    const std::uint32_t above = std::min(y + reach_, rows_);
    return anyIn(left, x, below, above) && anyIn(x, right, below, above) &&
           anyIn(left, right, below, y) && anyIn(left, right, y, above);
  }

  /// Returns whether a place has walls around it.
  bool anyHasWallsAround() const
  {
    for (std::uint32_t row = 0; row < rows(); ++row)
    {
      for (std::uint32_t column = 0; column < columns(); ++column)
      {
        if (hasWallsAround(column, row)) return true;
      }
    }
    return false;
  }

 private:
  std::size_t indexOf(std::uint32_t x, std::uint32_t y) const
  {
    return std::size_t{y} * (columns_ + 1) + x;
  }
  bool anyIn(std::uint32_t left, std::uint32_t right, std::uint32_t below,
             std::uint32_t above) const
  {
    return sums_[indexOf(right, above)] + sums_[indexOf(left, below)] !=
           sums_[indexOf(left, above)] + sums_[indexOf(right, below)];
  }

  // Walls are counted in squares of half a side, so that a middle is a corner of four.
  std::uint32_t half_;  // [cells]
  std::uint32_t reach_;  // [squares] of a ray
  std::uint32_t columns_;
  std::uint32_t rows_;
  std::vector<std::uint32_t> sums_;  // walls in all squares to the left and below
};

/// Returns whether a place is among walls: most rays from it meet one.
bool isEnclosed(const RayCaster& caster, const TPoint2D& place)
{
  constexpr int kRays = 24;
  constexpr int kMostOpen = 10;  // fewer than go to one side
  int open = 0;
  int closed = 0;
  for (int i = 0; open <= kMostOpen && closed < kRays - kMostOpen; ++i)
  {
    ++(caster.cast(place, 2 * M_PI * i / kRays, kRange) ? closed : open);
  }
  return open <= kMostOpen;
}

/// Makes free what is guessed to be, each block by its middle.
void guessFreeSpace(const Blocks& blocks, OccupancyRaster& raster)
{
  const DenseField field = buildDenseField(raster);
  const RayCaster caster(field);
  const RasterFrame& frame = raster.frame;
  const std::uint32_t side = blocks.side();
  for (std::uint32_t row = 0; row < blocks.rows(); ++row)
  {
    for (std::uint32_t column = 0; column < blocks.columns(); ++column)
    {
      if (!blocks.hasWallsAround(column, row)) continue;
      const std::uint32_t x0 = column * side;
      const std::uint32_t y0 = row * side;
      const TPoint2D middle(frame.origin.x + (x0 + 0.5 * side) * frame.resolution,
                            frame.origin.y + (y0 + 0.5 * side) * frame.resolution);
      const DenseCell* const cell = cellAt(field, middle);
      if (cell == nullptr || isWall(cell->state()) || !isEnclosed(caster, middle)) continue;
      for (std::uint32_t y = y0; y < std::min(y0 + side, frame.height); ++y)
      {
        for (std::uint32_t x = x0; x < std::min(x0 + side, frame.width); ++x)
        {
          CellState& state = raster.cells[std::size_t{y} * frame.width + x];
          if (state == CellState::unknown) state = CellState::free;
        }
      }
    }
  }
}
}  // namespace

OccupancyRaster rasterOfPoints(const PointList& points, const ReadingOptions& reading,
                               const std::filesystem::path& path)
{
  const std::vector<TPoint2D> kept = pointsInBand(points, reading, path);
  RasterFrame frame;
  std::vector<Hit> hits;
  bool lines = false;
  for (const double resolution : {0.05, 0.1, 0.2})
  {
    frame = frameAround(kept, resolution, path);
    hits = hitsOf(kept, frame);
    lines = areLines(hits, frame.width);
    if (lines) break;
  }
  // Rays from everywhere in so large a map take minutes.
  constexpr double kMostWithoutLines = 6e6;  // cells of 0.2 m: a quarter of a square kilometre
  if (!lines && static_cast<double>(frame.width) * frame.height > kMostWithoutLines)
  {
    fail(path,
         fmt::format("{} points scattered over {:.0f} m x {:.0f} m, which make no walls",
                     kept.size(), frame.width * frame.resolution, frame.height * frame.resolution));
  }
  const Blocks blocks(hits, frame);
  if (!blocks.anyHasWallsAround()) fail(path, "the grid has no free cell");
  OccupancyRaster raster = wallsOf(hits, frame);
  guessFreeSpace(blocks, raster);
  return raster;
}
}  // namespace sigloc::detail
