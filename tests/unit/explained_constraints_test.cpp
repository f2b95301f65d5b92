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
using testing::castByHand;
using testing::outline;
using testing::scanByHand;
using testing::Surfaces;

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

std::ptrdiff_t segmentsOf(int sides)
{
  const ObservedScene scene = observeScene({scanByHand(wallsOf(sides), {0, 0, 0})});
  return std::count_if(scene.features.begin(), scene.features.end(),
                       [](const Feature& feature) { return feature.type == FeatureType::segment; });
}

TEST(ConstraintCounts, EachWallOfARoomIsOne)
{
  EXPECT_EQ(countIn(4).walls, 4U);
  EXPECT_EQ(countIn(6).walls, 6U);
  EXPECT_EQ(countIn(6).missing_walls, 0U);
}

// A round wall is observed as many short ones: a centre and a radius explain all of them.
TEST(ConstraintCounts, ARoundWallIsThree)
{
  EXPECT_GT(segmentsOf(kRound), 8);
  EXPECT_EQ(countIn(kRound).walls, 3U);
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
