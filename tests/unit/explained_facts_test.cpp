// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sigloc/features/FeatureExtractor.h"
#include "sigloc/matching/judging.h"

namespace sigloc
{
namespace
{
constexpr double kInradius = 3;  // [m]
constexpr int kRound = 1000;  // sides

/// Distance [m] from the middle of a room with equal sides to its wall.
double reachOf(int sides, double angle)
{
  const double sector = 2 * M_PI / sides;
  return kInradius / std::cos(std::remainder(angle, sector));
}

DenseField roomOf(int sides)
{
  OccupancyRaster raster;
  raster.frame = {{-6, -6}, 0.05, 240, 240};
  for (int j = 0; j < 240; ++j)
  {
    for (int i = 0; i < 240; ++i)
    {
      const double x = -6 + 0.05 * (i + 0.5);
      const double y = -6 + 0.05 * (j + 0.5);
      const double beyond = std::hypot(x, y) - reachOf(sides, std::atan2(y, x));
      raster.cells.push_back(beyond < 0      ? CellState::free
                             : beyond < 0.12 ? CellState::solid_wall
                                             : CellState::unknown);
    }
  }
  return buildDenseField(raster);
}

/// What a laser of 1 degree in the middle of such a room sees.
ObservedScene sceneOf(int sides)
{
  LaserScan scan;
  scan.first_angle = -M_PI;
  scan.angle_step = M_PI / 180;
  scan.max_range = 30;
  scan.range_sigma = 0.01;
  for (int i = 0; i < 360; ++i)
  {
    const double angle = scan.first_angle + i * scan.angle_step;
    scan.ranges.push_back(static_cast<float>(reachOf(sides, angle) + 0.02));
    scan.valid.push_back(1);
  }
  return observeScene({scan}, {});
}

std::uint32_t factsOf(int sides)
{
  const DenseField field = roomOf(sides);
  const DenseVerifier verifier(field);
  const ObservedScene scene = sceneOf(sides);
  RankedPose here;
  here.evidence = verifier.evaluate(makeDenseScan(scene, 400), here.pose);
  return candidatesOf({here}, verifier, scene).front().facts;
}

std::ptrdiff_t segmentsOf(int sides)
{
  const std::vector<Feature> features = sceneOf(sides).features;
  return std::count_if(features.begin(), features.end(),
                       [](const Feature& feature) { return feature.type == FeatureType::segment; });
}

TEST(ExplainedFacts, EachWallOfARoomIsOne)
{
  EXPECT_EQ(factsOf(4), 4U);
  EXPECT_EQ(factsOf(6), 6U);
}

// A round wall is seen as many short ones: a centre and a radius explain all of them.
TEST(ExplainedFacts, ARoundWallIsThree)
{
  EXPECT_GT(segmentsOf(kRound), 8);
  EXPECT_EQ(factsOf(kRound), 3U);
}
}  // namespace
}  // namespace sigloc
