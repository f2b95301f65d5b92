// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

namespace sigloc
{
/// A planar pose with its uncertainty: mean (x [m], y [m], phi [rad] in (-pi, pi]) and the 3x3
/// covariance of (x, y, phi) in the parent frame [m^2, m rad, rad^2].
struct GaussianPose
{
  mrpt::math::TPose2D mean;
  mrpt::math::CMatrixDouble33 covariance;
};

/// The motion of the robot between two steps, expressed in the frame of the earlier pose:
/// `previous_from_current`, with the 3x3 covariance of (x, y, phi) [m^2, m rad, rad^2].
struct MotionIncrement
{
  mrpt::math::TPose2D mean;
  mrpt::math::CMatrixDouble33 covariance;
};

/// Returns `map_from_previous (+) increment` with first-order propagation of both covariances,
/// heading wrapped. \cite algorithm eq. (8.1)
GaussianPose composeWithMotion(const GaussianPose& map_from_previous,
                               const MotionIncrement& increment);

/// Returns the squared Mahalanobis distance of two Gaussian poses with summed covariances, the
/// heading difference wrapped. Throws std::invalid_argument when the sum is not positive definite.
double squaredMahalanobisDistance(const GaussianPose& a, const GaussianPose& b);
}  // namespace sigloc
