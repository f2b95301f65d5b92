// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/FeatureWorld.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
FeatureType drawType(const std::array<double, kFeatureTypes>& weights, Random& random)
{
  double left = random.uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t t = 0; t < weights.size(); ++t)
  {
    left -= weights[t];
    if (left < 0) return static_cast<FeatureType>(t);
  }
  return FeatureType::point;
}

Feature randomFeature(const FeatureWorldOptions& options, Random& random)
{
  Feature feature;
  feature.type = drawType(options.type_weights, random);
  feature.position_covariance.setZero();
  const FeatureTraits& traits = traitsOf(feature.type);
  if (hasDirection(feature.type)) feature.direction = random.uniform(-M_PI, M_PI);
  if (traits.size == FeatureSize::length)
  {
    feature.size = random.uniform(1.0, 4.0);
  }
  else if (traits.size == FeatureSize::opening)
  {
    feature.size = random.chance(0.5) ? 0.5 * M_PI : 1.5 * M_PI;
  }
  else if (traits.size != FeatureSize::none)
  {
    feature.size = random.uniform(0.1, 0.5);
  }
  if (traits.has_side) feature.side = random.chance(0.5) ? WallSide::start : WallSide::end;
  return feature;
}

/// Disturbs a feature by independent errors and sets its covariance accordingly.
Feature disturbed(const Feature& feature, double sigma, double angle_sigma, Random& random)
{
  Feature out = feature;
  out.position.x += sigma * random.normal();
  out.position.y += sigma * random.normal();
  out.position_covariance(0, 0) += sigma * sigma;
  out.position_covariance(1, 1) += sigma * sigma;
  if (hasDirection(feature.type))
  {
    out.direction = mrpt::math::wrapToPi(out.direction + angle_sigma * random.normal());
    out.direction_variance += angle_sigma * angle_sigma;
  }
  if (isRound(feature.type))
  {
    out.size = std::max(0.01, out.size + sigma * random.normal());
    out.size_variance += sigma * sigma;
  }
  return out;
}

/// A segment is seen in part: at least 60 % of it.
void cutPiece(Feature& segment, Random& random)
{
  const double share = random.uniform(0.6, 1.0);
  const double shift = random.uniform(-0.5, 0.5) * (1 - share) * segment.size;
  segment.position = segment.position + tangentVector(segment) * shift;
  segment.size *= share;
}
}  // namespace

FeatureWorld makeFeatureWorld(std::size_t count, const FeatureWorldOptions& options, Random& random)
{
  FeatureWorld world;
  world.side = std::sqrt(static_cast<double>(count) / options.density);
  world.truth.reserve(count);
  world.mapped.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    Feature feature = randomFeature(options, random);
    feature.position = {random.uniform(0, world.side), random.uniform(0, world.side)};
    world.truth.push_back(feature);
    world.mapped.push_back(disturbed(feature, options.map_sigma, options.map_angle_sigma, random));
  }
  return world;
}

TPose2D randomPose(const FeatureWorld& world, const FeatureWorldOptions& options, Random& random)
{
  const double margin = std::min(options.range, 0.4 * world.side);
  const double x = random.uniform(margin, world.side - margin);
  const double y = random.uniform(margin, world.side - margin);
  return {x, y, random.uniform(-M_PI, M_PI)};
}

std::vector<Feature> observeFeatures(const FeatureWorld& world, const TPose2D& map_from_robot,
                                     const FeatureWorldOptions& options, Random& random,
                                     std::size_t wanted)
{
  const TPose2D robot_from_map = TPose2D(0, 0, 0) - map_from_robot;
  std::vector<Feature> seen;
  for (const Feature& feature : world.truth)
  {
    const TPoint2D offset = feature.position - TPoint2D{map_from_robot.x, map_from_robot.y};
    if (offset.norm() > options.range || !random.chance(options.detection)) continue;
    Feature visible = transformed(robot_from_map, feature);
    if (isSegment(visible.type)) cutPiece(visible, random);
    seen.push_back(disturbed(visible, options.observation_sigma, options.angle_sigma, random));
  }
  const auto shuffle = [&](std::vector<Feature>& features)
  {
    for (std::size_t k = features.size(); k > 1; --k)
    {
      std::swap(features[k - 1], features[random.index(k)]);
    }
  };
  shuffle(seen);
  const auto real =
      static_cast<std::size_t>(std::lround(static_cast<double>(wanted) * (1 - options.spurious)));
  if (wanted > 0 && seen.size() > real) seen.resize(real);
  const auto spurious = static_cast<std::size_t>(
      std::lround(static_cast<double>(seen.size()) * options.spurious / (1 - options.spurious)));
  for (std::size_t k = 0; k < spurious; ++k)
  {
    Feature feature = randomFeature(options, random);
    const double radius = options.range * std::sqrt(random.uniform());
    const double bearing = random.uniform(-M_PI, M_PI);
    feature.position = {radius * std::cos(bearing), radius * std::sin(bearing)};
    seen.push_back(disturbed(feature, options.observation_sigma, options.angle_sigma, random));
  }
  shuffle(seen);
  return seen;
}
}  // namespace sigloc
