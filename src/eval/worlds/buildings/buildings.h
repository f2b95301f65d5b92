// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "eval/worlds/LaserSimulator.h"
#include "eval/worlds/robot_simulation.h"
#include "eval/worlds/World.h"
#include "eval/worlds/world_generators.h"

namespace sigloc
{
/// How many buildings are laid side by side, and what is asked of them. Rooms stay as large as in
/// one building, so that only the mapped area grows.
struct BuildingOptions
{
  std::uint32_t buildings = 1;
  double building_gap = 2;
  bool identical = false;  ///< all have the seed of the first
  bool mirrored = false;  ///< each is its mirror image
  std::uint32_t queries = 0;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = BuildingOptions;
    visit(OptionField{"buildings", &O::buildings, 1U, 100000U,
                      "[-] laid side by side in one map, each of its own seed"});
    visit(OptionField{"building_gap", &O::building_gap, 0.5, 10000.0, "[m] between two buildings"});
    visit(OptionField{"queries", &O::queries, 0U, 1000000U,
                      "[-] scans at random poses of random buildings, in queries.simplemap"});
  }
};

/// Returns buildings in rows that together are about as wide as they are high. The first is
/// makeWorld() of the seed, with its origin at that of the map. No laser sees from one into
/// another. Throws std::invalid_argument as makeWorld() does, and for several worlds without outer
/// walls.
std::vector<PlacedWorld> makeBuildings(WorldKind kind, const WorldOptions& layout,
                                       const BuildingOptions& options, std::uint64_t seed);

/// Returns the buildings with changes of their own, each as changedWorld() makes them.
std::vector<PlacedWorld> changedBuildings(const std::vector<PlacedWorld>& mapped,
                                          const WorldChangeOptions& options, std::uint64_t seed);

/// Returns the mapping scans of all buildings, one after the other, in the frame of the map.
std::vector<PosedScans> simulateMapping(const std::vector<PlacedWorld>& buildings, double spacing,
                                        double clearance, const LaserOptions& laser,
                                        std::uint64_t seed);

/// Returns `count` scans in the frame of the map, each from a random free pose of a building drawn
/// at random. Their noise is not that of the mapping scans of any seed.
std::vector<PosedScans> simulateQueries(const std::vector<PlacedWorld>& buildings,
                                        std::uint32_t count, double clearance,
                                        const LaserOptions& laser, std::uint64_t seed);
}  // namespace sigloc
