// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/world_generators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "eval/worlds/Random.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::array<const char*, 6> kKindNames = {"office", "corridor", "hall",
                                                   "park",   "points",   "round"};

/// An opening along a wall, as distances from the wall's start [m].
struct Opening
{
  double from = 0;
  double to = 0;
};

/// Adds one axis-aligned block of wall.
void addBlock(World& world, double x0, double x1, double y0, double y1)
{
  const std::array<TPoint2D, 4> c = {TPoint2D{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (std::size_t i = 0; i < 4; ++i) world.walls.push_back({c[i], c[(i + 1) % 4]});
}

/// Adds a wall along x (or y) with openings in ascending order, each with a door leaf.
void addWall(World& world, TPoint2D start, double length, bool along_x, double thickness,
             const std::vector<Opening>& openings = {})
{
  const double half = 0.5 * thickness;
  const auto block = [&](double from, double to)
  {
    if (along_x)
    {
      addBlock(world, start.x + from, start.x + to, start.y - half, start.y + half);
    }
    else
    {
      addBlock(world, start.x - half, start.x + half, start.y + from, start.y + to);
    }
  };
  double from = -half;
  for (const Opening& opening : openings)
  {
    block(from, opening.from);
    const TPoint2D axis = along_x ? TPoint2D{1, 0} : TPoint2D{0, 1};
    world.doors.push_back({{start + axis * opening.from, start + axis * opening.to}, false});
    from = opening.to;
  }
  block(from, length + half);
}

void addOuterWalls(World& world, double thickness)
{
  const Bounds& b = world.bounds;
  addWall(world, {b.x_min, b.y_min}, b.x_max - b.x_min, true, thickness);
  addWall(world, {b.x_min, b.y_max}, b.x_max - b.x_min, true, thickness);
  addWall(world, {b.x_min, b.y_min}, b.y_max - b.y_min, false, thickness);
  addWall(world, {b.x_max, b.y_min}, b.y_max - b.y_min, false, thickness);
}

/// Returns about `mean` pieces of furniture in a room: most against its long sides, some askew.
/// Pieces keep clear of `keep_free`, so that no door is blocked.
std::vector<Furniture> furnish(const Bounds& room, double mean, const TPoint2D& keep_free,
                               Random& random)
{
  std::vector<Furniture> items;
  const auto count =
      static_cast<std::size_t>(std::lround(std::max(0.0, mean + random.uniform(-1.0, 1.0))));
  for (std::size_t attempt = 0; attempt < 20 * count && items.size() < count; ++attempt)
  {
    Furniture item;
    item.length = random.uniform(0.5, 1.6);
    item.width = random.uniform(0.35, 0.8);
    const bool askew = random.chance(0.3);
    const double phi = random.uniform(0.2, M_PI / 2 - 0.2);
    const bool upper = random.chance(0.5);
    const double reach = askew ? 0.5 * std::hypot(item.length, item.width) : 0.5 * item.length;
    const double depth = askew ? reach : 0.5 * item.width + 0.02;
    item.pose.x = random.uniform(room.x_min + reach + 0.02, room.x_max - reach - 0.02);
    item.pose.y = askew ? random.uniform(room.y_min + depth, room.y_max - depth)
                        : (upper ? room.y_max - depth : room.y_min + depth);
    item.pose.phi = askew ? phi : 0.0;
    const double door_gap = std::hypot(item.pose.x - keep_free.x, item.pose.y - keep_free.y);
    bool clear = door_gap > reach + 0.9;
    for (const Furniture& other : items)
    {
      const double gap = std::hypot(item.pose.x - other.pose.x, item.pose.y - other.pose.y);
      clear = clear && gap > reach + 0.5 * std::hypot(other.length, other.width);
    }
    if (clear) items.push_back(item);
  }
  return items;
}

/// Adds a row of rooms of random width between x_min and x_max; their doors open to the corridor.
void addRoomRow(World& world, double y_corridor, double y_outer, const WorldOptions& options,
                Random& random)
{
  const double half = 0.5 * options.wall_thickness;
  const bool above = y_outer > y_corridor;
  const double y_low = std::min(y_corridor, y_outer);
  const double y_high = std::max(y_corridor, y_outer);
  std::vector<Opening> openings;
  double x = world.bounds.x_min;
  while (x < world.bounds.x_max - 0.1)
  {
    double width = random.uniform(2.8, 6.0);
    if (x + width > world.bounds.x_max - 2.8) width = world.bounds.x_max - x;
    const double door_x = x + random.uniform(0.3, width - options.door_width - 0.3);
    openings.push_back(
        {door_x - world.bounds.x_min, door_x - world.bounds.x_min + options.door_width});
    const Bounds room{x + half, x + width - half, y_low + half, y_high - half};
    const TPoint2D door{door_x + 0.5 * options.door_width, above ? y_low : y_high};
    const auto items = furnish(room, options.furniture_per_room, door, random);
    world.furniture.insert(world.furniture.end(), items.begin(), items.end());
    if (x + width < world.bounds.x_max - 0.1)
    {
      addWall(world, {x + width, y_low}, y_high - y_low, false, options.wall_thickness);
    }
    x += width;
  }
  addWall(world, {world.bounds.x_min, y_corridor}, world.bounds.x_max - world.bounds.x_min, true,
          options.wall_thickness, openings);
}

/// Returns an x well inside the world that is in front of no door, as far as a few tries find one.
double xAwayFromDoors(const World& world, Random& random)
{
  constexpr double kReach = 1.0;  // [m]
  double x = 0;
  for (int attempt = 0; attempt < 50; ++attempt)
  {
    x = random.uniform(0.05, 0.95) * world.bounds.x_max;
    bool clear = true;
    for (const Door& door : world.doors)
    {
      clear = clear && (x < door.leaf.start.x - kReach || x > door.leaf.end.x + kReach);
    }
    if (clear) break;
  }
  return x;
}

World makeOffice(const WorldOptions& options, Random& random)
{
  World world;
  const double width = options.width > 0 ? options.width : 24.0;
  const double height = options.height > 0 ? options.height : 13.0;
  if (width < 8 || height < 8) throw std::invalid_argument("an office needs at least 8 m x 8 m");
  world.bounds = {0, width, 0, height};
  addOuterWalls(world, options.wall_thickness);
  const double corridor = random.uniform(1.8, 2.3);
  const double y_low = random.uniform(0.36, 0.44) * (height - corridor);
  addRoomRow(world, y_low, 0, options, random);
  addRoomRow(world, y_low + corridor, height, options, random);
  // A cabinet and a pillar along the corridor break its symmetry.
  const double cabinet_y = y_low + 0.5 * options.wall_thickness + 0.2;
  world.furniture.push_back({{xAwayFromDoors(world, random), cabinet_y, 0}, 0.9, 0.36});
  world.discs.push_back({{xAwayFromDoors(world, random), y_low + corridor - 0.3}, 0.18});
  return world;
}

World makeCorridor(const WorldOptions& options, Random& random)
{
  World world;
  const double room_width = options.width > 0 ? options.width : 5.0;
  const double room_depth = options.height > 0 ? options.height : 4.5;
  const double door_width = options.door_width;
  if (room_width < door_width + 1.0 || room_depth < 2)
  {
    throw std::invalid_argument("a room of the corridor world is too small for its door");
  }
  constexpr double kCorridorWidth = 2.0;
  constexpr double kCorridorEnd = 2.0;  // beyond the first and last room
  const double half = 0.5 * options.wall_thickness;
  const double length = room_width * options.copies + 2 * kCorridorEnd;
  world.bounds = {0, length, 0, kCorridorWidth + room_depth};
  addOuterWalls(world, options.wall_thickness);

  const double door_at = random.uniform(0.3, room_width - door_width - 0.3);
  const Bounds room{half, room_width - half, half, room_depth - half};
  const auto items =
      furnish(room, options.furniture_per_room, {door_at + 0.5 * door_width, 0.0}, random);
  const TPoint2D pillar{random.uniform(0.25, 0.4) * room_width,
                        random.uniform(0.4, 0.5) * room_depth};
  std::vector<Opening> openings;
  for (std::uint32_t k = 0; k < options.copies; ++k)
  {
    const double x = kCorridorEnd + room_width * k;
    openings.push_back({x + door_at, x + door_at + door_width});
    addWall(world, {x, kCorridorWidth}, room_depth, false, options.wall_thickness);
    for (Furniture item : items)
    {
      item.pose.x += x;
      item.pose.y += kCorridorWidth;
      if (options.jitter > 0)
      {
        item.pose.x += options.jitter * random.normal();
        item.pose.y += options.jitter * random.normal();
      }
      world.furniture.push_back(item);
    }
    world.discs.push_back({{x + pillar.x, kCorridorWidth + pillar.y}, 0.15});
  }
  addWall(world, {length - kCorridorEnd, kCorridorWidth}, room_depth, false,
          options.wall_thickness);
  addWall(world, {0, kCorridorWidth}, length, true, options.wall_thickness, openings);
  return world;
}

World makeHall(const WorldOptions& options, Random& random)
{
  World world;
  const double width = options.width > 0 ? options.width : 40.0;
  const double height = options.height > 0 ? options.height : 25.0;
  if (width < 12 || height < 12) throw std::invalid_argument("a hall needs at least 12 m x 12 m");
  world.bounds = {0, width, 0, height};
  addOuterWalls(world, options.wall_thickness);
  constexpr double kPitch = 6.0;
  for (double x = kPitch; x < width - 2; x += kPitch)
  {
    for (double y = kPitch; y < height - 2; y += kPitch)
    {
      if (random.chance(0.15)) continue;  // a missing pillar now and then breaks the lattice
      const TPoint2D centre{x + 0.1 * random.normal(), y + 0.1 * random.normal()};
      world.discs.push_back({centre, random.chance(0.5) ? 0.3 : 0.22});
    }
  }
  // Closets built into the outer walls: without them a hall is its own half turn.
  for (double x = random.uniform(2, 6); x < width - 6; x += random.uniform(7, 15))
  {
    const double size = random.uniform(1.5, 4.0);
    const double depth = random.uniform(0.5, 2.0);
    const bool upper = random.chance(0.5);
    addBlock(world, x, x + size, upper ? height - depth : 0, upper ? height : depth);
  }
  return world;
}

World makePark(const WorldOptions& options, Random& random)
{
  World world;
  const double width = options.width > 0 ? options.width : 60.0;
  const double height = options.height > 0 ? options.height : 60.0;
  const double density = options.density > 0 ? options.density : 0.03;
  world.bounds = {0, width, 0, height};
  const auto count = static_cast<std::size_t>(width * height * density);
  constexpr double kClearance = 1.6;  // the robot passes between any two trunks
  if (density > 0.2) throw std::invalid_argument("a park holds at most 0.2 trunks a square metre");
  // Trunks on a lattice of buckets: one bucket holds at most one trunk, neighbours are looked up.
  const auto columns = static_cast<std::size_t>(width / kClearance) + 1;
  const auto rows = static_cast<std::size_t>(height / kClearance) + 1;
  std::vector<std::vector<std::size_t>> buckets(columns * rows);
  for (std::size_t attempt = 0; attempt < 50 * count && world.discs.size() < count; ++attempt)
  {
    const TPoint2D p{random.uniform(0.5, width - 0.5), random.uniform(0.5, height - 0.5)};
    const double radius = random.uniform(0.08, 0.35);
    const auto column = static_cast<std::size_t>(p.x / kClearance);
    const auto row = static_cast<std::size_t>(p.y / kClearance);
    bool clear = true;
    for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, rows - 1); ++r)
    {
      for (std::size_t c = column == 0 ? 0 : column - 1; c <= std::min(column + 1, columns - 1);
           ++c)
      {
        for (const std::size_t other : buckets[r * columns + c])
        {
          const TPoint2D d = world.discs[other].centre - p;
          clear = clear && d.x * d.x + d.y * d.y > kClearance * kClearance;
        }
      }
    }
    if (!clear) continue;
    buckets[row * columns + column].push_back(world.discs.size());
    world.discs.push_back({p, radius});
  }
  return world;
}
}  // namespace

