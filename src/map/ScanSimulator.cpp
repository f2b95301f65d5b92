// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>
#include <random>

#include "map/RayCaster.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kSector = 0.2;  // [rad] with one error of the map
constexpr double kThinSector = 0.1;  // [rad] in which rarely hit objects are there or not
constexpr double kUnknownSector = 0.05;  // [rad] with one surface in unknown space
constexpr double kStride = 0.25;  // [m] along a beam
constexpr double kNearest = 0.5;  // [m] of an unmapped object
constexpr double kNarrowest = 0.1;  // [m] width of an object
constexpr double kWidest = 0.6;  // [m]
constexpr double kMostShare = 0.9;  // of the beams of one scan that meet objects
constexpr int kMostObjects = 1000;  // in a scan, for each kind

/// Random numbers that are the same on every machine: the distributions of the standard library are
/// not.
class Draw
{
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double exponential(double mean) { return -mean * std::log(1.0 - uniform()); }
  double normal(double sigma)
  {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return sigma * radius * std::cos(2.0 * M_PI * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

/// One scan while it is made: exact ranges first, then what differs from the map.
class ScanInMaking
{
 public:
  ScanInMaking(const DenseField& field, const SimulatedLaserOptions& options,
               const TPose2D& map_from_sensor, std::uint64_t seed)
      : caster_(field), options_(options), origin_(map_from_sensor), draw_(seed)
  {
    const auto sectors = [&](double width)
    { return static_cast<std::size_t>(options.beams * options.angle_step / width) + 2; };
    offsets_.resize(sectors(kSector));
    for (double& offset : offsets_) offset = draw_.normal(options.map_sigma);
    unknown_.resize(sectors(kUnknownSector));
    for (double& depth : unknown_) depth = draw_.exponential(options.unknown_range);
    thin_.resize(sectors(kThinSector));
    for (double& chance : thin_) chance = draw_.uniform();
    for (std::size_t i = 0; i < options.beams; ++i) ranges_.push_back(cast(i, 0));
  }

  /// Mapped objects that are gone: the beams go on to what is behind.
  void removeObjects()
  {
    constexpr double kBehind = 0.2;  // [m]
    coverShare(
        options_.moved_share,
        [&](std::size_t first, std::size_t last, double range)
        {
          for (std::size_t i = first; i <= last; ++i)
          {
            if (ranges_[i] && std::abs(*ranges_[i] - range) < kWidest)
              ranges_[i] = cast(i, *ranges_[i] + kBehind);
          }
        },
        [](double range) { return range; });
  }

  /// Objects that the map does not have.
  void addObjects()
  {
    coverShare(
        options_.clutter_share,
        [&](std::size_t first, std::size_t last, double range)
        {
          for (std::size_t i = first; i <= last; ++i)
          {
            if (!ranges_[i] || *ranges_[i] > range) ranges_[i] = range;
          }
        },
        [&](double range) { return draw_.uniform(std::min(kNearest, range), range); });
  }

  /// The scan, with the errors of range and map.
  LaserScan scan()
  {
    LaserScan scan;
    scan.first_angle = options_.first_angle;
    scan.angle_step = options_.angle_step;
    scan.max_range = options_.max_range;
    scan.robot_from_sensor = {options_.sensor_x, options_.sensor_y, options_.sensor_phi};
    for (std::size_t i = 0; i < ranges_.size(); ++i)
    {
      const double noise = draw_.normal(options_.range_sigma) + offsets_[sectorOf(i, kSector)];
      const bool lost = draw_.uniform() < options_.lost_share;
      const double range = ranges_[i] ? *ranges_[i] + noise : 0;
      const bool valid = !lost && range > 0.01 && range < options_.max_range;
      scan.ranges.push_back(valid ? static_cast<float>(range) : 0.0F);
      scan.valid.push_back(valid ? 1 : 0);
    }
    return scan;
  }

 private:
  std::size_t sectorOf(std::size_t beam, double width) const
  {
    return static_cast<std::size_t>(static_cast<double>(beam) * options_.angle_step / width);
  }

  /// The range of a beam that begins at `start` [m]: to a wall, or to a surface in unknown space.
  std::optional<double> cast(std::size_t beam, double start)
  {
    const double angle =
        origin_.phi + options_.first_angle + static_cast<double>(beam) * options_.angle_step;
    double left = unknown_[sectorOf(beam, kUnknownSector)];
    double before = start;
    bool in_unknown = false;
    double beyond = 0;  // [m], from where the walk ends to where the beam does
    std::optional<double> passed;  // [m], to the last wall that did not stop the beam
    const bool thin_there = thin_[sectorOf(beam, kThinSector)] < options_.thin_share;
    const TPoint2D direction(std::cos(angle), std::sin(angle));
    const auto goes_on = [&](double range, const DenseCell& cell)
    {
      if (in_unknown) left -= range - before;
      before = range;
      in_unknown = cell.state() == CellState::unknown;
      const bool backed = options_.backed_within > 0 && passed;
      if (in_unknown && backed && range - *passed < options_.backed_within)
      {
        beyond = *passed - range;  // no mapping beam has passed that wall
        return false;
      }
      if (left <= 0)
      {
        beyond = left;  // the surface was passed
        return false;
      }
      if (cell.state() == CellState::wall) passed = range + ridgeAhead(cell, direction, range);
      const bool stops =
          cell.state() == CellState::solid_wall || (cell.state() == CellState::wall && thin_there);
      if (stops) beyond = ridgeAhead(cell, direction, range);
      return !stops;
    };
    const TPoint2D origin(origin_.x, origin_.y);
    const auto range = caster_.walk(origin, angle, start, options_.max_range, kStride, goes_on);
    if (range) return *range + beyond;
    return range;
  }

  /// How far beyond a range [m] the ridge of the wall is that stops the beam there.
  double ridgeAhead(const DenseCell& cell, const TPoint2D& direction, double range) const
  {
    const RasterFrame& frame = caster_.field().frame;
    const TPoint2D place = TPoint2D(origin_.x, origin_.y) + direction * range - frame.origin;
    const auto middle = [&](double along)
    { return (std::floor(along / frame.resolution) + 0.5) * frame.resolution; };
    const double dx = middle(place.x) + cell.dx * DenseField::kOffsetUnit - place.x;
    const double dy = middle(place.y) + cell.dy * DenseField::kOffsetUnit - place.y;
    return dx * direction.x + dy * direction.y;
  }

  /// Puts objects anywhere until about a share of the beams meets one. `range_of` tells the range
  /// of an object in the direction of a return, and `apply` is told its beams and range.
  template <class Apply, class RangeOf>
  void coverShare(double mean_share, const Apply& apply, const RangeOf& range_of)
  {
    if (mean_share <= 0) return;
    const double share = std::min(draw_.exponential(mean_share), kMostShare);
    double left = share * static_cast<double>(ranges_.size());
    for (int k = 0; k < kMostObjects && left > 0; ++k)
    {
      const auto middle =
          static_cast<std::size_t>(draw_.uniform() * static_cast<double>(ranges_.size()));
      const double range = range_of(ranges_[middle].value_or(options_.max_range));
      const double half = 0.5 * draw_.uniform(kNarrowest, kWidest) / std::max(range, kNearest);
      const auto reach = static_cast<std::size_t>(half / options_.angle_step);
      const std::size_t first = middle - std::min(middle, reach);
      const std::size_t last = std::min(middle + reach, ranges_.size() - 1);
      const auto covered = static_cast<double>(last - first + 1);
      // The last object has more beams than are left: it is there by chance.
      if (covered * draw_.uniform() < left) apply(first, last, range);
      left -= covered;
    }
  }

  RayCaster caster_;
  const SimulatedLaserOptions& options_;
  TPose2D origin_;
  Draw draw_;
  std::vector<double> offsets_;  // [m], of the map's error in a sector
  std::vector<double> thin_;  // in [0, 1), against the share of rarely hit objects
  std::vector<double> unknown_;  // [m], through unknown space to a surface
  std::vector<std::optional<double>> ranges_;
};
}  // namespace

ScanSimulator::ScanSimulator(const DenseField& field, const SimulatedLaserOptions& options)
    : field_(field), options_(options)
{
  checkOptions(options);
}

LaserScan ScanSimulator::scan(const TPose2D& map_from_robot, std::uint64_t seed) const
{
  const TPose2D mount(options_.sensor_x, options_.sensor_y, options_.sensor_phi);
  ScanInMaking making(field_, options_, map_from_robot + mount, seed);
  making.removeObjects();
  making.addObjects();
  return making.scan();
}
}  // namespace sigloc
