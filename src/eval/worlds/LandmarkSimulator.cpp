// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/LandmarkSimulator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
Feature pointFeature(const TPoint2D& place, double sigma)
{
  Feature feature;
  feature.type = FeatureType::point;
  feature.position = place;
  feature.position_covariance.setIdentity();
  feature.position_covariance *= sigma * sigma;
  return feature;
}

TPoint2D disturbed(const TPoint2D& place, double sigma, Random& random)
{
  const double x = place.x + sigma * random.normal();
  return {x, place.y + sigma * random.normal()};
}
}  // namespace

LandmarkSimulator::LandmarkSimulator(const World& world, const LandmarkSensorOptions& options)
    : options_(options), bounds_(world.bounds), points_(world.points)
{
  checkOptions(options_);
  cell_size_ = options_.range;
  columns_ = static_cast<std::size_t>((bounds_.x_max - bounds_.x_min) / cell_size_) + 1;
  rows_ = static_cast<std::size_t>((bounds_.y_max - bounds_.y_min) / cell_size_) + 1;
  cell_starts_.assign(columns_ * rows_ + 1, 0);
  for (const TPoint2D& p : points_) ++cell_starts_[cellOf(p) + 1];
  for (std::size_t c = 1; c < cell_starts_.size(); ++c) cell_starts_[c] += cell_starts_[c - 1];
  cell_points_.resize(points_.size());
  std::vector<std::uint32_t> next(cell_starts_.begin(), cell_starts_.end() - 1);
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    cell_points_[next[cellOf(points_[i])]++] = static_cast<std::uint32_t>(i);
  }
}

std::size_t LandmarkSimulator::cellOf(const TPoint2D& p) const
{
  const auto clamped = [&](double offset, std::size_t count)
  {
    const double cell = std::floor(offset / cell_size_);
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
  };
  return clamped(p.y - bounds_.y_min, rows_) * columns_ + clamped(p.x - bounds_.x_min, columns_);
}

LandmarkObservation LandmarkSimulator::observe(const mrpt::math::TPose2D& world_from_robot,
                                               Random& random) const
{
  std::vector<std::pair<TPoint2D, std::int32_t>> seen;
  const TPoint2D robot{world_from_robot.x, world_from_robot.y};
  const double range = options_.range;
  const std::size_t low = cellOf({robot.x - range, robot.y - range});
  const std::size_t high = cellOf({robot.x + range, robot.y + range});
  for (std::size_t row = low / columns_; row <= high / columns_; ++row)
  {
    for (std::size_t column = low % columns_; column <= high % columns_; ++column)
    {
      const std::size_t cell = row * columns_ + column;
      for (std::uint32_t k = cell_starts_[cell]; k < cell_starts_[cell + 1]; ++k)
      {
        const TPoint2D d = points_[cell_points_[k]] - robot;
        if (std::hypot(d.x, d.y) > range || !random.chance(options_.seen_share)) continue;
        const TPoint2D exact = world_from_robot.inverseComposePoint(points_[cell_points_[k]]);
        seen.emplace_back(disturbed(exact, options_.sigma, random),
                          static_cast<std::int32_t>(cell_points_[k]));
      }
    }
  }
  const double share = options_.spurious_share;
  const double expected = static_cast<double>(seen.size()) * share / (1 - share);
  const auto spurious = static_cast<std::size_t>(expected + random.uniform());
  for (std::size_t i = 0; i < spurious; ++i)
  {
    const double distance = range * std::sqrt(random.uniform());  // uniform over the area
    const double bearing = random.uniform(-M_PI, M_PI);
    seen.emplace_back(TPoint2D{distance * std::cos(bearing), distance * std::sin(bearing)}, -1);
  }
  // Shuffled: the order must not show which ones are spurious.
  for (std::size_t i = seen.size(); i > 1; --i) std::swap(seen[i - 1], seen[random.index(i)]);

  LandmarkObservation observation;
  for (const auto& [place, source] : seen)
  {
    observation.features.push_back(pointFeature(place, options_.sigma));
    observation.sources.push_back(source);
  }
  return observation;
}

std::vector<Feature> LandmarkSimulator::mappedLandmarks(Random& random) const
{
  std::vector<Feature> mapped;
  mapped.reserve(points_.size());
  for (const TPoint2D& p : points_)
  {
    mapped.push_back(pointFeature(disturbed(p, options_.map_sigma, random), options_.map_sigma));
  }
  return mapped;
}
}  // namespace sigloc
