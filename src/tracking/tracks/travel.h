// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// How far a robot has moved.
struct Travel
{
  double distance = 0;  // [m]
  double with_turns = 0;  // [m], turns included: D of \cite algorithm eq. (8.2)
};

/// Returns the travel of a motion: its distance, and its turn of any sign and size as a distance.
/// \cite algorithm eq. (8.2)
Travel travelOf(const mrpt::math::TPose2D& motion, const TrackerOptions& options);

/// Counts the travel of a robot whose poses jitter. A scan from where the robot stood before is no
/// new evidence. \cite algorithm eq. (8.2)
class TravelMeter
{
 public:
  /// Goes on to a pose. Returns the travel to it since the robot last moved, with a turn of less
  /// than half a circle; none while that is less than 0.1 m.
  Travel moveTo(const mrpt::math::TPose2D& pose, const TrackerOptions& options);

  /// Starts anew at a pose.
  void startAt(const mrpt::math::TPose2D& pose) { moved_to_ = pose; }

 private:
  mrpt::math::TPose2D moved_to_;
};
}  // namespace sigloc
