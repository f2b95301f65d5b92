// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "eval/worlds/FreeSpace.h"
#include "eval/worlds/robot_simulation.h"
#include "io/scan_conversion.h"

namespace sigloc
{
/// The two kinds of rawlog that MRPT reads.
enum class RawlogKind : std::uint8_t
{
  action_frame = 0,  ///< pairs of action collection and sensory frame
  observations = 1,  ///< observations only, odometry among them, as rawlog-grabber writes
};

// All writers below make ordinary files of MRPT's own classes. Equal arguments give equal bytes.
// Each throws as writeFile() does and leaves no half-written file.

/// Writes a `.simplemap`: one key frame an entry, with a pose known to a millimetre.
void writeSimpleMap(const std::vector<PosedScans>& scans, const std::filesystem::path& path);

/// Writes a `.gridmap.gz`: cells that a surface touches are occupied, those the robot's space
/// reaches free, the others unknown. `resolution` in metres.
void writeGridMap(const World& world, double resolution, const std::filesystem::path& path);

/// The same for several worlds that do not overlap.
void writeGridMap(const std::vector<PlacedWorld>& worlds, double resolution,
                  const std::filesystem::path& path);

/// Writes a `.rawlog`. Steps with a scan get a CObservation2DRangeScan, steps with landmarks a
/// CObservationBearingRange without identities.
void writeRawlog(const std::vector<DriveStep>& steps, const OdometryOptions& odometry,
                 RawlogKind kind, const std::filesystem::path& path);

/// Writes the true path: rows `time x y phi`.
void writeTruth(const std::vector<DriveStep>& steps, const std::filesystem::path& path);

/// Writes a landmark file: rows `x y radius sigma`.
void writeLandmarks(const std::vector<Feature>& landmarks, const std::filesystem::path& path);

/// Throws std::runtime_error ("folder: reason") where a simulation could replace a file that no
/// simulation wrote. That is a folder that holds a file of such a name, but not the note of an
/// earlier simulation.
void checkSimulationFolder(const std::filesystem::path& folder);

/// Writes the note on a simulation's files, `README.md` in their folder. `command` makes them
/// again, and `files` is a Markdown list that describes them.
void writeSimulationNote(const std::string& command, const std::string& files,
                         const std::filesystem::path& folder);
}  // namespace sigloc
