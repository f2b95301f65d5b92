// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/line_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <stdexcept>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Returns the variance [m^2] of a return's distance from a line. `cosine` is that of the angle
/// between the normal and the beam. Eq. (2.3)
double normalVariance(double cosine, double range_sigma, double surface_sigma)
{
  return range_sigma * range_sigma * cosine * cosine + surface_sigma * surface_sigma;
}

struct WeightedMoments
{
  double weight = 0;
  TPoint2D mean;
  double xx = 0, xy = 0, yy = 0;  // scatter about the mean
};

WeightedMoments momentsOf(const std::vector<TPoint2D>& points, std::size_t first, std::size_t last,
                          const std::vector<double>& weights)
{
  WeightedMoments m;
  for (std::size_t i = first; i <= last; ++i)
  {
    m.weight += weights[i - first];
    m.mean += points[i] * weights[i - first];
  }
  m.mean *= 1.0 / m.weight;
  for (std::size_t i = first; i <= last; ++i)
  {
    const TPoint2D d = points[i] - m.mean;
    const double w = weights[i - first];
    m.xx += w * d.x * d.x;
    m.xy += w * d.x * d.y;
    m.yy += w * d.y * d.y;
  }
  return m;
}
}  // namespace

LineFit fitLine(const std::vector<TPoint2D>& points, std::size_t first, std::size_t last,
                const TPoint2D& viewpoint, double range_sigma, double surface_sigma)
{
  if (last < first + 1 || last >= points.size())
  {
    throw std::invalid_argument("fitLine: needs at least two points");
  }
  const std::size_t n = last - first + 1;
  std::vector<double> weights(n, 1.0);
  WeightedMoments moments;
  double normal = 0;
  // The weights depend on the normal only through the incidence angle, so one repeat is enough.
  for (int pass = 0; pass < 2; ++pass)
  {
    moments = momentsOf(points, first, last, weights);
    normal = 0.5 * std::atan2(2 * moments.xy, moments.xx - moments.yy) + 0.5 * M_PI;
    for (std::size_t i = 0; i < n; ++i)
    {
      const TPoint2D beam = points[first + i] - viewpoint;
      const double range = std::max(beam.norm(), 1e-6);
      const double cosine = (beam.x * std::cos(normal) + beam.y * std::sin(normal)) / range;
      weights[i] = 1.0 / normalVariance(cosine, range_sigma, surface_sigma);
    }
  }
  moments = momentsOf(points, first, last, weights);
  normal = 0.5 * std::atan2(2 * moments.xy, moments.xx - moments.yy) + 0.5 * M_PI;
  const TPoint2D to_view = viewpoint - moments.mean;
  if (to_view.x * std::cos(normal) + to_view.y * std::sin(normal) < 0) normal += M_PI;

  LineFit fit;
  fit.centroid = moments.mean;
  fit.normal = std::remainder(normal, 2 * M_PI);
  fit.offset_variance = 1.0 / moments.weight;
  const double c = std::cos(normal);
  const double s = std::sin(normal);
  const double along = s * s * moments.xx - 2 * s * c * moments.xy + c * c * moments.yy;
  fit.angle_variance = 1.0 / std::max(along, 1e-12);
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i)
  {
    const TPoint2D d = points[i] - moments.mean;
    sum += (d.x * c + d.y * s) * (d.x * c + d.y * s);
  }
  fit.rms = std::sqrt(sum / static_cast<double>(n));
  return fit;
}

CircleFit fitCircle(const std::vector<TPoint2D>& points, std::size_t first, std::size_t last,
                    const TPoint2D& viewpoint, double range_sigma, double radius_prior_sigma)
{
  if (last < first + 2 || last >= points.size())
  {
    throw std::invalid_argument("fitCircle: needs at least three points");
  }
  const std::size_t n = last - first + 1;
  TPoint2D mean;
  for (std::size_t i = first; i <= last; ++i) mean += points[i];
  mean *= 1.0 / static_cast<double>(n);
  const double mean_range = std::max((mean - viewpoint).norm(), 1e-6);
  const TPoint2D sight = (mean - viewpoint) * (1.0 / mean_range);

  // On average, half a beam spacing on each side of the chord is not seen. Eq. (2.2)
  const double chord = (points[last] - points[first]).norm();
  const double prior_radius =
      std::max(0.5 * chord * (1.0 + 1.0 / static_cast<double>(n - 1)), 0.02);
  const double information = 1.0 / (range_sigma * range_sigma);
  const double prior_information = 1.0 / (radius_prior_sigma * radius_prior_sigma);

  Eigen::Vector3d state(mean.x + sight.x * prior_radius * 0.7,
                        mean.y + sight.y * prior_radius * 0.7, prior_radius);
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  for (int iteration = 0; iteration < 8; ++iteration)
  {
    hessian.setZero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (std::size_t i = first; i <= last; ++i)
    {
      const double dx = points[i].x - state[0];
      const double dy = points[i].y - state[1];
      const double distance = std::max(std::hypot(dx, dy), 1e-6);
      const Eigen::Vector3d jacobian(-dx / distance, -dy / distance, -1.0);
      hessian += information * jacobian * jacobian.transpose();
      gradient += information * jacobian * (distance - state[2]);
    }
    hessian(2, 2) += prior_information;
    gradient[2] += prior_information * (state[2] - prior_radius);
    // Nearly straight returns make the system ill-conditioned, so it is damped a little.
    hessian += 1e-3 * information * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = hessian.ldlt().solve(gradient);
    state -= step;
    state[2] = std::max(state[2], 0.01);
    if (step.norm() < 1e-6) break;
  }

  CircleFit fit;
  fit.centre = {state[0], state[1]};
  fit.radius = state[2];
  const Eigen::Matrix3d covariance = hessian.inverse();
  const Eigen::Vector2d along(sight.x, sight.y);
  const Eigen::Vector2d across(-sight.y, sight.x);
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  fit.radial_variance = along.dot(position * along);
  fit.lateral_variance = across.dot(position * across);
  fit.radius_variance = covariance(2, 2);
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i)
  {
    const double residual = (points[i] - fit.centre).norm() - fit.radius;
    sum += residual * residual;
  }
  fit.rms = std::sqrt(sum / static_cast<double>(n));
  return fit;
}
}  // namespace sigloc
