// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <optional>

#include "sigloc/geometry/GaussianPose.h"

namespace sigloc::detail
{
/// The robot's motion according to one action collection.
struct ActionMotion
{
  bool present = false;  ///< the collection holds a movement at all
  std::optional<mrpt::poses::CPosePDFGaussian> motion;  ///< none where it is not finite
};

/// Returns the movement of an action collection: its own mean and covariance, the latter at least
/// 1 mm and 0.05 degrees in standard deviation.
ActionMotion motionOf(const mrpt::obs::CActionCollection& actions);

/// Returns a motion from odometry alone, with the covariance of MRPT's Gaussian odometry model at
/// its default parameters.
mrpt::poses::CPosePDFGaussian motionFromOdometry(const mrpt::poses::CPose2D& increment);

MotionIncrement toMotionIncrement(const mrpt::poses::CPosePDFGaussian& motion);
}  // namespace sigloc::detail
