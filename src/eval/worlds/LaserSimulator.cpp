// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/LaserSimulator.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/plane_products.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMinCellSize = 0.5;  // [m]
constexpr double kMaxLookupCells = 4e6;
constexpr double kMinClutterRange = 0.1;  // [m]

/// Distance along a unit direction to a segment, or infinity.
double rayToSegment(const TPoint2D& origin, const TPoint2D& direction, const WallSegment& segment)
{
  const TPoint2D along = segment.end - segment.start;
  const double denominator = cross(direction, along);
  if (denominator == 0) return kInfinity;  // parallel: seen edge on
  const TPoint2D to_start = segment.start - origin;
  const double share = cross(to_start, direction) / denominator;
  const double distance = cross(to_start, along) / denominator;
  return share >= 0 && share <= 1 && distance > 0 ? distance : kInfinity;
}

/// Distance along a unit direction to the outside of a disc, or infinity; from inside, to its rim.
double rayToDisc(const TPoint2D& origin, const TPoint2D& direction, const Disc& disc)
{
  const TPoint2D to_centre = disc.centre - origin;
  const double middle = to_centre.x * direction.x + to_centre.y * direction.y;
  const double off = cross(direction, to_centre);
  const double half_squared = disc.radius * disc.radius - off * off;
  if (half_squared < 0) return kInfinity;
  const double half = std::sqrt(half_squared);
  if (middle - half > 0) return middle - half;
  return middle + half > 0 ? middle + half : kInfinity;
}
}  // namespace

WorldRayCaster::WorldRayCaster(const World& world)
    : segments_(visibleSegments(world)), discs_(world.discs)
{
  buildCells();
}

void WorldRayCaster::buildCells()
{
  TPoint2D low{kInfinity, kInfinity};
  TPoint2D high{-kInfinity, -kInfinity};
  const auto include = [&](const TPoint2D& p, double margin)
  {
    low = {std::min(low.x, p.x - margin), std::min(low.y, p.y - margin)};
    high = {std::max(high.x, p.x + margin), std::max(high.y, p.y + margin)};
  };
  for (const WallSegment& segment : segments_)
  {
    include(segment.start, 0);
    include(segment.end, 0);
  }
  for (const Disc& disc : discs_) include(disc.centre, disc.radius);
  if (segments_.empty() && discs_.empty()) return;

  constexpr double kMargin = 0.01;  // [m], keeps surfaces off the border of the grid
  grid_origin_ = {low.x - kMargin, low.y - kMargin};
  const double width = high.x - low.x + 2 * kMargin;
  const double height = high.y - low.y + 2 * kMargin;
  cell_size_ = std::max(kMinCellSize, std::sqrt(width * height / kMaxLookupCells));
  columns_ = static_cast<std::int64_t>(width / cell_size_) + 1;
  rows_ = static_cast<std::int64_t>(height / cell_size_) + 1;

  // Counting sort of (cell, surface): count, prefix sums, fill.
  const std::size_t surfaces = segments_.size() + discs_.size();
  cell_starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (std::size_t s = 0; s < surfaces; ++s)
  {
    forEachCellOf(s, [&](std::size_t cell) { ++cell_starts_[cell + 1]; });
  }
  for (std::size_t c = 1; c < cell_starts_.size(); ++c) cell_starts_[c] += cell_starts_[c - 1];
  cell_surfaces_.resize(cell_starts_.back());
  std::vector<std::uint32_t> next(cell_starts_.begin(), cell_starts_.end() - 1);
  for (std::size_t s = 0; s < surfaces; ++s)
  {
    forEachCellOf(
        s, [&](std::size_t cell) { cell_surfaces_[next[cell]++] = static_cast<std::uint32_t>(s); });
  }
}

