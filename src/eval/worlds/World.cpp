// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/World.h"

#include <algorithm>
#include <cmath>

#include "eval/worlds/Random.h"

namespace sigloc
{

std::vector<WallSegment> outlineOf(const Furniture& furniture)
{
  const double dx = 0.5 * furniture.length;
  const double dy = 0.5 * furniture.width;
  const std::vector<mrpt::math::TPoint2D> corners = {
      furniture.pose.composePoint({-dx, -dy}), furniture.pose.composePoint({dx, -dy}),
      furniture.pose.composePoint({dx, dy}), furniture.pose.composePoint({-dx, dy})};
  return {{corners[0], corners[1]},
          {corners[1], corners[2]},
          {corners[2], corners[3]},
          {corners[3], corners[0]}};
}

std::vector<WallSegment> visibleSegments(const World& world)
{
  std::vector<WallSegment> segments = world.walls;
  for (const Furniture& item : world.furniture)
  {
    const std::vector<WallSegment> sides = outlineOf(item);
    segments.insert(segments.end(), sides.begin(), sides.end());
  }
  for (const Door& door : world.doors)
  {
    if (door.closed) segments.push_back(door.leaf);
  }
  return segments;
}

World mirrored(World world)
{
  const double sum = world.bounds.x_min + world.bounds.x_max;
  const auto flip = [&](mrpt::math::TPoint2D& p) { p.x = sum - p.x; };
  for (WallSegment& wall : world.walls)
  {
    flip(wall.start);
    flip(wall.end);
  }
  for (Disc& disc : world.discs) flip(disc.centre);
  for (Furniture& item : world.furniture)
  {
    item.pose.x = sum - item.pose.x;
    item.pose.phi = -item.pose.phi;
  }
  for (Door& door : world.doors)
  {
    flip(door.leaf.start);
    flip(door.leaf.end);
  }
  for (mrpt::math::TPoint2D& point : world.points) flip(point);
  if (world.inside) flip(*world.inside);
  return world;
}

World changedWorld(const World& mapped, const WorldChangeOptions& options, std::uint64_t seed)
{
  checkOptions(options);
  World world = mapped;
  const Bounds& b = world.bounds;
  // Each kind of change has a random stream of its own: closing doors does not change where the
  // furniture moves.
  Random moves(seed, 1);
  Random extras(seed, 2);
  Random doors(seed, 3);
  for (Furniture& item : world.furniture)
  {
    if (!moves.chance(options.moved_share)) continue;
    const double reach = 0.5 * std::hypot(item.length, item.width);
    const double x = item.pose.x + options.move_distance * moves.normal();
    const double y = item.pose.y + options.move_distance * moves.normal();
    item.pose.x = std::max(b.x_min + reach, std::min(b.x_max - reach, x));
    item.pose.y = std::max(b.y_min + reach, std::min(b.y_max - reach, y));
    item.pose.phi += 0.3 * moves.normal();
  }
  for (std::uint32_t i = 0; i < options.extra_items; ++i)
  {
    Furniture item;
    item.length = extras.uniform(0.3, 1.2);
    item.width = extras.uniform(0.3, 0.8);
    const double reach = 0.5 * std::hypot(item.length, item.width);
    item.pose.x = extras.uniform(b.x_min + reach, b.x_max - reach);
    item.pose.y = extras.uniform(b.y_min + reach, b.y_max - reach);
    item.pose.phi = extras.uniform(-M_PI, M_PI);
    world.furniture.push_back(item);
  }
  for (Door& door : world.doors)
  {
    if (doors.chance(options.closed_door_share)) door.closed = true;
  }
  return world;
}
}  // namespace sigloc
