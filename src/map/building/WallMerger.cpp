// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/WallMerger.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geometry/plane_products.h"
#include "map/building/walk_along.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
/// A piece of wall counts like evenly spread points, eq. (2.6): by its length, middle and spread.
MergedWall seenOnce(const Feature& segment, std::uint32_t scan)
{
  const TPoint2D tangent = tangentVector(segment);
  const double w = segment.size;
  const double spread = w * w * w / 12.0;
  const TPoint2D p = segment.position;
  MergedWall wall;
  wall.weight = w;
  wall.weighted_sum = p * w;
  wall.xx = w * p.x * p.x + spread * tangent.x * tangent.x;
  wall.xy = w * p.x * p.y + spread * tangent.x * tangent.y;
  wall.yy = w * p.y * p.y + spread * tangent.y * tangent.y;
  wall.line = segment;
  wall.sightings = 1;
  wall.last_scan = scan;
  return wall;
}

/// Sets the line to the one through the moments, so far that it covers both walls.
void fitLine(MergedWall& merged, const Feature& other)
{
  const TPoint2D ends[] = {segmentStart(merged.line), segmentEnd(merged.line), segmentStart(other),
                           segmentEnd(other)};
  const TPoint2D mean = merged.weighted_sum * (1.0 / merged.weight);
  const double sxx = merged.xx - merged.weight * mean.x * mean.x;
  const double sxy = merged.xy - merged.weight * mean.x * mean.y;
  const double syy = merged.yy - merged.weight * mean.y * mean.y;
  double normal = 0.5 * std::atan2(2 * sxy, sxx - syy) + 0.5 * M_PI;
  if (std::cos(normal - other.direction) < 0) normal += M_PI;
  Feature& line = merged.line;
  line.direction = wrapToPi(normal);
  const TPoint2D along = tangentVector(line);
  const auto place = [&](const TPoint2D& q)
  { return (q.x - mean.x) * along.x + (q.y - mean.y) * along.y; };
  double low = place(ends[0]);
  double high = low;
  for (const TPoint2D& end : ends)
  {
    low = std::min(low, place(end));
    high = std::max(high, place(end));
  }
  line.size = high - low;
  line.position = mean + along * (0.5 * (low + high));
}

void absorbWall(MergedWall& merged, const MergedWall& wall)
{
  merged.weight += wall.weight;
  merged.weighted_sum += wall.weighted_sum;
  merged.xx += wall.xx;
  merged.xy += wall.xy;
  merged.yy += wall.yy;
  fitLine(merged, wall.line);
}
}  // namespace

WallMerger::WallMerger(const MapBuildingOptions& options, std::vector<MergedWall> walls)
    : options_(options), walls_(std::move(walls))
{
  for (std::uint32_t k = 0; k < walls_.size(); ++k)
  {
    walls_[k].last_scan = 0;
    enter(k);
  }
}

bool WallMerger::fits(const Feature& mapped, const Feature& segment, double& offset) const
{
  if (std::abs(wrapToPi(mapped.direction - segment.direction)) > options_.merge_angle) return false;
  const TPoint2D normal = directionVector(mapped);
  const TPoint2D tangent = tangentVector(mapped);
  const TPoint2D a = segmentStart(segment) - mapped.position;
  const TPoint2D b = segmentEnd(segment) - mapped.position;
  const double offset_a = std::abs(dot(normal, a));
  const double offset_b = std::abs(dot(normal, b));
  offset = std::max(offset_a, offset_b);
  if (offset > options_.merge_offset) return false;
  const double along_a = dot(tangent, a);
  const double along_b = dot(tangent, b);
  const double reach = 0.5 * mapped.size + options_.merge_gap;
  return std::min(along_a, along_b) < reach && std::max(along_a, along_b) > -reach;
}

void WallMerger::add(const Feature& segment, std::uint32_t scan)
{
  const MergedWall seen = seenOnce(segment, scan);
  const std::uint32_t best = bestFor(segment);
  if (best == walls_.size())
  {
    walls_.push_back(seen);
  }
  else
  {
    MergedWall& wall = walls_[best];
    absorbWall(wall, seen);
    if (wall.last_scan != scan) ++wall.sightings;
    wall.last_scan = scan;
  }
  enter(best);
}

std::vector<MergedWall> WallMerger::mergedAgain(std::uint32_t least_sightings) const
{
  std::vector<MergedWall> often;
  std::copy_if(walls_.begin(), walls_.end(), std::back_inserter(often),
               [&](const MergedWall& wall) { return wall.sightings >= least_sightings; });
  std::stable_sort(often.begin(), often.end(),
                   [](const MergedWall& a, const MergedWall& b) { return a.weight > b.weight; });
  WallMerger again(options_);
  for (const MergedWall& wall : often)
  {
    const std::uint32_t best = again.bestFor(wall.line);
    if (best == again.walls_.size())
    {
      again.walls_.push_back(wall);
    }
    else
    {
      absorbWall(again.walls_[best], wall);
      // One scan may have seen both.
      again.walls_[best].sightings = std::max(again.walls_[best].sightings, wall.sightings);
    }
    again.enter(best);
  }
  return std::move(again.walls_);
}

/// Returns the wall that a segment fits best, or the number of walls.
std::uint32_t WallMerger::bestFor(const Feature& segment) const
{
  auto best = static_cast<std::uint32_t>(walls_.size());
  double best_offset = 1e9;
  const auto compare = [&](std::uint32_t k)
  {
    double offset = 0;
    if (!fits(walls_[k].line, segment, offset)) return;
    if (offset > best_offset || (offset == best_offset && k >= best)) return;
    best = k;
    best_offset = offset;
  };
  // Segments that may merge are within these margins, perhaps across the border of a cell.
  const TPoint2D aside = directionVector(segment) * options_.merge_offset;
  walkAlong(segment, 0.5 * kCell, options_.merge_gap,
            [&](const TPoint2D& p)
            {
              for (const TPoint2D& at : {p, p - aside, p + aside})
                cells_.forEachInCell(at, compare);
            });
  return best;
}

void WallMerger::enter(std::uint32_t index)
{
  walkAlong(walls_[index].line, 0.5 * kCell, 0.0,
            [&](const TPoint2D& p) { cells_.addOnce(p, index); });
}
}  // namespace sigloc
