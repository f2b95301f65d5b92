// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CActionRobotMovement2D.h>

#include "eval/worlds/robot_simulation.h"

namespace sigloc
{
/// Returns an odometry increment as MRPT stores it: the Gaussian of the motion model included.
mrpt::obs::CActionRobotMovement2D odometryAction(const mrpt::math::TPose2D& increment,
                                                 const OdometryOptions& options);
}  // namespace sigloc
