// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/symmetric_matrix.h"
#include "sigloc/geometry/GaussianPose.h"

#include <mrpt/math/TPoint2D.h>

#include <array>
#include <cmath>

namespace sigloc
{
/// A Gaussian pose for inner loops: with the cosine and sine of the heading, and the covariance as
/// six numbers.
struct PoseEstimate
{
  double x = 0;  ///< [m]
  double y = 0;  ///< [m]
  double heading = 0;  ///< [rad]
  double c = 1;  ///< cosine of the heading
  double s = 0;  ///< sine of the heading
  Symmetric3 covariance;

  mrpt::math::TPoint2D place(const mrpt::math::TPoint2D& in_robot) const
  {
    return {x + c * in_robot.x - s * in_robot.y, y + s * in_robot.x + c * in_robot.y};
  }
  mrpt::math::TPoint2D turn(const mrpt::math::TPoint2D& in_robot) const
  {
    return {c * in_robot.x - s * in_robot.y, s * in_robot.x + c * in_robot.y};
  }
  void setHeading(double value)
  {
    heading = value;
    c = std::cos(value);
    s = std::sin(value);
  }
};

PoseEstimate toEstimate(const GaussianPose& pose);
/// Heading wrapped into (-pi, pi].
GaussianPose toGaussian(const PoseEstimate& estimate);

/// One or two scalars measured of a pose: residual z - h(x), Jacobian dh/d(x, y, heading) and the
/// covariance R of the noise. A single scalar has a second row of zeros with unit noise, which has
/// no effect.
struct PlanarMeasurement
{
  std::array<double, 2> residual{};
  std::array<std::array<double, 3>, 2> jacobian{};
  Symmetric2 noise{1, 0, 1};
  int degrees = 2;  ///< of freedom: 1 or 2
};

/// Returns the covariance of the residual, H P H' + R.
inline Symmetric2 innovationCovariance(const Symmetric3& p, const PlanarMeasurement& m)
{
  const auto& a = m.jacobian[0];
  const auto& b = m.jacobian[1];
  const double pax = p.xx * a[0] + p.xy * a[1] + p.xt * a[2];
  const double pay = p.xy * a[0] + p.yy * a[1] + p.yt * a[2];
  const double pat = p.xt * a[0] + p.yt * a[1] + p.tt * a[2];
  const double pbx = p.xx * b[0] + p.xy * b[1] + p.xt * b[2];
  const double pby = p.xy * b[0] + p.yy * b[1] + p.yt * b[2];
  const double pbt = p.xt * b[0] + p.yt * b[1] + p.tt * b[2];
  return {a[0] * pax + a[1] * pay + a[2] * pat + m.noise.xx,
          b[0] * pax + b[1] * pay + b[2] * pat + m.noise.xy,
          b[0] * pbx + b[1] * pby + b[2] * pbt + m.noise.yy};
}

/// Returns the normalised innovation squared: chi-square with `m.degrees` degrees of freedom.
inline double squaredInnovation(const PlanarMeasurement& m, const Symmetric2& innovation)
{
  return squaredNorm(m.residual[0], m.residual[1], innovation);
}

/// Updates the estimate by a measurement, as a Kalman filter does. \cite algorithm eq. (5.5)
void update(PoseEstimate& estimate, const PlanarMeasurement& m);

/// Adds H' R^-1 H to the information matrix and H' R^-1 r to the vector: one term of the normal
/// equations. \cite algorithm eq. (5.8)
void addInformation(const PlanarMeasurement& m, Symmetric3& information,
                    std::array<double, 3>& vector);
}  // namespace sigloc
