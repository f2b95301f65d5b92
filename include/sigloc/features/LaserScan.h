// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <cstddef>
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

/// Returns the direction of a beam in the sensor frame [rad].
inline double angleOf(const LaserScan& scan, std::size_t beam)
{
  return scan.first_angle + static_cast<double>(beam) * scan.angle_step;
}

/// Calls `visit(end)` for every valid beam with its end in the sensor frame [m].
template <class Visit>
void forEachReturn(const LaserScan& scan, const Visit& visit)
{
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    if (scan.valid[i] == 0) continue;
    const double angle = angleOf(scan, i);
    const auto range = static_cast<double>(scan.ranges[i]);
    visit(mrpt::math::TPoint2D(range * std::cos(angle), range * std::sin(angle)));
  }
}

/// One laser return in the robot frame.
struct BeamEnd
{
  mrpt::math::TPoint2D point;  ///< [m], end of the beam, within kFarthestReturn of its origin
  std::uint32_t origin = 0;  ///< index into ObservedScene::sensor_origins
};
}  // namespace sigloc
