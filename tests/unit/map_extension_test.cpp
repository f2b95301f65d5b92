// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "map/building/MapBuilder.h"

using namespace sigloc;
using mrpt::math::TPose2D;

namespace
{
/// A full-circle scan from the middle of a square room of 6 m whose centre is the robot.
PosedScans roomAt(const TPose2D& pose)
{
  LaserScan scan;
  scan.first_angle = -M_PI;
  scan.angle_step = 2 * M_PI / 720;
  scan.max_range = 20;
  for (int i = 0; i < 720; ++i)
  {
    const double angle = scan.first_angle + i * scan.angle_step;
    const double range = 3.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    scan.ranges.push_back(static_cast<float>(range));
    scan.valid.push_back(1);
  }
  return {pose, {scan}};
}

MapBuildingOptions eachSightingCounts()
{
  MapBuildingOptions options;
  options.min_hits = 1;
  options.min_sightings = 1;
  return options;
}

FeatureMap extendMap(const FeatureMap& map, const PosedScans& scans,
                     const MapBuildingOptions& options)
{
  MapBuilder builder(options, std::make_shared<FeatureMap>(map));
  builder.add(scans, {});
  return builder.map();
}
}  // namespace

TEST(MapExtension, AddsOnlyWhatIsNew)
{
  const auto options = eachSightingCounts();
  const FeatureMap map = buildMapFromScans({roomAt({0, 0, 0})}, options);
  ASSERT_GE(map.features().size(), 8U);
  const FeatureMap same = extendMap(map, roomAt({0.02, 0, 0}), options);
  EXPECT_EQ(same.features().size(), map.features().size());

  const FeatureMap larger = extendMap(map, roomAt({20, 5, 0}), options);
  EXPECT_GE(larger.features().size(), map.features().size() + 8) << "four walls, four corners";
  for (std::size_t k = 0; k < larger.features().size(); ++k)
  {
    const std::int32_t parent = larger.features()[k].parent;
    if (parent < 0) continue;
    ASSERT_LT(static_cast<std::size_t>(parent), larger.features().size());
    const Feature& wall = larger.features()[static_cast<std::size_t>(parent)];
    EXPECT_EQ(wall.type, FeatureType::segment);
    EXPECT_LT((wall.position - larger.features()[k].position).norm(), 4.0);
  }
}

TEST(MapExtension, GrowsTheRasterAndKeepsWhatItKnew)
{
  const auto options = eachSightingCounts();
  const FeatureMap map = buildMapFromScans({roomAt({0, 0, 0})}, options);
  const FeatureMap larger = extendMap(map, roomAt({-20, -8, 0}), options);
  ASSERT_TRUE(larger.field());
  EXPECT_GT(larger.field()->wall_cells, map.field()->wall_cells * 3 / 2);
  EXPECT_NEAR(larger.field()->free_area, 2 * map.field()->free_area, 2.0);
  EXPECT_LT(larger.field()->frame.origin.x, -22.9);
  EXPECT_LE(larger.field()->frame.origin.y, -10.9);
}

TEST(MapExtension, LeavesAMapWithoutFieldWithoutOne)
{
  const auto options = eachSightingCounts();
  Feature tree;
  tree.position = {40, 40};
  tree.position_covariance(0, 0) = tree.position_covariance(1, 1) = 0.01;
  const FeatureMap larger = extendMap(FeatureMap({tree}), roomAt({0, 0, 0}), options);
  EXPECT_FALSE(larger.field());
  EXPECT_GT(larger.features().size(), 8U);
}
