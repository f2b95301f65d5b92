// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/wall_end_lengths.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "geometry/plane_products.h"
#include "map/wall_linking.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kEndOnLine = 0.2;  // [m] of a wall end from the line of its wall
constexpr double kEndTurn = 0.15;  // [rad] of a wall end from the direction of its wall
constexpr double kEndBeyond = 0.3;  // [m] of a wall end beyond the mapped segment of its wall

/// True where the segment is the piece of wall that the end belongs to: it faces the same way, and
/// the end lies on it.
bool endsOn(const Feature& segment, const Feature& end)
{
  const double normal = end.direction + (end.side == WallSide::start ? 0.5 : -0.5) * M_PI;
  if (std::abs(mrpt::math::wrapToPi(segment.direction - normal)) > kEndTurn) return false;
  const TPoint2D n = directionVector(segment);
  const TPoint2D t = tangentVector(segment);
  const TPoint2D to_end = end.position - segment.position;
  return std::abs(dot(n, to_end)) <= kEndOnLine &&
         std::abs(dot(t, to_end)) <= 0.5 * segment.size + kEndBeyond;
}
}  // namespace

void setWallEndLengths(std::vector<Feature>& features)
{
  const std::vector<WallLine> lines = linkWalls(features);
  const CellHash segments = segmentHash(features);
  std::vector<std::uint32_t> line_of(features.size(), 0);
  for (std::uint32_t l = 0; l < lines.size(); ++l)
  {
    for (const std::uint32_t k : lines[l].members) line_of[k] = l;
  }
  for (Feature& end : features)
  {
    if (end.type != FeatureType::wall_end) continue;
    const TPoint2D into_wall = directionVector(end);
    segments.forEachNear(
        end.position,
        [&](std::uint32_t near)
        {
          if (!endsOn(features[near], end)) return;
          for (const std::uint32_t k : lines[line_of[near]].members)
          {
            for (const TPoint2D& tip : {segmentStart(features[k]), segmentEnd(features[k])})
            {
              const TPoint2D d = tip - end.position;
              end.size = std::max(end.size, dot(d, into_wall));
            }
          }
        });
  }
}
}  // namespace sigloc
