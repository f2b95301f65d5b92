// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sigloc/matching/DenseVerifier.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kOnSegment = 0.05;  // [m], a return this near a fitted segment lies on it
constexpr double kSharedLength = 0.2;  // [m] of wall whose returns share one weight
constexpr double kLeastShare = 0.01;  // of a return that repeats those beside it

/// Indices 0..n-1 in van der Corput order: every prefix is spread evenly.
std::vector<std::uint32_t> interleavedOrder(std::uint32_t n)
{
  std::uint32_t bits = 0;
  while ((1U << bits) < n) ++bits;
  std::vector<std::uint32_t> order;
  order.reserve(n);
  for (std::uint32_t i = 0; i < (1U << bits); ++i)
  {
    std::uint32_t reversed = 0;
    for (std::uint32_t b = 0; b < bits; ++b)
    {
      if ((i & (1U << b)) != 0) reversed |= 1U << (bits - 1 - b);
    }
    if (reversed < n) order.push_back(reversed);
  }
  return order;
}

/// How far [m] a beam's neighbour may end from it on the same surface.
double gapAt(const BeamEnd& beam)
{
  constexpr double kGap = 0.3;  // [m]
  constexpr double kGapPerRange = 0.05;  // [m/m], beams fan out
  return kGap + kGapPerRange * beam.point.norm();
}

/// Whether no beam beside a return ends near it: a speck of clutter, or something thin and far.
bool isIsolated(const std::vector<BeamEnd>& beams, std::size_t i)
{
  const BeamEnd& beam = beams[i];
  const double gap = gapAt(beam);
  const std::size_t first = i < 2 ? 0 : i - 2;
  const std::size_t last = std::min(beams.size() - 1, i + 2);
  for (std::size_t k = first; k <= last; ++k)
  {
    if (k == i || beams[k].origin != beam.origin) continue;
    if ((beams[k].point - beam.point).norm() < gap) return false;
  }
  return true;
}

/// The share of kSharedLength that a return stands for, in [kLeastShare, 1]: its mean distance to
/// the beams beside it on the same surface.
double lengthShare(const std::vector<BeamEnd>& beams, std::size_t i)
{
  const BeamEnd& beam = beams[i];
  const double gap = gapAt(beam);
  double sum = 0;
  int neighbours = 0;
  for (const std::size_t k : {i - 1, i + 1})
  {
    // Before the first beam is far beyond the last.
    if (k >= beams.size() || beams[k].origin != beam.origin) continue;
    const double distance = (beams[k].point - beam.point).norm();
    if (distance >= gap) continue;
    sum += distance;
    ++neighbours;
  }
  return neighbours == 0 ? 1.0 : std::clamp(sum / neighbours / kSharedLength, kLeastShare, 1.0);
}

/// An observed segment, as its returns are found.
struct ObservedWall
{
  TPoint2D position;  // [m], its middle
  TPoint2D normal;
  double reach;  // [m] from the middle along the wall
};

std::vector<ObservedWall> observedWalls(const std::vector<Feature>& features)
{
  std::vector<ObservedWall> walls;
  for (const Feature& feature : features)
  {
    if (feature.type != FeatureType::segment) continue;
    walls.push_back({feature.position, directionVector(feature), 0.5 * feature.size + kOnSegment});
  }
  return walls;
}

/// Adds how a return pulls: along the normal of the wall it lies on, or to both sides alike.
void addPull(const std::vector<ObservedWall>& walls, const TPoint2D& point, DenseScan& scan)
{
  double xx = 0.5;
  double xy = 0;
  double yy = 0.5;
  for (const ObservedWall& wall : walls)
  {
    const TPoint2D& n = wall.normal;
    const TPoint2D d = point - wall.position;
    if (std::abs(n.x * d.x + n.y * d.y) > kOnSegment) continue;
    if (std::abs(n.y * d.x - n.x * d.y) > wall.reach) continue;
    xx = n.x * n.x;
    xy = n.x * n.y;
    yy = n.y * n.y;
    break;
  }
  scan.pull_xx.push_back(static_cast<float>(xx));
  scan.pull_xy.push_back(static_cast<float>(xy));
  scan.pull_yy.push_back(static_cast<float>(yy));
}
}  // namespace

DenseScan makeDenseScan(const ObservedScene& scene, std::size_t max_beams)
{
  const std::size_t total = scene.beams.size();
  const std::size_t count = std::min(total, max_beams);
  DenseScan scan;
  scan.origins = scene.sensor_origins;
  for (auto* column :
       {&scan.x, &scan.y, &scan.pull_xx, &scan.pull_xy, &scan.pull_yy, &scan.balance})
  {
    column->reserve(count);
  }
  scan.isolated.reserve(count);
  scan.origin.reserve(count);
  const std::vector<ObservedWall> walls = observedWalls(scene.features);
  for (const std::uint32_t i : interleavedOrder(static_cast<std::uint32_t>(count)))
  {
    const std::size_t at = i * total / count;
    const BeamEnd& beam = scene.beams[at];
    scan.x.push_back(static_cast<float>(beam.point.x));
    scan.y.push_back(static_cast<float>(beam.point.y));
    addPull(walls, beam.point, scan);
    scan.balance.push_back(static_cast<float>(std::sqrt(lengthShare(scene.beams, at))));
    scan.isolated.push_back(isIsolated(scene.beams, at) ? 1 : 0);
    scan.origin.push_back(beam.origin);
  }
  const float sum = std::accumulate(scan.balance.begin(), scan.balance.end(), 0.0F);
  for (float& weight : scan.balance) weight *= static_cast<float>(count) / sum;
  return scan;
}
}  // namespace sigloc
