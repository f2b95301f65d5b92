// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/DenseField.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "geometry/LargeVector.h"
#include "map/field_tiles.h"
#include "map/map_values.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPoint2Df;

namespace
{
constexpr double kRidgeRadius = 0.05;  // [m] within which hits belong to a wall's ridge, eq. (6.12)
constexpr std::int8_t kNone = std::numeric_limits<std::int8_t>::min();  // no wall in reach

/// Returns the truncation radius [cells], which fits both the distance and the offset bytes.
std::int32_t truncationRadius(double resolution)
{
  const double by_distance = (DenseCell::kFar - 1) * DenseField::kDistanceUnit / resolution;
  return std::min(127, static_cast<std::int32_t>(std::floor(by_distance)));
}

/// Returns half the width [cells] of the window in which a wall's ridge is computed.
std::int32_t ridgeRadius(double resolution)
{
  return std::max(1, static_cast<std::int32_t>(std::lround(kRidgeRadius / resolution)));
}

void checkRaster(const OccupancyRaster& raster)
{
  const RasterFrame& frame = raster.frame;
  if (const auto reason = unusableCells(frame.resolution)) throw std::invalid_argument(*reason);
  const std::size_t count = static_cast<std::size_t>(frame.width) * frame.height;
  if (count == 0 || raster.cells.size() != count)
  {
    throw std::invalid_argument("buildDenseField: cell count disagrees with the frame");
  }
  if (!raster.hits.empty() && raster.hits.size() != count)
  {
    throw std::invalid_argument("buildDenseField: the count of hits disagrees with the frame");
  }
  if (std::any_of(raster.hits.begin(), raster.hits.end(),
                  [](const WallHits& hits) { return hits.weight == 0; }))
  {
    throw std::invalid_argument("buildDenseField: hits without weight");
  }
}

/// Rounds half away from zero, as std::round, without its call.
std::int8_t offsetByte(double metres)
{
  const double units = metres / DenseField::kOffsetUnit;
  const auto whole = static_cast<std::int32_t>(units);
  const auto away = static_cast<std::int32_t>(2 * (units - whole));
  return static_cast<std::int8_t>(std::clamp(whole + away, -127, 127));
}

/// Returns the distance in units of a field by its square [cells²], up to that of the radius.
std::vector<std::uint8_t> distanceUnits(double resolution, std::int32_t radius)
{
  std::vector<std::uint8_t> units;
  for (std::int32_t square = 0; square <= radius * radius; ++square)
  {
    const double distance = resolution * std::sqrt(static_cast<double>(square));
    units.push_back(static_cast<std::uint8_t>(std::lround(distance / DenseField::kDistanceUnit)));
  }
  return units;
}

/// Counts, for each column, the rows since its last wall cell, up to `most`.
void countRow(const CellState* cells, std::uint8_t most, std::vector<std::uint8_t>& since)
{
  for (std::size_t x = 0; x < since.size(); ++x)
  {
    const auto next = static_cast<std::uint8_t>(since[x] < most ? since[x] + 1 : most);
    since[x] = isWall(cells[x]) ? std::uint8_t{0} : next;
  }
}

/// Returns for every cell the signed offset to the nearest wall cell of its column, or kNone. Its
/// loops have no branches, so that they run on many columns at once.
std::vector<std::int8_t> columnOffsets(const OccupancyRaster& raster, std::int32_t radius)
{
  const std::size_t width = raster.frame.width;
  const std::size_t height = raster.frame.height;
  const auto most = static_cast<std::uint8_t>(radius + 1);
  std::vector<std::int8_t> offsets(width * height);
  std::vector<std::uint8_t> since(width, most);
  for (std::size_t y = 0; y < height; ++y)
  {
    countRow(&raster.cells[y * width], most, since);
    std::int8_t* const row = &offsets[y * width];
    for (std::size_t x = 0; x < width; ++x)
      row[x] = static_cast<std::int8_t>(since[x] < most ? -since[x] : kNone);
  }
  std::fill(since.begin(), since.end(), most);
  for (std::size_t y = height; y-- > 0;)
  {
    countRow(&raster.cells[y * width], most, since);
    std::int8_t* const row = &offsets[y * width];
    for (std::size_t x = 0; x < width; ++x)
    {
      const std::int8_t below = row[x];
      const auto distance = static_cast<std::uint8_t>(-below);  // of kNone 128, farther than any
      const bool nearer = since[x] < most && since[x] < distance;
      row[x] = nearer ? static_cast<std::int8_t>(since[x]) : below;
    }
  }
  return offsets;
}

/// The ridges of walls, row by row: no more rows are kept than a distance reaches.
class RidgeRows
{
 public:
  /// The raster must outlive it. A ridge can be asked for up to `reach` rows from the last one.
  RidgeRows(const OccupancyRaster& raster, std::int32_t reach)
      : raster_(raster),
        width_(static_cast<std::int32_t>(raster.frame.width)),
        height_(static_cast<std::int32_t>(raster.frame.height)),
        kept_(2 * reach + 1),
        reach_(reach),
        ridges_(raster.frame.width * static_cast<std::size_t>(std::min(kept_, height_)))
  {
  }

