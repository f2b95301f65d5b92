// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/buildings/buildings.h"

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace
{
/// Returns the seed of building k: that of the whole for the first. The others share none with the
/// buildings of a neighbouring seed.
std::uint64_t seedOf(std::size_t k, std::uint64_t seed)
{
  if (k == 0) return seed;
  constexpr std::size_t kSeeds = std::size_t{1} << 53U;
  return Random(seed, 1000 + k).index(kSeeds);
}

bool hasOuterWalls(WorldKind kind)
{
  return kind == WorldKind::office || kind == WorldKind::corridor || kind == WorldKind::hall ||
         kind == WorldKind::round;
}

TPose2D placed(const TPoint2D& origin, const TPose2D& pose)
{
  return {origin.x + pose.x, origin.y + pose.y, pose.phi};
}
}  // namespace

std::vector<PlacedWorld> makeBuildings(WorldKind kind, const WorldOptions& layout,
                                       const BuildingOptions& options, std::uint64_t seed)
{
  checkOptions(options);
  if (options.buildings > 1 && !hasOuterWalls(kind))
  {
    throw std::invalid_argument(std::string("several buildings: world ") + toString(kind) +
                                " has no outer walls");
  }
  std::vector<PlacedWorld> buildings;
  buildings.reserve(options.buildings);
  std::size_t columns = 1;
  TPoint2D pitch;
  for (std::size_t k = 0; k < options.buildings; ++k)
  {
    World world = makeWorld(kind, layout, options.identical ? seed : seedOf(k, seed));
    if (options.mirrored) world = mirrored(std::move(world));
    if (k == 0)
    {
      pitch = {world.bounds.x_max - world.bounds.x_min + options.building_gap,
               world.bounds.y_max - world.bounds.y_min + options.building_gap};
      const double square = std::sqrt(options.buildings * pitch.y / pitch.x);
      columns = static_cast<std::size_t>(std::max(1.0, std::round(square)));
    }
    const std::size_t row = k / columns;
    const TPoint2D origin(pitch.x * static_cast<double>(k % columns),
                          pitch.y * static_cast<double>(row));
    buildings.push_back({std::move(world), origin});
  }
  return buildings;
}

std::vector<PlacedWorld> changedBuildings(const std::vector<PlacedWorld>& mapped,
                                          const WorldChangeOptions& options, std::uint64_t seed)
{
  std::vector<PlacedWorld> changed;
  changed.reserve(mapped.size());
  for (std::size_t k = 0; k < mapped.size(); ++k)
  {
    changed.push_back({changedWorld(mapped[k].world, options, seedOf(k, seed)), mapped[k].origin});
  }
  return changed;
}

std::vector<PosedScans> simulateMapping(const std::vector<PlacedWorld>& buildings, double spacing,
                                        double clearance, const LaserOptions& laser,
                                        std::uint64_t seed)
{
  std::vector<PosedScans> all;
  for (std::size_t k = 0; k < buildings.size(); ++k)
  {
    const auto& [world, origin] = buildings[k];
    for (PosedScans& scans : simulateMapping(world, spacing, clearance, laser, seedOf(k, seed)))
    {
      scans.map_from_robot = placed(origin, scans.map_from_robot);
      all.push_back(std::move(scans));
    }
  }
  return all;
}

std::vector<PosedScans> simulateQueries(const std::vector<PlacedWorld>& buildings,
                                        std::uint32_t count, double clearance,
                                        const LaserOptions& laser, std::uint64_t seed)
{
  Random random(seed, 15);
  std::vector<std::size_t> drawn(count);
  for (std::size_t& building : drawn) building = random.index(buildings.size());
  // Sorted, so that the free space of a building is worked out once.
  std::sort(drawn.begin(), drawn.end());
  std::vector<PosedScans> queries;
  queries.reserve(count);
  while (queries.size() < count)
  {
    const std::size_t building = drawn[queries.size()];
    const auto& [world, origin] = buildings[building];
    const FreeSpace space(world, clearance);
    const LaserSimulator simulator(world, laser);
    while (queries.size() < count && drawn[queries.size()] == building)
    {
      const TPoint2D place = space.randomPlace(random);
      const TPose2D pose{place.x, place.y, random.uniform(-M_PI, M_PI)};
      queries.push_back({placed(origin, pose), {simulator.scan(pose, random)}});
    }
  }
  return queries;
}
}  // namespace sigloc
