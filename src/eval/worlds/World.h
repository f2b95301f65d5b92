// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "sigloc/config/option_fields.h"

namespace sigloc
{
/// A straight surface, seen from both sides.
struct WallSegment
{
  mrpt::math::TPoint2D start;  ///< [m]
  mrpt::math::TPoint2D end;  ///< [m]
};

/// A pillar, post or trunk.
struct Disc
{
  mrpt::math::TPoint2D centre;  ///< [m]
  double radius = 0;  ///< [m]
};

/// A movable rectangular object.
struct Furniture
{
  mrpt::math::TPose2D pose;  ///< world_from_furniture, at its centre
  double length = 0;  ///< [m], along its x axis
  double width = 0;  ///< [m], along its y axis
};

/// An opening in a wall that a door leaf may close.
struct Door
{
  WallSegment leaf;
  bool closed = false;
};

/// An axis-aligned rectangle [m].
struct Bounds
{
  double x_min = 0;
  double x_max = 0;
  double y_min = 0;
  double y_max = 0;

  bool contains(const mrpt::math::TPoint2D& p) const
  {
    return p.x >= x_min && p.x <= x_max && p.y >= y_min && p.y <= y_max;
  }
};

/// A simulated world: plain data, in metres.
struct World
{
  Bounds bounds;  ///< where the robot can be; outer walls reach half a thickness beyond
  std::vector<WallSegment> walls;
  std::vector<Disc> discs;
  std::vector<Furniture> furniture;
  std::vector<Door> doors;
  std::vector<mrpt::math::TPoint2D> points;  ///< landmarks, which no laser sees
  /// Where a robot can be, if the largest free space is not where it is.
  std::optional<mrpt::math::TPoint2D> inside;
};

/// A world, and where its origin lies in the map [m].
struct PlacedWorld
{
  World world;
  mrpt::math::TPoint2D origin;
};

/// Returns every straight surface a laser sees: walls, furniture outlines and closed doors.
std::vector<WallSegment> visibleSegments(const World& world);

/// Returns the four sides of a piece of furniture, counter-clockwise.
std::vector<WallSegment> outlineOf(const Furniture& furniture);

/// Returns the mirror image of the world, within the same bounds: x is turned around.
World mirrored(World world);

/// How the world of a drive differs from the world that was mapped.
struct WorldChangeOptions
{
  double moved_share = 0;
  double move_distance = 1.0;
  std::uint32_t extra_items = 0;
  double closed_door_share = 0;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = WorldChangeOptions;
    visit(OptionField{"moved_share", &O::moved_share, 0.0, 1.0,
                      "[-] share of the furniture that is moved"});
    visit(OptionField{"move_distance", &O::move_distance, 0.0, 100.0,
                      "[m] standard deviation of a move along each axis"});
    visit(OptionField{"extra_items", &O::extra_items, 0U, 100000U,
                      "[-] unmapped pieces of furniture that are added"});
    visit(OptionField{"closed_door_share", &O::closed_door_share, 0.0, 1.0,
                      "[-] share of the doors that are closed"});
  }
};

/// Returns the world with furniture moved, unmapped pieces added and doors shut; moved and new
/// pieces stay inside the bounds. Throws std::invalid_argument for options out of range.
World changedWorld(const World& mapped, const WorldChangeOptions& options, std::uint64_t seed);
}  // namespace sigloc