template <class Visit>
void WorldRayCaster::forEachCellOf(std::size_t surface, Visit&& visit) const
{
  const auto column = [&](double x)
  {
    const auto c = static_cast<std::int64_t>(std::floor((x - grid_origin_.x) / cell_size_));
    return std::clamp<std::int64_t>(c, 0, columns_ - 1);
  };
  const auto row = [&](double y)
  {
    const auto r = static_cast<std::int64_t>(std::floor((y - grid_origin_.y) / cell_size_));
    return std::clamp<std::int64_t>(r, 0, rows_ - 1);
  };
  const auto at = [&](std::int64_t c, std::int64_t r)
  { visit(static_cast<std::size_t>(r * columns_ + c)); };

  if (surface >= segments_.size())
  {
    const Disc& disc = discs_[surface - segments_.size()];
    for (auto r = row(disc.centre.y - disc.radius); r <= row(disc.centre.y + disc.radius); ++r)
    {
      for (auto c = column(disc.centre.x - disc.radius); c <= column(disc.centre.x + disc.radius);
           ++c)
      {
        at(c, r);
      }
    }
    return;
  }
  // Row by row: the columns between the segment's points at the row's lower and upper border,
  // slightly wider so that rounding never loses a cell.
  constexpr double kHair = 1e-9;
  const WallSegment& segment = segments_[surface];
  const bool upward = segment.start.y <= segment.end.y;
  const TPoint2D& bottom = upward ? segment.start : segment.end;
  const TPoint2D& top = upward ? segment.end : segment.start;
  const double rise = top.y - bottom.y;
  for (auto r = row(bottom.y - kHair); r <= row(top.y + kHair); ++r)
  {
    double x0 = bottom.x;
    double x1 = top.x;
    if (rise > 1e-6)
    {
      const double y0 = grid_origin_.y + static_cast<double>(r) * cell_size_;
      const double slope = (top.x - bottom.x) / rise;
      x0 = bottom.x + slope * (std::clamp(y0 - kHair, bottom.y, top.y) - bottom.y);
      x1 = bottom.x + slope * (std::clamp(y0 + cell_size_ + kHair, bottom.y, top.y) - bottom.y);
    }
    const auto last = column(std::max(x0, x1) + kHair);
    for (auto c = column(std::min(x0, x1) - kHair); c <= last; ++c) at(c, r);
  }
}

double WorldRayCaster::nearestInCell(std::size_t cell, const TPoint2D& origin,
                                     const TPoint2D& direction) const
{
  double nearest = kInfinity;
  for (std::uint32_t k = cell_starts_[cell]; k < cell_starts_[cell + 1]; ++k)
  {
    const std::size_t surface = cell_surfaces_[k];
    const double distance = surface < segments_.size()
                                ? rayToSegment(origin, direction, segments_[surface])
                                : rayToDisc(origin, direction, discs_[surface - segments_.size()]);
    nearest = std::min(nearest, distance);
  }
  return nearest;
}

double WorldRayCaster::cast(const TPoint2D& origin, double angle, double max_range) const
{
  if (columns_ == 0) return kInfinity;
  const TPoint2D direction{std::cos(angle), std::sin(angle)};

  // Clip the ray to the grid: [enter, leave] are distances along it.
  double enter = 0;
  double leave = max_range;
  const auto clip = [&](double o, double d, double low, double high)
  {
    if (d == 0)
    {
      if (o < low || o > high) leave = -1;
      return;
    }
    enter = std::max(enter, (d > 0 ? low - o : high - o) / d);
    leave = std::min(leave, (d > 0 ? high - o : low - o) / d);
  };
  clip(origin.x, direction.x, grid_origin_.x,
       grid_origin_.x + cell_size_ * static_cast<double>(columns_));
  clip(origin.y, direction.y, grid_origin_.y,
       grid_origin_.y + cell_size_ * static_cast<double>(rows_));
  if (enter > leave) return kInfinity;

  // Walk the cells (Amanatides and Woo): next_x and next_y are the distances at which the ray
  // crosses into the next column and row.
  const auto cell_of = [&](double value, double grid_low, std::int64_t count)
  {
    const auto c = static_cast<std::int64_t>(std::floor((value - grid_low) / cell_size_));
    return std::clamp<std::int64_t>(c, 0, count - 1);
  };
  std::int64_t column = cell_of(origin.x + enter * direction.x, grid_origin_.x, columns_);
  std::int64_t row = cell_of(origin.y + enter * direction.y, grid_origin_.y, rows_);
  const std::int64_t step_x = direction.x > 0 ? 1 : -1;
  const std::int64_t step_y = direction.y > 0 ? 1 : -1;
  const auto border = [&](std::int64_t cell, double o, double d, double grid_low)
  {
    if (d == 0) return kInfinity;
    return (grid_low + cell_size_ * static_cast<double>(cell + (d > 0 ? 1 : 0)) - o) / d;
  };
  double next_x = border(column, origin.x, direction.x, grid_origin_.x);
  double next_y = border(row, origin.y, direction.y, grid_origin_.y);
  const double width_x = direction.x == 0 ? kInfinity : cell_size_ / std::abs(direction.x);
  const double width_y = direction.y == 0 ? kInfinity : cell_size_ / std::abs(direction.y);

  double nearest = kInfinity;
  double entered = enter;
  while (entered <= leave && entered <= nearest)
  {
    const auto cell = static_cast<std::size_t>(row * columns_ + column);
    nearest = std::min(nearest, nearestInCell(cell, origin, direction));
    entered = std::min(next_x, next_y);
    if (next_x < next_y)
    {
      column += step_x;
      next_x += width_x;
    }
    else
    {
      row += step_y;
      next_y += width_y;
    }
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) break;
  }
  return nearest <= max_range ? nearest : kInfinity;
}