  /// Goes on to row y. Rows must be visited in order.
  void advanceTo(std::int32_t y)
  {
    for (; made_ < std::min(y + reach_ + 1, height_); ++made_)
    {
      for (std::int32_t x = 0; x < width_; ++x)
      {
        if (isWall(raster_.cells[cellOf(x, made_)])) ridges_[placeOf(x, made_)] = ridgeAt(x, made_);
      }
    }
  }

  /// Returns the vector [m] from the middle of the wall cell (x, y) to the ridge of its wall.
  const TPoint2Df& at(std::int32_t x, std::int32_t y) const { return ridges_[placeOf(x, y)]; }

 private:
  std::size_t cellOf(std::int32_t x, std::int32_t y) const
  {
    return static_cast<std::size_t>(y) * raster_.frame.width + static_cast<std::size_t>(x);
  }
  std::size_t placeOf(std::int32_t x, std::int32_t y) const { return cellOf(x, y % kept_); }

  /// The ridge is the mean of the hits in the wall cells around. Noise makes mapped walls several
  /// cells thick, and the ridge is where most hits were. Eq. (6.12)
  TPoint2Df ridgeAt(std::int32_t x, std::int32_t y) const
  {
    const std::int32_t radius = ridgeRadius(raster_.frame.resolution);
    std::int32_t sum = 0;
    TPoint2D moment(0, 0);
    for (std::int32_t j = std::max(-radius, -y); j <= std::min(radius, height_ - 1 - y); ++j)
    {
      for (std::int32_t i = std::max(-radius, -x); i <= std::min(radius, width_ - 1 - x); ++i)
      {
        const std::size_t beside = cellOf(x + i, y + j);
        if (!isWall(raster_.cells[beside])) continue;
        const WallHits hits = raster_.hits.empty() ? WallHits{} : raster_.hits[beside];
        sum += hits.weight;
        moment += TPoint2D(i + WallHits::kUnit * hits.x, j + WallHits::kUnit * hits.y) *
                  static_cast<double>(hits.weight);
      }
    }
    return TPoint2Df(moment * (raster_.frame.resolution / sum));
  }

  const OccupancyRaster& raster_;
  std::int32_t width_;
  std::int32_t height_;
  std::int32_t kept_;
  std::int32_t reach_;
  std::int32_t made_ = 0;  // rows so far
  std::vector<TPoint2Df> ridges_;
};

/// The lower envelope of parabolas over one row, which gives the exact nearest wall cell within the
/// radius.
class RowEnvelope
{
 public:
  explicit RowEnvelope(std::size_t width) : height_(width), apex_(width), from_(width + 1) {}

