// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/map/FeatureMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "sigloc/map/map_building.h"
#include "support/hand_made_scan.h"
#include "support/wall_piece.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using test::outline;
using test::scanByHand;
using test::Scanner;
using test::Surfaces;
using test::wallPiece;

std::size_t countOf(const std::vector<Feature>& features, FeatureType type)
{
  return static_cast<std::size_t>(std::count_if(features.begin(), features.end(),
                                                [&](const Feature& feature)
                                                { return feature.type == type; }));
}

/// A room of 5 m x 4 m with a post in it, seen from many places.
std::vector<PosedScans> scansOfARoom(double sigma)
{
  Surfaces surfaces = outline({{0, 0}, {5, 0}, {5, 4}, {0, 4}});
  surfaces.pillars.push_back({{3.4, 1.2}, 0.15});
  std::mt19937_64 random(21);
  std::vector<PosedScans> scans;
  for (const double x : {0.8, 1.6, 2.4, 4.2})
  {
    for (const double y : {0.8, 2.0, 3.2})
    {
      Scanner scanner;
      scanner.sigma = sigma;
      const TPose2D pose(x, y, 0.7 * x + y);
      scans.push_back({pose, {scanByHand(surfaces, pose, scanner, &random)}});
    }
  }
  return scans;
}

TEST(MapBuilding, RoomIsFourWallsFourCornersAndAPost)
{
  const FeatureMap map = buildMapFromScans(scansOfARoom(0.01));
  EXPECT_EQ(countOf(map.features(), FeatureType::corner), 4U);
  EXPECT_EQ(countOf(map.features(), FeatureType::circle), 1U);
  EXPECT_EQ(map.lines().size(), 4U);
  EXPECT_GE(countOf(map.features(), FeatureType::segment), 4U);
  for (const Feature& feature : map.features())
  {
    if (feature.type == FeatureType::corner)
    {
      EXPECT_NEAR(std::abs(feature.position.x - 2.5), 2.5, 0.03);
      EXPECT_NEAR(std::abs(feature.position.y - 2.0), 2.0, 0.03);
      EXPECT_NEAR(feature.size, M_PI / 2, 0.05);
    }
    if (feature.type == FeatureType::circle)
    {
      EXPECT_NEAR((feature.position - TPoint2D(3.4, 1.2)).norm(), 0, 0.05);
    }
  }
  ASSERT_TRUE(map.field());
  EXPECT_NEAR(map.area(), 20, 1.5);
}

TEST(MapBuilding, RasterGivesTheFeaturesThatScansGive)
{
  const OccupancyRaster raster = rasterFromScans(scansOfARoom(0.0));
  MapBuildingOptions options;
  options.cast_spacing = 0.8;
  const FeatureMap map = buildMapFromRaster(raster, options);
  EXPECT_EQ(map.lines().size(), 4U);
  EXPECT_EQ(countOf(map.features(), FeatureType::corner), 4U);
  EXPECT_EQ(countOf(map.features(), FeatureType::circle), 1U);
  OccupancyRaster blank = raster;
  std::fill(blank.cells.begin(), blank.cells.end(), CellState::free);
  EXPECT_THROW(buildMapFromRaster(blank, options), std::invalid_argument);
}

TEST(LinkWalls, FragmentsFacingTheSameWayMakeOneLine)
{
  const std::vector<Feature> features = {wallPiece(0, 2, 0, true),
                                         wallPiece(3, 5, 0.05, true),  // a door apart
                                         wallPiece(0, 5, -0.1, false),  // the other face
                                         wallPiece(10, 12, 0, true),  // more than 4 m on
                                         wallPiece(0, 2, 0.5, true)};  // another wall
  const std::vector<WallLine> lines = linkWalls(features);
  ASSERT_EQ(lines.size(), 4U);
  std::vector<std::size_t> sizes;
  std::size_t members = 0;
  for (const WallLine& line : lines)
  {
    sizes.push_back(line.members.size());
    members += line.members.size();
  }
  EXPECT_EQ(*std::max_element(sizes.begin(), sizes.end()), 2U);
  EXPECT_EQ(members, features.size());
  const FeatureMap map(features);
  EXPECT_EQ(map.lineOf(0), map.lineOf(1));
  EXPECT_NE(map.lineOf(0), map.lineOf(2));
  EXPECT_NE(map.lineOf(0), map.lineOf(3));
  EXPECT_NE(map.lineOf(0), map.lineOf(4));
}

TEST(LinkWalls, EverySegmentBelongsToOneLineWhateverTheTurn)
{
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-M_PI, M_PI);
  for (int k = 0; k < 50; ++k)
  {
    const TPose2D turn(uniform(random), uniform(random), uniform(random));
    const std::vector<Feature> features = {transformed(turn, wallPiece(0, 2, 0, true)),
                                           transformed(turn, wallPiece(3, 5, 0.05, true)),
                                           transformed(turn, wallPiece(0, 5, -0.1, false))};
    EXPECT_EQ(linkWalls(features).size(), 2U) << turn;
  }
}

TEST(FeatureMap, RefusesWhatIsNoFeature)
{
  const double nan = std::nan("");
  const Feature good = wallPiece(0, 2, 0, true);
  EXPECT_NO_THROW(FeatureMap({good}));
  std::vector<Feature> bad(8, good);
  bad[0].position.x = nan;
  bad[1].direction = std::numeric_limits<double>::infinity();
  bad[2].position_covariance(0, 0) = -1;
  bad[3].position_covariance(0, 1) = bad[3].position_covariance(1, 0) = 1;
  bad[4].direction_variance = -1e-9;
  bad[5].position_covariance(1, 0) = nan;
  bad[6].size_variance = nan;
  bad[7].type = FeatureType::count;
  for (std::size_t k = 0; k < bad.size(); ++k)
  {
    EXPECT_THROW(FeatureMap({good, bad[k]}), std::invalid_argument) << k;
  }
  EXPECT_TRUE(FeatureMap().empty());
  EXPECT_EQ(FeatureMap().area(), 0);
}
}  // namespace
}  // namespace sigloc
