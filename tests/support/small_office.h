// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "eval/worlds/LaserSimulator.h"
#include "eval/worlds/world_generators.h"
#include "sigloc/map/map_building.h"

namespace sigloc::test
{
/// An office world, its mapping scans on a grid of poses, and poses for queries between them.
struct SmallOffice
{
  World world;
  std::vector<PosedScans> mapping_scans;
  std::vector<PosedScans> queries;  ///< map_from_robot is the truth
};

inline SmallOffice makeSmallOffice(std::uint64_t seed, std::size_t query_count)
{
  SmallOffice office;
  WorldOptions options;
  options.width = 16;
  options.height = 12;
  office.world = makeWorld(WorldKind::office, options, seed);
  LaserOptions laser;
  laser.beams = 181;
  const LaserSimulator simulator(office.world, laser);
  Random random(seed, 1);
  const Bounds& bounds = office.world.bounds;
  // Inside a wall or a piece of furniture all returns are near.
  const auto has_room = [&](const LaserScan& scan)
  {
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      if (scan.valid[i] && scan.ranges[i] < 0.25F) return false;
    }
    return true;
  };
  for (double x = bounds.x_min + 0.5; x < bounds.x_max; x += 0.8)
  {
    for (double y = bounds.y_min + 0.5; y < bounds.y_max; y += 0.8)
    {
      const mrpt::math::TPose2D pose(x, y, random.uniform(-M_PI, M_PI));
      const LaserScan scan = simulator.scan(pose, random);
      if (has_room(scan)) office.mapping_scans.push_back({pose, {scan}});
    }
  }
  while (office.queries.size() < query_count)
  {
    const mrpt::math::TPose2D pose(random.uniform(bounds.x_min, bounds.x_max),
                                   random.uniform(bounds.y_min, bounds.y_max),
                                   random.uniform(-M_PI, M_PI));
    const LaserScan scan = simulator.scan(pose, random);
    if (has_room(scan)) office.queries.push_back({pose, {scan}});
  }
  return office;
}

/// The raster that dense searches use: 0.1 m cells from the mapping scans.
inline OccupancyRaster searchRaster(const SmallOffice& office)
{
  MapBuildingOptions options;
  options.raster_resolution = 0.1;
  return rasterFromScans(office.mapping_scans, options);
}
}  // namespace sigloc::test
