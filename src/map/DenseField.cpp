// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/DenseField.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sigloc
{
namespace
{
constexpr std::int32_t kNone = std::numeric_limits<std::int16_t>::max();

/// The truncation radius [cells]: what fits both the distance byte and the offset bytes.
std::int32_t truncationRadius(double resolution)
{
  const double by_distance = 254.0 * DenseField::kDistanceUnit / resolution;
  return std::min(127, static_cast<std::int32_t>(std::floor(by_distance)));
}

void checkRaster(const OccupancyRaster& raster)
{
  const RasterFrame& frame = raster.frame;
  if (!(frame.resolution >= 0.005 && frame.resolution <= 1.0))
  {
    throw std::invalid_argument("buildDenseField: resolution outside [0.005, 1] m");
  }
  const std::size_t count = static_cast<std::size_t>(frame.width) * frame.height;
  if (count == 0 || raster.cells.size() != count)
  {
    throw std::invalid_argument("buildDenseField: cell count disagrees with the frame");
  }
}

/// For every cell the signed offset to the nearest wall cell of its column, or kNone.
std::vector<std::int16_t> columnOffsets(const OccupancyRaster& raster, std::int32_t radius)
{
  const std::size_t width = raster.frame.width;
  const std::size_t height = raster.frame.height;
  std::vector<std::int16_t> offsets(width * height, static_cast<std::int16_t>(kNone));
  std::vector<std::int32_t> last(width, -2 * kNone);
  for (std::size_t y = 0; y < height; ++y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      const auto row = static_cast<std::int32_t>(y);
      if (isWall(raster.cells[y * width + x])) last[x] = row;
      if (row - last[x] <= radius)
      {
        offsets[y * width + x] = static_cast<std::int16_t>(last[x] - row);
      }
    }
  }
  std::fill(last.begin(), last.end(), 4 * kNone);
  for (std::size_t y = height; y-- > 0;)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      const auto row = static_cast<std::int32_t>(y);
      if (isWall(raster.cells[y * width + x])) last[x] = row;
      std::int16_t& offset = offsets[y * width + x];
      if (last[x] - row <= radius && last[x] - row < std::abs(offset))
      {
        offset = static_cast<std::int16_t>(last[x] - row);
      }
    }
  }
  return offsets;
}

/// Lower envelope of parabolas over one row: the exact nearest wall cell within the radius.
class RowEnvelope
{
 public:
  explicit RowEnvelope(std::size_t width) : apex_(width), from_(width + 1) {}

  /// Fills `nearest` with the column whose wall cell is nearest to each cell of the row, or -1.
  void solve(const std::int16_t* offsets, std::int32_t width, std::vector<std::int32_t>& nearest)
  {
    std::int32_t count = 0;
    for (std::int32_t x = 0; x < width; ++x)
    {
      if (offsets[x] == kNone) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (count > 0)
      {
        start = crossing(offsets, apex_[index(count - 1)], x);
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

  static double crossing(const std::int16_t* offsets, std::int32_t a, std::int32_t b)
  {
    const double fa = static_cast<double>(offsets[a]) * offsets[a] + static_cast<double>(a) * a;
    const double fb = static_cast<double>(offsets[b]) * offsets[b] + static_cast<double>(b) * b;
    return (fb - fa) / (2.0 * (b - a));
  }

  std::vector<std::int32_t> apex_;
  std::vector<double> from_;
};
}  // namespace

double truncationDistance(double resolution)
{
  return truncationRadius(resolution) * resolution;
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

  const std::vector<std::int16_t> offsets = columnOffsets(raster, radius);
  RowEnvelope envelope(raster.frame.width);
  std::vector<std::int32_t> nearest(raster.frame.width);
  std::size_t free_cells = 0;
  for (std::size_t y = 0; y < height; ++y)
  {
    const std::size_t row = y * raster.frame.width;
    envelope.solve(&offsets[row], width, nearest);
    for (std::int32_t x = 0; x < width; ++x)
    {
      const auto column = static_cast<std::size_t>(x);
      DenseCell& cell = field.cells[row + column];
      cell.state = raster.cells[row + column];
      if (cell.state == CellState::free) ++free_cells;
      if (isWall(cell.state)) ++field.wall_cells;
      if (nearest[column] < 0) continue;
      const std::int32_t dx = nearest[column] - x;
      const std::int32_t dy = offsets[row + static_cast<std::size_t>(nearest[column])];
      if (dx * dx + dy * dy > radius * radius) continue;
      const double distance = resolution * std::sqrt(static_cast<double>(dx * dx + dy * dy));
      cell.distance = static_cast<std::uint8_t>(std::lround(distance / DenseField::kDistanceUnit));
      cell.dx = static_cast<std::int8_t>(dx);
      cell.dy = static_cast<std::int8_t>(dy);
    }
  }
  field.free_area = static_cast<double>(free_cells) * resolution * resolution;
  return field;
}
}  // namespace sigloc
