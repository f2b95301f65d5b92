// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/observe_points.h"

#include <algorithm>
#include <cmath>

#include "features/ScanPoints.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kFinestSpacing = 0.1 * M_PI / 180.0;  // [rad] least angle between beams
constexpr double kCoarsestSpacing = 2.0 * M_PI / 180.0;  // [rad] largest angle between beams
constexpr double kTurn = 2 * M_PI;

struct Bearing
{
  double angle;  // [rad], in [0, 2 pi)
  double range;  // [m]
};

std::vector<Bearing> bearingsOf(const std::vector<TPoint2D>& points, const TPoint2D& origin)
{
  std::vector<Bearing> bearings;
  for (const TPoint2D& point : points)
  {
    const TPoint2D ray = point - origin;
    const double range = ray.norm();
    if (!(range > 0 && range <= kFarthestReturn)) continue;
    const double angle = std::atan2(ray.y, ray.x);
    bearings.push_back({angle < 0 ? angle + kTurn : angle, range});
  }
  std::sort(bearings.begin(), bearings.end(),
            [](const Bearing& a, const Bearing& b)
            { return a.angle != b.angle ? a.angle < b.angle : a.range < b.range; });
  return bearings;
}

/// Returns the angle [rad] between neighbouring beams: that between most neighbouring points.
double spacingOf(const std::vector<Bearing>& bearings)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < bearings.size(); ++i)
  {
    const double step = bearings[i].angle - bearings[i - 1].angle;
    if (step > 1e-6) steps.push_back(step);
  }
  if (steps.empty()) return kCoarsestSpacing;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::clamp(*middle, kFinestSpacing, kCoarsestSpacing);
}

/// Rotates the order so that it starts behind the widest gap, where the seam cuts nothing.
void startBehindGap(std::vector<Bearing>& bearings)
{
  std::size_t start = 0;
  double widest = bearings.front().angle + kTurn - bearings.back().angle;
  for (std::size_t i = 1; i < bearings.size(); ++i)
  {
    const double gap = bearings[i].angle - bearings[i - 1].angle;
    if (gap <= widest) continue;
    widest = gap;
    start = i;
  }
  std::rotate(bearings.begin(), bearings.begin() + static_cast<std::ptrdiff_t>(start),
              bearings.end());
}

/// Keeps the nearest point of each beam. How many beams were lost, and how far they reach, points
/// do not tell.
ScanPoints scanOf(const std::vector<Bearing>& bearings, double spacing)
{
  ScanPoints scan;
  scan.beam_spacing = spacing;
  const double first = bearings.front().angle;
  const auto along = [&](const Bearing& b)
  { return b.angle >= first ? b.angle - first : b.angle + kTurn - first; };
  scan.closed = along(bearings.back()) + 1.5 * spacing > kTurn;
  for (const Bearing& bearing : bearings)
  {
    const auto beam = static_cast<std::size_t>(std::lround(along(bearing) / spacing));
    if (!scan.beams.empty() && scan.beams.back() >= beam)
    {
      if (scan.ranges.back() <= bearing.range) continue;
      scan.points.pop_back();
      scan.ranges.pop_back();
      scan.beams.pop_back();
    }
    scan.points.emplace_back(bearing.range * std::cos(bearing.angle),
                             bearing.range * std::sin(bearing.angle));
    scan.ranges.push_back(bearing.range);
    scan.beams.push_back(beam);
  }
  return scan;
}
}  // namespace

ObservedScene observePoints(const std::vector<TPoint2D>& points, const TPoint2D& origin,
                            double range_sigma, const FeatureExtractorOptions& options)
{
  ObservedScene scene;
  std::vector<Bearing> bearings = bearingsOf(points, origin);
  if (bearings.empty()) return scene;
  const double spacing = spacingOf(bearings);
  startBehindGap(bearings);
  appendScan(scanOf(bearings, spacing), {origin.x, origin.y, 0}, range_sigma, options, scene);
  return scene;
}
}  // namespace sigloc
