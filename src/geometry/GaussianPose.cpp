// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/geometry/GaussianPose.h"

#include "geometry/symmetric_matrix.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <stdexcept>

namespace sigloc
{
namespace
{
// The pose is passed by reference, because compilers differ in how they pass it by value.
GaussianPose widened(const GaussianPose& pose, const MapErrorModel& error, double sign)
{
  GaussianPose out = pose;
  out.covariance(0, 0) += sign * error.common_sigma * error.common_sigma;
  out.covariance(1, 1) += sign * error.common_sigma * error.common_sigma;
  out.covariance(2, 2) += sign * error.common_turn_sigma * error.common_turn_sigma;
  return out;
}
}  // namespace

PoseError errorBetween(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth)
{
  return {std::hypot(pose.x - truth.x, pose.y - truth.y),
          std::abs(mrpt::math::wrapToPi(pose.phi - truth.phi))};
}

bool isRight(const PoseError& error, const AccuracyGates& gates)
{
  return error.distance <= gates.right_distance && error.angle <= gates.right_angle;
}

bool isWrong(const PoseError& error, const AccuracyGates& gates)
{
  return !(error.distance <= gates.wrong_distance && error.angle <= gates.wrong_angle);
}

GaussianPose composeWithMotion(const GaussianPose& map_from_previous,
                               const MotionIncrement& increment)
{
  const double c = std::cos(map_from_previous.mean.phi);
  const double s = std::sin(map_from_previous.mean.phi);
  const mrpt::math::TPose2D& motion = increment.mean;
  const double dx = c * motion.x - s * motion.y;
  const double dy = s * motion.x + c * motion.y;

  // Jacobian by the earlier pose: identity plus the lever arm of the heading.
  const Symmetric3 p = toSymmetric(map_from_previous.covariance);
  const double xt = p.xt - dy * p.tt;
  const double yt = p.yt + dx * p.tt;
  // Jacobian by the motion: a rotation into the map frame.
  const Symmetric3 q = toSymmetric(increment.covariance);
  const Symmetric2 turned = rotated({q.xx, q.xy, q.yy}, c, s);

  Symmetric3 sum;
  sum.xx = p.xx - 2 * dy * p.xt + dy * dy * p.tt + turned.xx;
  sum.xy = p.xy + dx * p.xt - dy * p.yt - dx * dy * p.tt + turned.xy;
  sum.xt = xt + c * q.xt - s * q.yt;
  sum.yy = p.yy + 2 * dx * p.yt + dx * dx * p.tt + turned.yy;
  sum.yt = yt + s * q.xt + c * q.yt;
  sum.tt = p.tt + q.tt;
  return {{map_from_previous.mean.x + dx, map_from_previous.mean.y + dy,
           mrpt::math::wrapToPi(map_from_previous.mean.phi + motion.phi)},
          toMatrix(sum)};
}

double squaredMahalanobisDistance(const GaussianPose& a, const GaussianPose& b)
{
  const Symmetric3 p = toSymmetric(a.covariance);
  const Symmetric3 q = toSymmetric(b.covariance);
  const auto information =
      inverse({p.xx + q.xx, p.xy + q.xy, p.xt + q.xt, p.yy + q.yy, p.yt + q.yt, p.tt + q.tt});
  if (!information)
  {
    throw std::invalid_argument("squaredMahalanobisDistance: covariance is not positive definite");
  }
  const double x = a.mean.x - b.mean.x;
  const double y = a.mean.y - b.mean.y;
  const double t = mrpt::math::wrapToPi(a.mean.phi - b.mean.phi);
  return x * x * information->xx + y * y * information->yy + t * t * information->tt +
         2 * (x * y * information->xy + x * t * information->xt + y * t * information->yt);
}

GaussianPose withCommonError(const GaussianPose& pose, const MapErrorModel& error)
{
  return widened(pose, error, +1);
}

GaussianPose withoutCommonError(const GaussianPose& pose, const MapErrorModel& error)
{
  return widened(pose, error, -1);
}
}  // namespace sigloc
