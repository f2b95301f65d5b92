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
constexpr std::uint16_t kSolidScans = 2;  // that must have hit a solid wall
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
    if (!std::isfinite(origin.x) || !std::isfinite(origin.y) || !std::isfinite(map_from_sensor.phi))
    {
      throw std::invalid_argument("rasterFromScans: the pose of a scan is not finite");
    }
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

/// Counts, cell by cell, the scans that hit it and the beams that hit and passed it (saturating).
class BeamCounter
{
 public:
  explicit BeamCounter(const RasterFrame& frame)
      : frame_(frame), counts_(static_cast<std::size_t>(frame.width) * frame.height)
  {
  }

  /// A beam passes the cells up to one cell before its end, which it hits.
  void add(const TPoint2D& origin, const TPoint2D& end, std::uint32_t scan_stamp)
  {
    const TPoint2D beam = end - origin;
    const double length = beam.norm();
    const auto steps = static_cast<std::int64_t>(length / frame_.resolution - 1.0);
    for (std::int64_t k = 0; k < steps; ++k)
    {
      const double share = static_cast<double>(k) * frame_.resolution / length;
      increase(counts_[cellOf(frame_, origin + beam * share)].passes);
    }
    Count& hit = counts_[cellOf(frame_, end)];
    increase(hit.hits);
    if (hit.last_scan == scan_stamp) return;
    hit.last_scan = scan_stamp;
    increase(hit.scans);
  }

  CellState stateOf(std::size_t x, std::size_t y, std::uint32_t min_scans) const
  {
    const Count& count = counts_[y * frame_.width + x];
    if (!hitOften(x, y, min_scans)) return count.passes > 0 ? CellState::free : CellState::unknown;
    const bool solid = count.scans >= kSolidScans && count.hits >= count.passes;
    return solid ? CellState::solid_wall : CellState::wall;
  }

 private:
  struct Count
  {
    std::uint32_t last_scan = 0;
    std::uint16_t hits = 0;
    std::uint16_t passes = 0;
    std::uint16_t scans = 0;
  };

  static void increase(std::uint16_t& count)
  {
    if (count < 65535) ++count;
  }

  /// A cell was hit often enough by itself or, once hit, together with its neighbours: a far wall
  /// spreads over two or three cells.
  bool hitOften(std::size_t x, std::size_t y, std::uint32_t min_scans) const
  {
    const Count& count = counts_[y * frame_.width + x];
    if (count.scans == 0) return false;
    if (count.scans >= min_scans) return true;
    std::uint32_t sum = 0;
    const std::size_t right = std::min<std::size_t>(x + 1, frame_.width - 1);
    const std::size_t top = std::min<std::size_t>(y + 1, frame_.height - 1);
    for (std::size_t j = y == 0 ? 0 : y - 1; j <= top; ++j)
    {
      for (std::size_t i = x == 0 ? 0 : x - 1; i <= right; ++i)
      {
        sum += counts_[j * frame_.width + i].scans;
      }
    }
    return sum >= min_scans;
  }

  const RasterFrame& frame_;
  std::vector<Count> counts_;
};
}  // namespace

OccupancyRaster rasterFromScans(const std::vector<PosedScans>& scans,
                                const MapBuildingOptions& options)
{
  OccupancyRaster raster;
  raster.frame = frameOf(scans, options);
  const RasterFrame& frame = raster.frame;
  raster.cells.resize(static_cast<std::size_t>(frame.width) * frame.height);

  BeamCounter counter(frame);
  std::uint32_t stamp = 0;
  for (const PosedScans& posed : scans)
  {
    ++stamp;
    forEachReturn(posed, options.raster_range,
                  [&](const TPoint2D& origin, const TPoint2D& end)
                  { counter.add(origin, end, stamp); });
  }
  for (std::size_t y = 0; y < frame.height; ++y)
  {
    for (std::size_t x = 0; x < frame.width; ++x)
    {
      raster.cells[y * frame.width + x] = counter.stateOf(x, y, options.min_hits);
    }
  }
  return raster;
}
}  // namespace sigloc
