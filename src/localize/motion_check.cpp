// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/motion_check.h"

#include <cmath>

#include "geometry/plane_products.h"

namespace sigloc::detail
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kLeastWay = 2.0;  // [m], below which noise decides

bool isLocalized(const StepRecord& step)
{
  return step.belief.verdict == Verdict::localized && step.travel_known;
}

TPoint2D drivenBetween(const TPose2D& from, const TPose2D& to)
{
  const TPose2D motion = to - from;
  return {motion.x, motion.y};
}
}  // namespace

std::optional<OdometryMatch> matchOfOdometry(const std::vector<StepRecord>& steps)
{
  double way = 0;
  double squares = 0;
  double along = 0;
  double across = 0;
  for (std::size_t i = 1; i < steps.size(); ++i)
  {
    if (!isLocalized(steps[i - 1]) || !isLocalized(steps[i])) continue;
    const TrackedHypothesis& before = steps[i - 1].belief.hypotheses.front();
    const TrackedHypothesis& after = steps[i].belief.hypotheses.front();
    if (before.id != after.id) continue;
    const TPoint2D told = drivenBetween(steps[i - 1].odometry, steps[i].odometry);
    const TPoint2D found = drivenBetween(before.pose.mean, after.pose.mean);
    way += told.norm();
    squares += dot(told, told);
    along += dot(told, found);
    across += cross(told, found);
  }
  if (way < kLeastWay) return std::nullopt;
  return OdometryMatch{std::atan2(across, along), std::hypot(along, across) / squares};
}
}  // namespace sigloc::detail
