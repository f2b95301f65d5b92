// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sigloc/map/map_building.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kBorder = 1.5;  // [m] around the outermost return
constexpr double kMaxCells = 4e8;  // refuses absurd extents before allocating

struct Box
{
  TPoint2D low{1e12, 1e12};
  TPoint2D high{-1e12, -1e12};
  void add(const TPoint2D& p)
  {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// Calls `visit(sensor origin, end point)` in the map frame for every valid return within range.
template <class Visit>
void forEachReturn(const PosedScans& posed, double max_range, Visit&& visit)
{
  for (const LaserScan& scan : posed.scans)
  {
    const TPose2D map_from_sensor = posed.map_from_robot + scan.robot_from_sensor;
    const TPoint2D origin(map_from_sensor.x, map_from_sensor.y);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      const double range = static_cast<double>(scan.ranges[i]);
      if (scan.valid[i] == 0 || !std::isfinite(range) || range <= 0 || range > max_range) continue;
      const double angle =
          map_from_sensor.phi + scan.first_angle + static_cast<double>(i) * scan.angle_step;
      visit(origin,
            TPoint2D(origin.x + range * std::cos(angle), origin.y + range * std::sin(angle)));
    }
  }
}

RasterFrame frameOf(const std::vector<PosedScans>& scans, const MapBuildingOptions& options)
{
  Box box;
  for (const PosedScans& posed : scans)
  {
    forEachReturn(posed, options.raster_range,
                  [&](const TPoint2D& origin, const TPoint2D& end)
                  {
                    box.add(origin);
                    box.add(end);
                  });
  }
  if (box.low.x > box.high.x)
  {
    throw std::invalid_argument("rasterFromScans: no scan has a valid return");
  }
  RasterFrame frame;
  frame.resolution = options.raster_resolution;
  frame.origin = {frame.resolution * std::floor((box.low.x - kBorder) / frame.resolution),
                  frame.resolution * std::floor((box.low.y - kBorder) / frame.resolution)};
  const double width = std::ceil((box.high.x + kBorder - frame.origin.x) / frame.resolution);
  const double height = std::ceil((box.high.y + kBorder - frame.origin.y) / frame.resolution);
  if (!(width * height < kMaxCells))
  {
    throw std::invalid_argument("rasterFromScans: the scans spread over too large an area");
  }
  frame.width = static_cast<std::uint32_t>(width);
  frame.height = static_cast<std::uint32_t>(height);
  return frame;
}

std::size_t cellOf(const RasterFrame& frame, const TPoint2D& p)
{
  const auto x = static_cast<std::size_t>((p.x - frame.origin.x) / frame.resolution);
  const auto y = static_cast<std::size_t>((p.y - frame.origin.y) / frame.resolution);
  return y * frame.width + x;
}

/// Marks the cells a beam passes, up to one cell before its end.
void markFree(const RasterFrame& frame, const TPoint2D& origin, const TPoint2D& end,
              std::vector<CellState>& cells)
{
  const TPoint2D beam = end - origin;
  const double length = beam.norm();
  const auto steps = static_cast<std::int64_t>(length / frame.resolution - 1.0);
  for (std::int64_t k = 0; k < steps; ++k)
  {
    const double share = static_cast<double>(k) * frame.resolution / length;
    cells[cellOf(frame, origin + beam * share)] = CellState::free;
  }
}

/// Counts in how many scans each cell was hit (saturating); one scan counts a cell once.
class HitCounter
{
 public:
  explicit HitCounter(const RasterFrame& frame)
      : frame_(frame),
        hits_(static_cast<std::size_t>(frame.width) * frame.height),
        last_(hits_.size(), 0)
  {
  }

  void add(const TPoint2D& end, std::uint32_t scan_stamp)
  {
    const std::size_t cell = cellOf(frame_, end);
    if (last_[cell] == scan_stamp) return;
    last_[cell] = scan_stamp;
    if (hits_[cell] < 255) ++hits_[cell];
  }

  /// A hit cell is wall when it, or it with its neighbours, was hit often enough: a far wall
  /// spreads over two or three cells.
  bool isWall(std::size_t x, std::size_t y, std::uint32_t min_hits) const
  {
    const std::size_t cell = y * frame_.width + x;
    if (hits_[cell] == 0) return false;
    if (hits_[cell] >= min_hits) return true;
    std::uint32_t sum = 0;
    const std::size_t right = std::min<std::size_t>(x + 1, frame_.width - 1);
    const std::size_t top = std::min<std::size_t>(y + 1, frame_.height - 1);
    for (std::size_t j = y == 0 ? 0 : y - 1; j <= top; ++j)
    {
      for (std::size_t i = x == 0 ? 0 : x - 1; i <= right; ++i)
      {
        sum += hits_[j * frame_.width + i];
      }
    }
    return sum > min_hits;
  }

 private:
  const RasterFrame& frame_;
  std::vector<std::uint8_t> hits_;
  std::vector<std::uint32_t> last_;
};
}  // namespace

OccupancyRaster rasterFromScans(const std::vector<PosedScans>& scans,
                                const MapBuildingOptions& options)
{
  OccupancyRaster raster;
  raster.frame = frameOf(scans, options);
  const RasterFrame& frame = raster.frame;
  raster.cells.assign(static_cast<std::size_t>(frame.width) * frame.height, CellState::unknown);

  HitCounter hits(frame);
  std::uint32_t stamp = 0;
  for (const PosedScans& posed : scans)
  {
    ++stamp;
    forEachReturn(posed, options.raster_range,
                  [&](const TPoint2D& origin, const TPoint2D& end)
                  {
                    markFree(frame, origin, end, raster.cells);
                    hits.add(end, stamp);
                  });
  }
  for (std::size_t y = 0; y < frame.height; ++y)
  {
    for (std::size_t x = 0; x < frame.width; ++x)
    {
      if (hits.isWall(x, y, options.min_hits)) raster.cells[y * frame.width + x] = CellState::wall;
    }
  }
  return raster;
}
}  // namespace sigloc
