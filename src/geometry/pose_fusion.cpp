// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pose_fusion.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <stdexcept>

namespace sigloc
{
using mrpt::math::wrapToPi;

namespace
{
Eigen::Matrix3d toEigen(const mrpt::math::CMatrixDouble33& m)
{
  Eigen::Matrix3d out;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) out(r, c) = m(r, c);
  }
  return out;
}

/// Symmetrises the matrix, so that rounding errors do not add up over the steps.
mrpt::math::CMatrixDouble33 fromEigen(const Eigen::Matrix3d& m)
{
  mrpt::math::CMatrixDouble33 out;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) out(r, c) = 0.5 * (m(r, c) + m(c, r));
  }
  return out;
}

Eigen::Vector3d difference(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b)
{
  return {a.x - b.x, a.y - b.y, wrapToPi(a.phi - b.phi)};
}
}  // namespace

GaussianPose fusePoses(const GaussianPose& prior, const GaussianPose& measured)
{
  const Eigen::Matrix3d p = toEigen(prior.covariance);
  const Eigen::LLT<Eigen::Matrix3d> sum(p + toEigen(measured.covariance));
  if (sum.info() != Eigen::Success)
  {
    throw std::invalid_argument("fusePoses: covariances are not positive definite");
  }
  const Eigen::Matrix3d gain = sum.solve(p).transpose();
  const Eigen::Vector3d step = gain * difference(measured.mean, prior.mean);
  GaussianPose fused;
  fused.mean = {prior.mean.x + step[0], prior.mean.y + step[1], wrapToPi(prior.mean.phi + step[2])};
  fused.covariance = fromEigen((Eigen::Matrix3d::Identity() - gain) * p);
  return fused;
}

GaussianPose mergeByMoments(const GaussianPose& a, double weight_a, const GaussianPose& b,
                            double weight_b)
{
  const double total = weight_a + weight_b;
  if (!(total > 0)) throw std::invalid_argument("mergeByMoments: weights must be positive");
  const double share = weight_b / total;
  const Eigen::Vector3d apart = difference(b.mean, a.mean);
  GaussianPose merged;
  merged.mean = {a.mean.x + share * apart[0], a.mean.y + share * apart[1],
                 wrapToPi(a.mean.phi + share * apart[2])};
  merged.covariance =
      fromEigen((1 - share) * toEigen(a.covariance) + share * toEigen(b.covariance) +
                share * (1 - share) * apart * apart.transpose());
  return merged;
}

double largestPositionSigma(const GaussianPose& pose)
{
  const double a = pose.covariance(0, 0);
  const double b = pose.covariance(0, 1);
  const double d = pose.covariance(1, 1);
  const double middle = 0.5 * (a + d);
  const double spread = std::sqrt(std::max(0.0, middle * middle - (a * d - b * b)));
  return std::sqrt(std::max(0.0, middle + spread));
}
}  // namespace sigloc
