// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eval/wakeup/wakeup.h"
#include "eval/worlds/world_generators.h"

namespace sigloc
{
/// Wake-ups in simulated worlds: many drives in each of many worlds, whose sizes, contents and
/// lasers differ. Maps are made from a mapping run; no drive's scan is in one.
struct SimulatedTrackOptions
{
  std::uint32_t drives = 100;
  std::uint32_t drives_per_world = 25;
  std::vector<WorldKind> kinds;  ///< in turn; none: office, corridor, hall
  double travel = 15;  ///< [m] driven after waking up, and again after a kidnapping
  double map_spacing = 1.2;  ///< [m] between the mapping scans
  /// [m] error that all of a map has in common, drawn anew for each and stated in it.
  double map_sigma = 0.1;
  double clutter_share = 0;  ///< of the drive's beams end on something nearer
  double moved_share = 0;  ///< of the furniture moved since the map was made
  std::uint32_t extra_items = 0;  ///< unmapped pieces of furniture
  double mapped_share = 1;  ///< of the world's length that the mapping run covers
  bool foreign = false;  ///< the map is of another world: every claim is wrong
  bool odometry = true;
  bool kidnap = false;  ///< then carry the robot to another pose in the world
  std::vector<std::string> methods = {"signature"};
  RelocationMethodOptions method;
  std::uint32_t threads = 1;
  std::size_t keep_failures = 0;  ///< how many failed runs of each method the report keeps
  std::string command;
  ShowProgress progress;
};

/// Runs the drives; results depend on the options and the seed only. Claims are judged by the gates
/// of a right answer. Throws std::invalid_argument for options that make no sense.
WakeupReport runSimulatedTrack(const SimulatedTrackOptions& options);
}  // namespace sigloc
