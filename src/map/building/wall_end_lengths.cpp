// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/building/wall_end_lengths.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "sigloc/map/FeatureMap.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kEndOnLine = 0.2;  // [m] of a wall end from the line of its wall
}  // namespace

void setWallEndLengths(std::vector<Feature>& features)
{
  const std::vector<WallLine> lines = linkWalls(features);
  for (Feature& end : features)
  {
    if (end.type != FeatureType::wall_end) continue;
    const double normal = end.direction + (end.side == WallSide::start ? 0.5 : -0.5) * M_PI;
    const TPoint2D into_wall = directionVector(end);
    for (const WallLine& line : lines)
    {
      if (std::abs(mrpt::math::wrapToPi(line.direction - normal)) > 0.15) continue;
      for (const std::uint32_t k : line.members)
      {
        const Feature& segment = features[k];
        const TPoint2D n = directionVector(segment);
        const TPoint2D to_end = end.position - segment.position;
        if (std::abs(n.x * to_end.x + n.y * to_end.y) > kEndOnLine) continue;
        for (const TPoint2D& tip : {segmentStart(segment), segmentEnd(segment)})
        {
          const TPoint2D d = tip - end.position;
          end.size = std::max(end.size, d.x * into_wall.x + d.y * into_wall.y);
        }
      }
    }
  }
}
}  // namespace sigloc
