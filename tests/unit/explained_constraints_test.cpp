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

ObservedScene sceneOf(int sides)
{
  return observeScene({scanByHand(wallsOf(sides), {0, 0, 0})});
}

std::uint32_t factsOf(int sides)
{
  const DenseField field = fieldOf(wallsOf(sides));
  const DenseVerifier verifier(field);
  const ObservedScene scene = sceneOf(sides);
  RankedPose here;
  here.evidence = verifier.evaluate(makeDenseScan(scene, 400), here.pose);
  return candidatesOf({here}, verifier, scene).front().explained_constraints;
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

// A round wall is observed as many short ones: a centre and a radius explain all of them.
TEST(ExplainedFacts, ARoundWallIsThree)
{
  EXPECT_GT(segmentsOf(kRound), 8);
  EXPECT_EQ(factsOf(kRound), 3U);
}
}  // namespace
}  // namespace sigloc
