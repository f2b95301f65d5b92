// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "matching/candidates.h"
#include "sigloc/features/observe_scans.h"
#include "support/hand_made_scan.h"

namespace sigloc
{
namespace
{
using test::castByHand;
using test::outline;
using test::scanByHand;
using test::Surfaces;

constexpr int kRound = 100;  // sides

/// A room with equal sides around the origin.
Surfaces wallsOf(int sides)
{
  std::vector<mrpt::math::TPoint2D> vertices;
  for (int k = 0; k < sides; ++k)
  {
    const double angle = 2 * M_PI * k / sides;
    vertices.emplace_back(3 * std::cos(angle), 3 * std::sin(angle));
  }
  return outline(vertices);
}

/// The field of a room seen from its middle: unknown behind what is seen.
DenseField fieldOf(const Surfaces& walls)
{
  OccupancyRaster raster;
  raster.frame = {{-4, -4}, 0.05, 160, 160};
  for (int j = 0; j < 160; ++j)
  {
    for (int i = 0; i < 160; ++i)
    {
      const double x = -4 + 0.05 * (i + 0.5);
      const double y = -4 + 0.05 * (j + 0.5);
      const double beyond = std::hypot(x, y) - castByHand(walls, {0, 0}, std::atan2(y, x));
      raster.cells.push_back(beyond < 0      ? CellState::free
                             : beyond < 0.12 ? CellState::solid_wall
                                             : CellState::unknown);
    }
  }
  return buildDenseField(raster);
}

/// Counts the constraints that the field of `mapped` meets for a scan of `scanned`, both from the
/// origin.
ConstraintCounts countIn(const Surfaces& mapped, const Surfaces& scanned)
{
  const DenseField field = fieldOf(mapped);
  const DenseVerifier verifier(field);
  const ObservedScene scene = observeScene({scanByHand(scanned, {0, 0, 0})});
  RankedPose here;
  here.evidence = verifier.evaluate(makeDenseScan(scene, 400), here.pose);
  return candidatesOf({here}, verifier, scene).front().constraints;
}

ConstraintCounts countIn(int sides)
{
  return countIn(wallsOf(sides), wallsOf(sides));
}

/// Counts the features of a type in a scan from the origin.
std::ptrdiff_t observed(const Surfaces& surfaces, FeatureType type)
{
  const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0})});
  return std::count_if(scene.features.begin(), scene.features.end(),
                       [&](const Feature& feature) { return feature.type == type; });
}

TEST(ConstraintCounts, EachWallOfARoomIsOne)
{
  EXPECT_EQ(countIn(4).walls, 4U);
  EXPECT_EQ(countIn(6).walls, 6U);
  EXPECT_EQ(countIn(6).missing_walls, 0U);
}

// A round wall is observed as many short ones. Its circle fits in any heading.
TEST(ConstraintCounts, ARoundWallDoesNotCount)
{
  EXPECT_GT(observed(wallsOf(kRound), FeatureType::segment), 8);
  EXPECT_EQ(countIn(kRound).walls, 0U);
  EXPECT_EQ(countIn(wallsOf(4), wallsOf(kRound)).missing_walls, 0U);
}

// Furniture that hides parts of a round wall must not make several walls of it.
TEST(ConstraintCounts, FurnitureInARoundRoomCountsAlone)
{
  Surfaces furnished = wallsOf(kRound);
  furnished.walls.push_back({{-0.8, -1}, {0.8, -1}});
  furnished.walls.push_back({{1.2, -0.6}, {1.2, 0.6}});
  const ConstraintCounts counts = countIn(furnished, furnished);
  EXPECT_EQ(counts.walls, 2U);
  EXPECT_EQ(counts.wall_ends, 4U);
  EXPECT_EQ(countIn(wallsOf(kRound), furnished).missing_walls, 2U);
}

TEST(ConstraintCounts, AWallInMappedFreeSpaceIsMissing)
{
  Surfaces partitioned = wallsOf(4);
  partitioned.walls.push_back({{-0.8, -1}, {0.8, -1}});
  const ConstraintCounts counts = countIn(wallsOf(4), partitioned);
  EXPECT_EQ(counts.missing_walls, 1U);
  EXPECT_EQ(countIn(partitioned, partitioned).missing_walls, 0U);
}

// The map holds the partition, and nothing of what lies behind it.
TEST(ConstraintCounts, AWallInUnknownAreaCountsNeitherWay)
{
  Surfaces partitioned = wallsOf(4);
  partitioned.walls.push_back({{-2, -0.9}, {2, -0.9}});
  const ConstraintCounts counts = countIn(partitioned, wallsOf(4));
  EXPECT_EQ(counts.walls, 2U);
  EXPECT_EQ(counts.missing_walls, 0U);
}

// A door in a round wall fits at any heading of the robot.
TEST(ConstraintCounts, TheEndOfARoundWallDoesNotCount)
{
  Surfaces with_door = wallsOf(kRound);
  with_door.walls.erase(with_door.walls.begin(), with_door.walls.begin() + 10);
  with_door.walls.push_back({{3.8, -2}, {3.8, 3.5}});
  EXPECT_EQ(observed(with_door, FeatureType::wall_end), 2);
  EXPECT_EQ(countIn(with_door, with_door).wall_ends, 0U);
}

// What is before the end must be a wall, and what is beyond must not.
TEST(ConstraintCounts, AWallEndMustEndInTheMap)
{
  Surfaces partitioned = wallsOf(4);
  partitioned.walls.push_back({{-0.8, -1}, {0.8, -1}});
  Surfaces longer = wallsOf(4);
  longer.walls.push_back({{-1.6, -1}, {1.6, -1}});
  EXPECT_EQ(countIn(partitioned, partitioned).wall_ends, 2U);
  EXPECT_EQ(countIn(longer, partitioned).wall_ends, 0U);
}
}  // namespace
}  // namespace sigloc
