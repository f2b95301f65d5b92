// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/World.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eval/worlds/FreeSpace.h"
#include "eval/worlds/LaserSimulator.h"
#include "eval/worlds/world_generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

bool sameSurfaces(const World& a, const World& b)
{
  const auto sa = visibleSegments(a);
  const auto sb = visibleSegments(b);
  if (sa.size() != sb.size() || a.discs.size() != b.discs.size()) return false;
  for (std::size_t i = 0; i < sa.size(); ++i)
  {
    if (sa[i].start != sb[i].start || sa[i].end != sb[i].end) return false;
  }
  for (std::size_t i = 0; i < a.discs.size(); ++i)
  {
    if (a.discs[i].centre != b.discs[i].centre) return false;
  }
  return a.points == b.points;
}

TEST(World, SameSeedSameWorldOtherSeedOtherWorld)
{
  for (const WorldKind kind : {WorldKind::office, WorldKind::corridor, WorldKind::hall,
                               WorldKind::park, WorldKind::points, WorldKind::round})
  {
    EXPECT_TRUE(sameSurfaces(makeWorld(kind, {}, 4), makeWorld(kind, {}, 4))) << toString(kind);
    EXPECT_FALSE(sameSurfaces(makeWorld(kind, {}, 4), makeWorld(kind, {}, 5))) << toString(kind);
    EXPECT_EQ(worldKindFrom(toString(kind)), kind);
  }
  EXPECT_THROW(worldKindFrom("moon"), std::invalid_argument);
}

TEST(World, CopiesOfARoomAreExactUnlessJittered)
{
  WorldOptions options;
  options.copies = 5;
  options.closed_door_share = 1;  // nothing but the room itself is seen from inside
  const LaserSimulator exact(makeWorld(WorldKind::corridor, options, 3));
  options.jitter = 0.1;
  const LaserSimulator jittered(makeWorld(WorldKind::corridor, options, 3));
  const double pitch = 5.0;
  const TPose2D place{2.0 + 2.5, 2.0 + 2.6, 0.7};
  const LaserScan first = exact.exactScan(place);
  const LaserScan first_jittered = jittered.exactScan(place);
  for (int k = 1; k < 5; ++k)
  {
    const TPose2D copy{place.x + pitch * k, place.y, place.phi};
    const LaserScan scan = exact.exactScan(copy);
    const LaserScan scan_jittered = jittered.exactScan(copy);
    double largest = 0;
    double largest_jittered = 0;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      largest = std::max<double>(largest, std::abs(scan.ranges[i] - first.ranges[i]));
      largest_jittered = std::max<double>(
          largest_jittered, std::abs(scan_jittered.ranges[i] - first_jittered.ranges[i]));
    }
    EXPECT_LT(largest, 1e-4) << "copy " << k;
    EXPECT_GT(largest_jittered, 0.02) << "copy " << k;
  }
}

TEST(World, RobotsOfRoundWorldsAreIndoors)
{
  const World world = makeWorld(WorldKind::round, {}, 6);
  const FreeSpace space(world, 0.35);
  const double side = world.bounds.x_max - world.bounds.x_min;
  ASSERT_GE(world.doors.size(), 6U);
  EXPECT_EQ(world.furniture.size(), 2 * (world.doors.size() + 1));  // and the corridor
  EXPECT_FALSE(space.contains({0.5, 0.5}));
  EXPECT_FALSE(space.contains({side - 0.5, side - 0.5}));
  // Every door lets the robot through.
  for (const Door& door : world.doors)
  {
    EXPECT_TRUE(space.contains((door.leaf.start + door.leaf.end) * 0.5));
  }
  // Surfaces surround the robot everywhere.
  const LaserSimulator simulator(world, {});
  Random random(6, 1);
  for (int k = 0; k < 50; ++k)
  {
    const auto place = space.randomPlace(random);
    const LaserScan scan = simulator.exactScan({place.x, place.y, 0});
    EXPECT_EQ(std::count(scan.valid.begin(), scan.valid.end(), 0), 0) << place.x << " " << place.y;
  }
  WorldOptions small;
  small.width = 10;
  EXPECT_THROW(makeWorld(WorldKind::round, small, 6), std::invalid_argument);
}

TEST(World, StandardPointWorldHasItsDensity)
{
  WorldOptions options;
  options.points = 1000000;
  const World world = makeWorld(WorldKind::points, options, 1);
  ASSERT_EQ(world.points.size(), 1000000U);
  const double area =
      (world.bounds.x_max - world.bounds.x_min) * (world.bounds.y_max - world.bounds.y_min);
  EXPECT_NEAR(1e6 / area, 0.1, 1e-9);
  for (const auto& point : world.points) ASSERT_TRUE(world.bounds.contains(point));
}

TEST(World, ChangesMoveAddAndClose)
{
  const World mapped = makeWorld(WorldKind::office, {}, 2);
  ASSERT_GT(mapped.furniture.size(), 10U);
  ASSERT_GT(mapped.doors.size(), 4U);
  EXPECT_TRUE(sameSurfaces(mapped, changedWorld(mapped, {}, 1)));

  WorldChangeOptions changes;
  changes.moved_share = 0.5;
  changes.extra_items = 6;
  changes.closed_door_share = 1;
  const World driven = changedWorld(mapped, changes, 1);
  EXPECT_EQ(driven.furniture.size(), mapped.furniture.size() + 6);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < mapped.furniture.size(); ++i)
  {
    moved += driven.furniture[i].pose.x != mapped.furniture[i].pose.x ? 1 : 0;
  }
  EXPECT_GT(moved, mapped.furniture.size() / 4);
  EXPECT_LT(moved, mapped.furniture.size() * 3 / 4);
  for (const Door& door : driven.doors) EXPECT_TRUE(door.closed);
  for (const Furniture& item : driven.furniture)
  {
    for (const WallSegment& side : outlineOf(item)) EXPECT_TRUE(mapped.bounds.contains(side.start));
  }
}
}  // namespace
}  // namespace sigloc
