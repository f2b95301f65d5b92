// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <deque>
#include <optional>

namespace sigloc::ros1
{
/// The poses of the last seconds that messages of odometry told.
class OdometryTrack
{
 public:
  /// A pose that is not finite is ignored. One that is older than the last forgets all before.
  void add(double time, const mrpt::math::TPose2D& odom_from_base);

  /// The pose at a time [s] between two that were told, or up to `patience` [s] after the last;
  /// none for others.
  std::optional<mrpt::math::TPose2D> at(double time, double patience) const;

  void clear() { readings_.clear(); }

 private:
  struct Reading
  {
    double time;
    mrpt::math::TPose2D pose;
  };
  std::deque<Reading> readings_;
};
}  // namespace sigloc::ros1
