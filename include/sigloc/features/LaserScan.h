// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

namespace sigloc
{
/// A range above this [m] is no return of a laser and is skipped.
constexpr double kFarthestReturn = 1e4;

/// One planar laser scan, framework-free. Beam i points along first_angle + i * angle_step in the
/// sensor frame, counter-clockwise positive. Readers reverse clockwise or upside-down scans, so
/// that angle_step > 0. A beam with valid[i] == 0 (no return, clipped or broken) is skipped, and so
/// is one beyond max_range or kFarthestReturn.
struct LaserScan
{
  std::vector<float> ranges;  ///< [m], finite and > 0 where valid
  std::vector<std::uint8_t> valid;  ///< same size as ranges
  double first_angle = 0;  ///< [rad]
  double angle_step = 0;  ///< [rad], > 0
  double max_range = 80;  ///< [m]
  double range_sigma = 0.01;  ///< [m], standard deviation of one range
  mrpt::math::TPose2D robot_from_sensor;
};

/// One laser return in the robot frame.
struct BeamEnd
{
  mrpt::math::TPoint2D point;  ///< [m], end of the beam, within kFarthestReturn of its origin
  std::uint32_t origin = 0;  ///< index into ObservedScene::sensor_origins
};
}  // namespace sigloc
