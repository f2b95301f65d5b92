// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/buildings/buildings.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <set>

#include "bridge/rawlog_files.h"
#include "eval/worlds/simulation_files.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;

constexpr double kClearance = 0.35;  // [m]

BuildingOptions ofCount(std::uint32_t count)
{
  BuildingOptions options;
  options.buildings = count;
  return options;
}

Bounds placedBounds(const PlacedWorld& building)
{
  const Bounds& b = building.world.bounds;
  const TPoint2D& o = building.origin;
  return {o.x + b.x_min, o.x + b.x_max, o.y + b.y_min, o.y + b.y_max};
}

TEST(Buildings, LieSideBySideAndDiffer)
{
  const auto buildings = makeBuildings(WorldKind::office, {}, ofCount(7), 3);
  ASSERT_EQ(buildings.size(), 7U);
  EXPECT_EQ(buildings.front().origin, TPoint2D(0, 0));
  std::set<double> first_walls;
  for (std::size_t i = 0; i < buildings.size(); ++i)
  {
    first_walls.insert(buildings[i].world.furniture.front().pose.x);
    for (std::size_t k = i + 1; k < buildings.size(); ++k)
    {
      const Bounds a = placedBounds(buildings[i]);
      const Bounds b = placedBounds(buildings[k]);
      const double gap = std::max(std::max(a.x_min, b.x_min) - std::min(a.x_max, b.x_max),
                                  std::max(a.y_min, b.y_min) - std::min(a.y_max, b.y_max));
      EXPECT_NEAR(std::max(gap, 2.0), gap, 1e-9) << i << ' ' << k;
    }
  }
  EXPECT_EQ(first_walls.size(), 7U);
}

TEST(Buildings, OfTwoNeighbouringSeedsShareNone)
{
  std::set<double> places;
  for (const std::uint64_t seed : {1, 2, 3})
  {
    for (const auto& [world, origin] : makeBuildings(WorldKind::office, {}, ofCount(6), seed))
    {
      places.insert(world.furniture.front().pose.x);
    }
  }
  EXPECT_EQ(places.size(), 18U);
}

TEST(Buildings, IdenticalOnesAreSeenAlike)
{
  BuildingOptions options = ofCount(3);
  options.identical = true;
  const auto buildings = makeBuildings(WorldKind::office, {}, options, 5);
  const mrpt::math::TPose2D pose{4.0, 6.3, 0.4};
  const LaserScan first = LaserSimulator(buildings[0].world).exactScan(pose);
  for (std::size_t k = 1; k < 3; ++k)
  {
    EXPECT_EQ(LaserSimulator(buildings[k].world).exactScan(pose).ranges, first.ranges);
  }
}

TEST(Buildings, WithoutOuterWallsStandAlone)
{
  EXPECT_NO_THROW(makeBuildings(WorldKind::park, {}, ofCount(1), 1));
  EXPECT_THROW(makeBuildings(WorldKind::park, {}, ofCount(2), 1), std::invalid_argument);
}

TEST(Buildings, QueriesStandInFreeSpaceOfManyBuildings)
{
  const auto buildings = makeBuildings(WorldKind::office, {}, ofCount(5), 3);
  const auto queries = simulateQueries(buildings, 60, kClearance, {}, 9);
  ASSERT_EQ(queries.size(), 60U);
  std::set<std::size_t> visited;
  for (const PosedScans& query : queries)
  {
    const auto& pose = query.map_from_robot;
    for (std::size_t k = 0; k < buildings.size(); ++k)
    {
      if (!placedBounds(buildings[k]).contains({pose.x, pose.y})) continue;
      visited.insert(k);
      const TPoint2D local = TPoint2D(pose.x, pose.y) - buildings[k].origin;
      EXPECT_TRUE(FreeSpace(buildings[k].world, kClearance).contains(local));
      // The scan is that of this building: noise apart, the ranges are the exact ones.
      const LaserScan exact =
          LaserSimulator(buildings[k].world).exactScan({local.x, local.y, pose.phi});
      for (std::size_t i = 0; i < exact.ranges.size(); i += 20)
      {
        EXPECT_NEAR(query.scans.front().ranges[i], exact.ranges[i], 0.15);
      }
    }
  }
  EXPECT_EQ(visited.size(), 5U);
}

TEST(Buildings, GridMapShowsEachOfThem)
{
  const test::TemporaryFolder folder;
  const auto buildings = makeBuildings(WorldKind::office, {}, ofCount(4), 3);
  writeGridMap(buildings, 0.1, folder / "m.gridmap.gz");
  mrpt::io::CFileGZInputStream file((folder / "m.gridmap.gz").string());
  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(file) >> grid;
  for (const PosedScans& mapping : simulateMapping(buildings, 4.0, kClearance, {}, 3))
  {
    const auto& pose = mapping.map_from_robot;
    EXPECT_GT(grid.getPos(static_cast<float>(pose.x), static_cast<float>(pose.y)), 0.9F);
  }
  for (const PlacedWorld& building : buildings)
  {
    const Bounds b = placedBounds(building);
    EXPECT_LT(grid.getPos(static_cast<float>(b.x_min + 3.0), static_cast<float>(b.y_min + 0.06)),
              0.1F);
  }
}
}  // namespace
}  // namespace sigloc
