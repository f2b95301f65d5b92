// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/step_input.h"

#include <cmath>
#include <stdexcept>

#include "geometry/positive_definite.h"

namespace sigloc
{
namespace
{
bool isFinite(const mrpt::math::TPoint2D& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y);
}

/// True for a positive semi-definite matrix. A prediction adds more than is added here.
bool isCovariance(const Eigen::Matrix3d& matrix)
{
  constexpr double kLeast = 1e-6;
  if (!matrix.allFinite() || matrix.diagonal().minCoeff() < 0) return false;
  return isPositiveDefinite(matrix + kLeast * Eigen::Matrix3d::Identity());
}
}  // namespace

void checkMotion(const MotionIncrement& motion)
{
  const bool finite = isFinite({motion.mean.x, motion.mean.y}) && std::isfinite(motion.mean.phi);
  if (!finite || !isCovariance(motion.covariance.asEigen()))
    throw std::invalid_argument("a motion is not finite, or its covariance is none");
}
}  // namespace sigloc
