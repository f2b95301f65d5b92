// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Dense>

namespace sigloc::detail
{
/// Returns whether a sensor's pose on a robot is valid: finite and no more than 100 m off.
inline bool isSensorMount(const mrpt::poses::CPose3D& robot_from_sensor)
{
  constexpr double kReach = 100.0;  // [m]
  const auto rotation = robot_from_sensor.getRotationMatrix();
  return robot_from_sensor.norm() <= kReach && rotation.asEigen().allFinite();
}
}  // namespace sigloc::detail
