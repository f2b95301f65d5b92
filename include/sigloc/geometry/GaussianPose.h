// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <limits>

namespace sigloc
{
/// A planar pose with its uncertainty. The mean is (x [m], y [m], phi [rad] in (-pi, pi]). The 3x3
/// covariance is that of (x, y, phi) in the parent frame [m^2, m rad, rad^2].
struct GaussianPose
{
  mrpt::math::TPose2D mean;
  mrpt::math::CMatrixDouble33 covariance;
};

/// The motion of the robot between two steps, in the frame of the earlier pose:
/// `previous_from_current`, with the 3x3 covariance of (x, y, phi) [m^2, m rad, rad^2].
struct MotionIncrement
{
  mrpt::math::TPose2D mean;
  mrpt::math::CMatrixDouble33 covariance;
};

/// How far a pose is from the truth; NaN where that is unknown.
struct PoseError
{
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double angle = std::numeric_limits<double>::quiet_NaN();  ///< [rad], in [0, pi]
};
/// Returns the distance of two places and the turn between two headings.
PoseError errorBetween(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth);

/// How far off a pose may be to count as right, or before one that is claimed counts as wrong.
/// Between the two it is inaccurate: the truth of public logs is itself off by up to 0.5 m.
struct AccuracyGates
{
  double right_distance = 0.5;  ///< [m]
  double right_angle = 10 * M_PI / 180;  ///< [rad]
  double tight_angle = 3.6 * M_PI / 180;  ///< [rad], with right_distance
  double wrong_distance = 1.0;  ///< [m]
  double wrong_angle = 20 * M_PI / 180;  ///< [rad]
};

/// Returns whether a pose with such an error is right, or wrong. One with a NaN is wrong.
bool isRight(const PoseError& error, const AccuracyGates& gates = {});
bool isWrong(const PoseError& error, const AccuracyGates& gates = {});

/// Returns `map_from_previous (+) increment` with first-order propagation of both covariances. The
/// heading is wrapped. \cite algorithm eq. (8.1)
GaussianPose composeWithMotion(const GaussianPose& map_from_previous,
                               const MotionIncrement& increment);

/// Returns the squared Mahalanobis distance of two Gaussian poses with summed covariances. The
/// heading difference is wrapped.
/// Throws std::invalid_argument when the sum is not positive definite.
double squaredMahalanobisDistance(const GaussianPose& a, const GaussianPose& b);

/// The map's own error, beyond the covariance of each feature: an error between two features at
/// distance d, and two errors common to a whole neighbourhood. \cite algorithm section 3
struct MapErrorModel
{
  double relative_constant = 0.02;  ///< [m], a of sigma_rel(d) = a + b d
  double relative_slope = 0.002;  ///< [-], b
  double common_sigma = 0.10;  ///< [m], moves a neighbourhood together
  double common_turn_sigma = 0.01;  ///< [rad], turns a neighbourhood: 0.1 m over its 10 m

  /// Returns sigma_rel(d) [m] for the distance d [m]. \cite algorithm eq. (3.2)
  double relativeSigma(double distance) const
  {
    return relative_constant + relative_slope * distance;
  }
};

/// Returns the pose with its covariance widened by the errors common to a neighbourhood.
/// \cite algorithm eq. (6.10)
GaussianPose withCommonError(const GaussianPose& pose, const MapErrorModel& error);

/// Returns the pose without what withCommonError() added.
GaussianPose withoutCommonError(const GaussianPose& pose, const MapErrorModel& error);
}  // namespace sigloc