const char* toString(WorldKind kind)
{
  return kKindNames.at(static_cast<std::size_t>(kind));
}

WorldKind worldKindFrom(const std::string& text)
{
  const auto found = std::find(kKindNames.begin(), kKindNames.end(), text);
  if (found == kKindNames.end())
  {
    throw std::invalid_argument("'" + text + "' is no kind of world");
  }
  return static_cast<WorldKind>(found - kKindNames.begin());
}

World makeWorld(WorldKind kind, const WorldOptions& options, std::uint64_t seed)
{
  checkOptions(options);
  Random random(seed, 100 + static_cast<std::uint64_t>(kind));
  World world;
  switch (kind)
  {
    case WorldKind::office:
      world = makeOffice(options, random);
      break;
    case WorldKind::corridor:
      world = makeCorridor(options, random);
      break;
    case WorldKind::hall:
      world = makeHall(options, random);
      break;
    case WorldKind::park:
      world = makePark(options, random);
      break;
    case WorldKind::points:
      world = detail::makePoints(options, random);
      break;
    case WorldKind::round:
      world = detail::makeRound(options, random);
      break;
  }
  Random doors(seed, 200);
  for (Door& door : world.doors) door.closed = doors.chance(options.closed_door_share);
  return world;
}

bool usesOption(WorldKind kind, std::string_view key)
{
  using Kinds = std::vector<WorldKind>;
  const Kinds rooms = {WorldKind::office, WorldKind::corridor};
  const Kinds with_doors = {WorldKind::office, WorldKind::corridor, WorldKind::round};
  const Kinds scanned = {WorldKind::office, WorldKind::corridor, WorldKind::hall, WorldKind::park,
                         WorldKind::round};
  static const std::map<std::string_view, Kinds> kUsers = {
      {"width", scanned},
      {"height", {WorldKind::office, WorldKind::corridor, WorldKind::hall, WorldKind::park}},
      {"wall_thickness",
       {WorldKind::office, WorldKind::corridor, WorldKind::hall, WorldKind::round}},
      {"door_width", with_doors},
      {"furniture_per_room", rooms},
      {"closed_door_share", with_doors},
      {"copies", {WorldKind::corridor}},
      {"jitter", {WorldKind::corridor}},
      {"density", {WorldKind::park, WorldKind::points}},
      {"points", {WorldKind::points}},
      {"patches", {WorldKind::points}},
      {"moved_share", with_doors},
      {"move_distance", with_doors},
      {"extra_items", scanned}};
  const auto users = kUsers.find(key);
  return users == kUsers.end() ||
         std::find(users->second.begin(), users->second.end(), kind) != users->second.end();
}
}  // namespace sigloc
