// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "eval/worlds/world_generators.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kChord = 0.1;  // [m] of a curved wall; at 2 m of radius it is 0.6 mm off the curve

TPoint2D onCircle(const TPoint2D& centre, double radius, double angle)
{
  return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
}

/// Adds a curved wall of a radius [m] from one angle to the other [rad].
void addArc(World& world, const TPoint2D& centre, double radius, double from, double to)
{
  const int chords = std::max(1, static_cast<int>(std::ceil((to - from) * radius / kChord)));
  TPoint2D last = onCircle(centre, radius, from);
  for (int k = 1; k <= chords; ++k)
  {
    const TPoint2D next = onCircle(centre, radius, from + (to - from) * k / chords);
    world.walls.push_back({last, next});
    last = next;
  }
}

/// The angle [rad] from the middle of a door to its jamb, on a circle.
double halfDoor(double door_width, double radius)
{
  return std::asin(0.5 * door_width / radius);
}

/// A piece of furniture with its back to the wall of a round room, or across a curved corridor.
Furniture againstWall(const TPoint2D& centre, double to_middle, double angle, double length,
                      double width)
{
  const TPoint2D at = onCircle(centre, to_middle, angle);
  return {{at.x, at.y, angle + 0.5 * M_PI}, length, width};
}

/// Adds two unlike pieces of furniture to a round room, away from its door.
void furnishRoom(World& world, const TPoint2D& centre, double radius, double door, Random& random)
{
  const std::array<double, 2> lengths = {random.uniform(0.5, 0.8), random.uniform(1.1, 1.6)};
  double angle = door + random.uniform(0.3, 0.7) * M_PI;
  for (const double length : lengths)
  {
    const double width = random.uniform(0.35, 0.8);
    const double back = std::sqrt(radius * radius - 0.25 * length * length) - 0.03;
    world.furniture.push_back(againstWall(centre, back - 0.5 * width, angle, length, width));
    angle = door + random.uniform(1.0, 1.7) * M_PI;
  }
}

/// A round room beside a curved corridor.
struct RoundRoom
{
  double radius = 0;  // [m]
  double angle = 0;  // [rad] from the middle of the corridor
};

/// Returns rooms of random radius, as many as find place along the corridor from one angle to the
/// other. `gap` [m] is between the corridor and a room.
std::vector<RoundRoom> roomsAlong(double corridor, double gap, double from, double to,
                                  Random& random)
{
  std::vector<RoundRoom> rooms;
  while (true)
  {
    RoundRoom room{random.uniform(1.8, 3.2), 0};
    if (rooms.empty())
    {
      room.angle = from + std::asin(room.radius / (corridor + room.radius));
    }
    else
    {
      const double a = corridor + gap + room.radius;
      const double b = corridor + gap + rooms.back().radius;
      const double apart = room.radius + rooms.back().radius + gap + random.uniform(0.0, 0.5);
      const double cosine = (a * a + b * b - apart * apart) / (2 * a * b);
      room.angle = rooms.back().angle + std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    if (room.angle + std::asin(room.radius / (corridor + room.radius)) > to) return rooms;
    rooms.push_back(room);
  }
}
}  // namespace

World detail::makeRound(const WorldOptions& options, Random& random)
{
  const double side = options.width > 0 ? options.width : 28.0;
  if (side < 22) throw std::invalid_argument("a round world needs at least 22 m");
  constexpr double kLargestRoom = 3.2;  // [m]
  const double gap = options.wall_thickness;
  const TPoint2D centre(0.5 * side, 0.5 * side);
  const double outer = 0.5 * side - gap - 2 * kLargestRoom - 0.1;
  const double inner = outer - random.uniform(1.8, 2.3);
  const double hall = inner - gap;
  // The corridor is no full circle, so that it is not its own turn.
  const double begin = random.uniform(-M_PI, M_PI);
  const double end = begin + random.uniform(1.5, 1.8) * M_PI;

  World world;
  world.bounds = {0, side, 0, side};
  world.inside = centre;
  const std::vector<RoundRoom> rooms = roomsAlong(outer, gap, begin, end, random);

  // The wall between the corridor and the rooms, with their doors.
  double from = begin;
  for (const RoundRoom& room : rooms)
  {
    const double in_corridor = halfDoor(options.door_width, outer);
    const double in_room = halfDoor(options.door_width, room.radius);
    const TPoint2D middle = onCircle(centre, outer + gap + room.radius, room.angle);
    addArc(world, centre, outer, from, room.angle - in_corridor);
    from = room.angle + in_corridor;
    const double door = room.angle + M_PI;  // as seen from the middle of the room
    addArc(world, middle, room.radius, door + in_room, door + 2 * M_PI - in_room);
    for (const double sign : {-1.0, 1.0})
    {
      world.walls.push_back({onCircle(centre, outer, room.angle + sign * in_corridor),
                             onCircle(middle, room.radius, door - sign * in_room)});
    }
    world.doors.push_back({{onCircle(centre, outer, room.angle - in_corridor),
                            onCircle(centre, outer, room.angle + in_corridor)},
                           false});
    furnishRoom(world, middle, room.radius, door, random);
  }
  addArc(world, centre, outer, from, end);

  // The ends of the corridor, and the round hall in its middle.
  for (const double angle : {begin, end})
  {
    world.walls.push_back({onCircle(centre, inner, angle), onCircle(centre, outer, angle)});
  }
  const double opening = begin + random.uniform(0.2, 0.8) * (end - begin);
  const double in_corridor = halfDoor(options.door_width, inner);
  const double in_hall = halfDoor(options.door_width, hall);
  addArc(world, centre, inner, begin, opening - in_corridor);
  addArc(world, centre, inner, opening + in_corridor, end);
  addArc(world, centre, hall, opening + in_hall, opening + 2 * M_PI - in_hall);
  for (const double sign : {-1.0, 1.0})
  {
    world.walls.push_back({onCircle(centre, inner, opening + sign * in_corridor),
                           onCircle(centre, hall, opening + sign * in_hall)});
  }
  world.doors.push_back({{onCircle(centre, inner, opening - in_corridor),
                          onCircle(centre, inner, opening + in_corridor)},
                         false});
  furnishRoom(world, centre, hall, opening, random);

  // Two pieces along the inner wall of the corridor, on either side of the hall's door.
  const std::array<double, 2> lengths = {random.uniform(0.5, 0.8), random.uniform(1.0, 1.5)};
  for (std::size_t k = 0; k < 2; ++k)
  {
    const double share = random.uniform(0.2, 0.8);
    const double clear = 0.2;  // [rad] from the door
    const double low = k == 0 ? begin + clear : opening + clear;
    const double high = k == 0 ? opening - clear : end - clear;
    world.furniture.push_back(
        againstWall(centre, inner + 0.2, low + share * (high - low), lengths[k], 0.36));
  }
  return world;
}
}  // namespace sigloc
