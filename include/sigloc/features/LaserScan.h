// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

namespace sigloc
{
/// What reads farther [m] is no return of a laser and says nothing.
constexpr double kFarthestReturn = 1e4;

/// One planar laser scan, framework-free. Beam i points along first_angle + i * angle_step
/// (sensor frame, counter-clockwise positive; the bridge reverses clockwise or upside-down scans,
/// so angle_step > 0). A beam with valid[i] == 0 says nothing: no return, clipped or broken; nor
/// does one beyond max_range or kFarthestReturn.
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
  mrpt::math::TPoint2D point;  ///< [m], where the beam ended, within kFarthestReturn of it
  std::uint32_t origin = 0;  ///< index into ObservedScene::sensor_origins
};
}  // namespace sigloc
