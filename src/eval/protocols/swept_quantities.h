// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/worlds/LaserSimulator.h"
#include "eval/worlds/World.h"
#include "eval/worlds/world_generators.h"

namespace sigloc
{
/// The conditions of a simulated query. A sweep varies one of them.
struct SweepConditions
{
  WorldOptions world;  ///< corridors: copies differ by 0.1 m, else no method could distinguish them
  WorldChangeOptions change;  ///< between mapping and query
  double unmapped_items = 0;  ///< [1/(100 m^2)] pieces that appear between mapping and query
  double map_sigma = 0;  ///< [m] of the position of every mapping scan, a degree an 0.05 m with it
  LaserOptions laser;  ///< of the query; mapping has its own
  /// [m] height of the door thresholds under the robots' front or rear wheels. None: robots are
  /// anywhere.
  std::optional<double> threshold;

  SweepConditions() { world.jitter = 0.1; }
};

/// Values that a swept quantity may have, ends included.
struct SweptRange
{
  double least = 0;
  double most = 0;
  bool whole = false;  ///< only whole numbers
};

/// One axis of the sweeps.
struct SweptQuantity
{
  std::string name;
  std::string label;  ///< with its unit
  std::vector<double> values;  ///< in a run that gives none
  SweptRange range;
  std::vector<WorldKind> worlds;  ///< kinds that depend on it
  bool changes_map;  ///< false: one map serves all values
  std::function<void(double value, SweepConditions& conditions)> set;
};

/// All of them: noise, clutter, fov, range, map-noise, furniture, unmapped, doors,
/// thresholds, repeats.
const std::vector<SweptQuantity>& sweptQuantities();

/// Throws std::invalid_argument for a value that is out of range or given twice.
void checkSweptValues(const SweptQuantity& quantity, const std::vector<double>& values);

/// Throws std::invalid_argument naming the known quantities when there is none of that name.
const SweptQuantity& sweptQuantity(const std::string& name);
}  // namespace sigloc