namespace
{
/// Where a beam of a tilted robot goes.
struct TiltedBeam
{
  double turn = 0;  ///< [rad] of its track on the floor against its bearing in the scan
  double stretch = 1;  ///< its length over that of the track
  double floor = kInfinity;  ///< [m] along it to the floor
};

/// `bearing` [rad] in the robot's frame. Level robots get exact zeros and ones.
TiltedBeam tiltedBeam(double bearing, const LaserOptions& options)
{
  TiltedBeam beam;
  if (options.pitch_deg == 0) return beam;
  const double pitch = options.pitch_deg * M_PI / 180.0;
  const double ahead = std::cos(bearing) * std::cos(pitch);
  const double aside = std::sin(bearing);
  const double down = std::cos(bearing) * std::sin(pitch);
  beam.turn = mrpt::math::wrapToPi(std::atan2(aside, ahead) - bearing);
  beam.stretch = 1 / std::hypot(ahead, aside);
  if (down > 0) beam.floor = options.height / down;
  return beam;
}
}  // namespace

LaserSimulator::LaserSimulator(const World& world, const LaserOptions& options)
    : caster_(world), options_(options)
{
  checkOptions(options_);
}

LaserScan LaserSimulator::exactScan(const TPose2D& world_from_robot) const
{
  LaserScan scan;
  const double fov = options_.fov_deg * M_PI / 180.0;
  const bool full_circle = options_.fov_deg > 360.0 - 1e-6;
  const double n = options_.beams;
  const double aperture = full_circle ? fov * (n - 1) / n : fov;
  scan.first_angle = -0.5 * aperture;
  scan.angle_step = aperture / (n - 1);
  scan.max_range = options_.max_range;
  scan.range_sigma = std::max(0.001, options_.range_sigma);
  scan.robot_from_sensor = {options_.sensor_x, options_.sensor_y,
                            options_.sensor_phi_deg * M_PI / 180.0};
  scan.ranges.resize(options_.beams);
  scan.valid.resize(options_.beams);
  const TPose2D world_from_sensor = world_from_robot + scan.robot_from_sensor;
  for (std::uint32_t i = 0; i < options_.beams; ++i)
  {
    const TiltedBeam beam =
        tiltedBeam(scan.robot_from_sensor.phi + scan.first_angle + i * scan.angle_step, options_);
    const double angle = world_from_sensor.phi + scan.first_angle + i * scan.angle_step + beam.turn;
    const double track =
        caster_.cast({world_from_sensor.x, world_from_sensor.y}, angle, options_.max_range);
    const double range = std::min(track * beam.stretch, beam.floor);
    const bool hit = range <= options_.max_range;
    scan.ranges[i] = hit ? static_cast<float>(range) : 0.0F;
    scan.valid[i] = hit ? 1 : 0;
  }
  return scan;
}

LaserScan LaserSimulator::scan(const TPose2D& world_from_robot, Random& random) const
{
  LaserScan scan = exactScan(world_from_robot);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    double range = scan.valid[i] != 0 ? static_cast<double>(scan.ranges[i]) : options_.max_range;
    const bool clutter = random.chance(options_.clutter_share) && range > kMinClutterRange;
    if (!clutter && scan.valid[i] == 0) continue;
    range = clutter ? random.uniform(kMinClutterRange, range)
                    : range + options_.range_sigma * random.normal();
    if (options_.range_step > 0)
    {
      range = options_.range_step * std::round(range / options_.range_step);
    }
    const bool usable = range > 0 && range < options_.max_range;
    scan.ranges[i] = usable ? static_cast<float>(range) : 0.0F;
    scan.valid[i] = usable ? 1 : 0;
  }
  return scan;
}
}  // namespace sigloc
