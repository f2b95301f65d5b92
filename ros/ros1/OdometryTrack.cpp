// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros1/OdometryTrack.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace sigloc::ros1
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kKept = 10.0;  // [s]
}

void OdometryTrack::add(double time, const TPose2D& odom_from_base)
{
  const TPose2D& pose = odom_from_base;
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) return;
  if (!readings_.empty() && time < readings_.back().time) readings_.clear();
  readings_.push_back({time, pose});
  while (readings_.front().time < time - kKept) readings_.pop_front();
}

std::optional<TPose2D> OdometryTrack::at(double time, double patience) const
{
  if (readings_.empty() || time < readings_.front().time) return std::nullopt;
  const Reading& last = readings_.back();
  if (time >= last.time)
  {
    return time <= last.time + patience ? std::optional(last.pose) : std::nullopt;
  }
  const auto after =
      std::upper_bound(readings_.begin(), readings_.end(), time,
                       [](double t, const Reading& reading) { return t < reading.time; });
  const Reading& before = *std::prev(after);
  const double share = (time - before.time) / (after->time - before.time);
  const double turn = mrpt::math::wrapToPi(after->pose.phi - before.pose.phi);
  return TPose2D(before.pose.x + share * (after->pose.x - before.pose.x),
                 before.pose.y + share * (after->pose.y - before.pose.y),
                 mrpt::math::wrapToPi(before.pose.phi + share * turn));
}
}  // namespace sigloc::ros1
