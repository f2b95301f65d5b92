// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/motion_conversion.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <algorithm>
#include <cmath>

#include "geometry/positive_definite.h"

namespace sigloc::detail
{
using mrpt::math::CMatrixDouble33;
using mrpt::poses::CPose2D;
using mrpt::poses::CPosePDFGaussian;

namespace
{
constexpr double kMinSigmaXy = 0.001;  // [m]
constexpr double kMinSigmaPhi = 0.05 * M_PI / 180.0;  // [rad]
constexpr double kMaxVariance = 1e4;  // [m^2, rad^2], a greater one carries no information

bool isFinite(const CPose2D& pose)
{
  return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi());
}

bool isCovariance(const CMatrixDouble33& matrix)
{
  const auto m = matrix.asEigen();
  return isPositiveDefinite(m) && m.diagonal().maxCoeff() <= kMaxVariance;
}

CMatrixDouble33 withFloor(const CMatrixDouble33& given)
{
  CMatrixDouble33 covariance = given;
  const double floor[3] = {kMinSigmaXy * kMinSigmaXy, kMinSigmaXy * kMinSigmaXy,
                           kMinSigmaPhi * kMinSigmaPhi};
  for (int i = 0; i < 3; ++i) covariance(i, i) = std::max(covariance(i, i), floor[i]);
  return covariance;
}

/// Returns whether the moments of the movement's own distribution can be trusted.
bool hasMoments(const mrpt::obs::CActionRobotMovement2D& movement)
{
  const auto& change = movement.poseChange;
  if (!change) return false;
  // MRPT does not wrap the headings of a sum of Gaussians.
  if (IS_CLASS(*change, mrpt::poses::CPosePDFSOG)) return false;
  // When a log is read, odometry's particles are drawn anew from a generator seeded by the clock.
  // So results would differ from run to run.
  return movement.estimationMethod != mrpt::obs::CActionRobotMovement2D::emOdometry ||
         IS_CLASS(*change, CPosePDFGaussian);
}

ActionMotion planarMotion(const mrpt::obs::CActionRobotMovement2D& movement)
{
  if (!hasMoments(movement))
  {
    const CPose2D& raw = movement.rawOdometryIncrementReading;
    if (!isFinite(raw)) return {true, std::nullopt};
    return {true, motionFromOdometry(raw)};
  }
  const auto [covariance, mean] = movement.poseChange->getCovarianceAndMean();
  if (!isFinite(mean)) return {true, std::nullopt};
  const CMatrixDouble33 floored = withFloor(covariance);
  if (isCovariance(floored)) return {true, CPosePDFGaussian(mean, floored)};
  return {true, motionFromOdometry(mean)};
}
}  // namespace

CPosePDFGaussian motionFromOdometry(const CPose2D& increment)
{
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry(increment, {});
  CPosePDFGaussian motion;
  motion.copyFrom(*movement.poseChange);
  return motion;
}

ActionMotion motionOf(const mrpt::obs::CActionCollection& actions)
{
  if (const auto movement = actions.getBestMovementEstimation()) return planarMotion(*movement);
  const auto spatial = actions.getActionByClass<mrpt::obs::CActionRobotMovement3D>();
  // MRPT finds no movement the best whose covariance is no number.
  const bool unusable = actions.getActionByClass<mrpt::obs::CActionRobotMovement2D>() != nullptr;
  if (!spatial) return {unusable, std::nullopt};
  const CPose2D mean(spatial->poseChange.mean);
  if (!isFinite(mean)) return {true, std::nullopt};
  const auto& full = spatial->poseChange.cov;
  const int planar[3] = {0, 1, 3};  // x, y, yaw of (x, y, z, yaw, pitch, roll)
  CMatrixDouble33 covariance;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) covariance(r, c) = full(planar[r], planar[c]);
  }
  covariance = withFloor(covariance);
  if (!isCovariance(covariance)) return {true, motionFromOdometry(mean)};
  return {true, CPosePDFGaussian(mean, covariance)};
}

MotionIncrement toMotionIncrement(const CPosePDFGaussian& motion)
{
  MotionIncrement increment;
  increment.mean = motion.mean.asTPose();
  increment.mean.phi = mrpt::math::wrapToPi(increment.mean.phi);
  increment.covariance = motion.cov;
  return increment;
}
}  // namespace sigloc::detail
