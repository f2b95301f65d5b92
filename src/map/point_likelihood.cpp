// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/sensor_model.h"

#include "map/NearestFeature.h"

#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kFar = 1e9;  // [m] stands for any distance that does not count
constexpr double kReachInSigmas = 4.0;  // distance to a feature beyond which it does not count

/// Returns the distance [m] to the nearest wall; kFar outside the map or beyond what the field
/// stores.
double wallDistance(const DenseField& field, const TPoint2D& point)
{
  const DenseCell* cell = cellAt(field, point);
  if (cell == nullptr || cell->distance() == DenseCell::kFar) return kFar;
  return cell->distance() * DenseField::kDistanceUnit;
}

template <class Distance>
double sumOver(const std::vector<TPoint2D>& points, const TPose2D& map_from_robot,
               const PointLikelihoodOptions& options, const Distance& distance)
{
  const double inlier_share = 1.0 - options.outlier_share;
  const double factor = -0.5 / (options.sigma * options.sigma);
  double sum = 0;
  for (const TPoint2D& point : points)
  {
    const double d = distance(map_from_robot.composePoint(point));
    sum += std::log(inlier_share * std::exp(factor * d * d) + options.outlier_share);
  }
  return options.exponent * sum;
}
}  // namespace

std::vector<TPoint2D> thinned(const std::vector<TPoint2D>& points, std::size_t max_points)
{
  if (points.size() <= max_points) return points;
  std::vector<TPoint2D> chosen;
  chosen.reserve(max_points);
  for (std::size_t i = 0; i < max_points; ++i)
  {
    chosen.push_back(points[(2 * i + 1) * points.size() / (2 * max_points)]);
  }
  return chosen;
}

double logLikelihood(const DenseField& field, const std::vector<TPoint2D>& points,
                     const TPose2D& map_from_robot, const PointLikelihoodOptions& options)
{
  return sumOver(points, map_from_robot, options,
                 [&](const TPoint2D& point) { return wallDistance(field, point); });
}

double logLikelihood(const NearestFeature& nearest, const std::vector<TPoint2D>& points,
                     const TPose2D& map_from_robot, const PointLikelihoodOptions& options)
{
  const double reach = kReachInSigmas * options.sigma;
  return sumOver(points, map_from_robot, options,
                 [&](const TPoint2D& point)
                 {
                   const auto hit = nearest.find(point, reach);
                   return hit ? hit->distance : kFar;
                 });
}
}  // namespace sigloc
