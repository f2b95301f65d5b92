// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/step_input.h"

#include <cmath>
#include <Eigen/Dense>
#include <stdexcept>

namespace sigloc
{
namespace
{
bool isFinite(const mrpt::math::TPoint2D& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y);
}

/// True for a matrix that is symmetric and positive semi-definite, but for rounding. A prediction
/// adds more than is added here.
bool isCovariance(const Eigen::Matrix3d& matrix)
{
  constexpr double kRounding = 1e-6;
  if (!matrix.allFinite() || matrix.diagonal().minCoeff() < 0) return false;
  if ((matrix - matrix.transpose()).norm() > kRounding * (1.0 + matrix.norm())) return false;
  const Eigen::Matrix3d above = matrix + kRounding * Eigen::Matrix3d::Identity();
  return Eigen::LLT<Eigen::Matrix3d>(above).info() == Eigen::Success;
}
}  // namespace

void checkMotion(const MotionIncrement& motion)
{
  const bool finite = isFinite({motion.mean.x, motion.mean.y}) && std::isfinite(motion.mean.phi);
  if (!finite || !isCovariance(motion.covariance.asEigen()))
    throw std::invalid_argument("a motion is not finite, or its covariance is none");
}
}  // namespace sigloc
