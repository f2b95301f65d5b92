// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/travel.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

namespace sigloc
{
using mrpt::math::TPose2D;

Travel travelOf(const TPose2D& motion, const TrackerOptions& options)
{
  const double distance = std::hypot(motion.x, motion.y);
  return {distance,
          distance + std::abs(motion.phi) * options.evidence_distance / options.evidence_turn};
}

Travel TravelMeter::moveTo(const TPose2D& pose, const TrackerOptions& options)
{
  constexpr double kMoved = 0.1;  // [m], more than the jitter of the poses of a robot at rest
  const double turn = mrpt::math::wrapToPi(pose.phi - moved_to_.phi);
  const Travel travel = travelOf({pose.x - moved_to_.x, pose.y - moved_to_.y, turn}, options);
  if (travel.with_turns < kMoved) return {};
  moved_to_ = pose;
  return travel;
}
}  // namespace sigloc