  /// Fills `nearest` with the column whose wall cell is nearest to each cell of the row, or -1.
  void solve(const std::int8_t* offsets, std::int32_t width, std::vector<std::int32_t>& nearest)
  {
    for (std::int32_t x = 0; x < width; ++x)
      height_[index(x)] = static_cast<double>(offsets[x]) * offsets[x] + static_cast<double>(x) * x;
    std::int32_t count = 0;
    for (std::int32_t x = 0; x < width; ++x)
    {
      if (offsets[x] == kNone) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (count > 0)
      {
        start = crossing(apex_[index(count - 1)], x);
        if (start > from_[index(count - 1)]) break;
        --count;
        start = -std::numeric_limits<double>::infinity();
      }
      apex_[index(count)] = x;
      from_[index(count)] = start;
      ++count;
    }
    std::int32_t k = 0;
    for (std::int32_t x = 0; x < width; ++x)
    {
      if (count == 0)
      {
        nearest[index(x)] = -1;
        continue;
      }
      while (k + 1 < count && from_[index(k + 1)] <= static_cast<double>(x)) ++k;
      nearest[index(x)] = apex_[index(k)];
    }
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  double crossing(std::int32_t a, std::int32_t b) const
  {
    return (height_[index(b)] - height_[index(a)]) / (2.0 * (b - a));
  }

  std::vector<double> height_;  // of each column's parabola at column 0
  std::vector<std::int32_t> apex_;
  std::vector<double> from_;
};
}  // namespace

void* allocateCells(std::size_t bytes)
{
  return allocateTable(bytes + 1);
}

void freeCells(void* cells) noexcept
{
  freeTable(cells);
}

double truncationDistance(double resolution)
{
  return truncationRadius(resolution) * resolution;
}

std::int32_t fieldReach(double resolution)
{
  return truncationRadius(resolution) + ridgeRadius(resolution);
}

DenseField buildDenseField(const OccupancyRaster& raster)
{
  checkRaster(raster);
  const auto width = static_cast<std::int32_t>(raster.frame.width);
  const std::size_t height = raster.frame.height;
  const double resolution = raster.frame.resolution;
  const std::int32_t radius = truncationRadius(resolution);

  DenseField field;
  field.frame = raster.frame;
  field.cells.resize(raster.cells.size());

  const std::vector<std::int8_t> offsets = columnOffsets(raster, radius);
  const std::vector<std::uint8_t> units = distanceUnits(resolution, radius);
  RidgeRows ridges(raster, radius);
  RowEnvelope envelope(raster.frame.width);
  std::vector<std::int32_t> nearest(raster.frame.width);
  std::size_t free_cells = 0;
  for (std::size_t y = 0; y < height; ++y)
  {
    const std::size_t row = y * raster.frame.width;
    envelope.solve(&offsets[row], width, nearest);
    ridges.advanceTo(static_cast<std::int32_t>(y));
    for (std::int32_t x = 0; x < width; ++x)
    {
      const auto column = static_cast<std::size_t>(x);
      DenseCell& cell = field.cells[row + column];
      const CellState state = raster.cells[row + column];
      cell = DenseCell(state);
      if (state == CellState::free) ++free_cells;
      if (isWall(state)) ++field.wall_cells;
      if (nearest[column] < 0) continue;
      const std::int32_t dx = nearest[column] - x;
      const std::int32_t dy = offsets[row + static_cast<std::size_t>(nearest[column])];
      const std::int32_t square = dx * dx + dy * dy;
      if (square > radius * radius) continue;
      cell = DenseCell(state, units[static_cast<std::size_t>(square)]);
      const TPoint2Df& ridge = ridges.at(nearest[column], static_cast<std::int32_t>(y) + dy);
      cell.dx = offsetByte(dx * resolution + static_cast<double>(ridge.x));
      cell.dy = offsetByte(dy * resolution + static_cast<double>(ridge.y));
    }
  }
  field.free_area = static_cast<double>(free_cells) * resolution * resolution;
  return field;
}

OccupancyRaster rasterOf(const DenseField& field)
{
  if (field.isTiled()) return rasterOf(wholeField(field));
  const double units = DenseField::kOffsetUnit / (field.frame.resolution * WallHits::kUnit);
  const auto hit_byte = [&](std::int8_t offset)
  { return static_cast<std::int8_t>(std::clamp(std::lround(offset * units), -127L, 127L)); };
  OccupancyRaster raster;
  raster.frame = field.frame;
  raster.cells.reserve(field.cells.size());
  raster.hits.resize(field.cells.size());
  for (const DenseCell& cell : field.cells)
  {
    if (isWall(cell.state()))
      raster.hits[raster.cells.size()] = {hit_byte(cell.dx), hit_byte(cell.dy)};
    raster.cells.push_back(cell.state());
  }
  return raster;
}
}  // namespace sigloc
