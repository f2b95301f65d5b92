// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/distinguishing_place.h"

#include "matching/dense/CellView.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
constexpr double kReach = 8.0;  // [m] from the robot, farthest point
constexpr double kNearest = 0.5;  // [m] from the robot, within which points are its own position
constexpr double kSampleSpacing = 0.3;  // [m] between samples
constexpr double kWall = 0.2;  // [m] to a wall, small enough that samples do not step over one
constexpr double kClear = 0.5;  // [m] to any wall, least distance of a point in free space

bool differ(const DenseCell& a, const DenseCell& b)
{
  constexpr auto kWallUnits = static_cast<int>(kWall / DenseField::kDistanceUnit);
  constexpr auto kClearUnits = static_cast<int>(kClear / DenseField::kDistanceUnit);
  const auto wall = [](const DenseCell& cell) { return cell.distance() <= kWallUnits; };
  const auto clear = [](const DenseCell& cell)
  { return cell.state() == CellState::free && cell.distance() >= kClearUnits; };
  return (wall(a) && clear(b)) || (wall(b) && clear(a));
}
}  // namespace

std::optional<TPoint2D> distinguishingPlace(const DenseField& field, const TPose2D& a,
                                            const TPose2D& b)
{
  const CellView cells(field);
  const Placement at_a(a);
  const Placement at_b(b);
  std::optional<TPoint2D> nearest;
  double least = kReach * kReach;
  const int samples = static_cast<int>(kReach / kSampleSpacing);
  for (int iy = -samples; iy <= samples; ++iy)
  {
    for (int ix = -samples; ix <= samples; ++ix)
    {
      const double square = kSampleSpacing * kSampleSpacing * (ix * ix + iy * iy);
      if (square >= least || square < kNearest * kNearest) continue;
      const auto x = static_cast<float>(kSampleSpacing * ix);
      const auto y = static_cast<float>(kSampleSpacing * iy);
      if (!differ(cells.at(at_a.placedX(x, y), at_a.placedY(x, y)),
                  cells.at(at_b.placedX(x, y), at_b.placedY(x, y))))
      {
        continue;
      }
      least = square;
      nearest = TPoint2D(kSampleSpacing * ix, kSampleSpacing * iy);
    }
  }
  return nearest;
}
}  // namespace sigloc
