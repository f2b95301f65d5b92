// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sigloc
{
// Two poses nearer than both of these count as the same pose: candidates, and what competes with
// them and with tracks, are farther apart. Eq. (5.13)
constexpr double kSamePlaceDistance = 0.5;  // [m]
constexpr double kSamePlaceAngle = 17.0 * M_PI / 180.0;  // [rad]

/// True when two poses differ by at most a distance [m] and an angle [rad].
inline bool withinReach(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b, double distance,
                        double angle)
{
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return dx * dx + dy * dy <= distance * distance &&
         std::abs(mrpt::math::wrapToPi(a.phi - b.phi)) <= angle;
}

/// True when two poses count as the same pose.
inline bool samePlace(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b)
{
  return withinReach(a, b, kSamePlaceDistance, kSamePlaceAngle);
}
}  // namespace sigloc
