// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "check_command.h"

#include <fmt/core.h>

#include <iostream>
#include <memory>
#include <stdexcept>

#include "check_files.h"
#include "check_picture.h"
#include "laser_of_map.h"
#include "number_option.h"
#include "picture_file.h"
#include "progress_line.h"
#include "run_app.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
MapCheck checkOf(const CheckArguments& arguments, const std::shared_ptr<const FeatureMap>& map)
{
  CheckOptions options = arguments.options;
  if (!arguments.at.empty()) options.poses = readPoses(arguments.at);
  SimulatedLaserOptions laser = laserOfMap(readMapSource(arguments.map, arguments.reading.in()));
  if (!arguments.laser.empty()) laser = readLaser(arguments.laser, laser);
  ProgressLine progress;
  try
  {
    return checkMap(map, laser, options,
                    [&](double share) { progress.showBar("checking the map", share); });
  }
  catch (const std::invalid_argument& error)
  {
    throw std::runtime_error(arguments.map.string() + ": " + error.what());
  }
}
}  // namespace

void CheckArguments::declare(CLI::App& command)
{
  constexpr double kMost = 1e6;
  command.add_option("file", map, "map to check")->required();
  reading.declare(command);
  command.add_option("--laser", laser,
                     "ini with [laser]; default: that of the map's own scans, else 270 degrees");
  command.add_option("--out", out, "folder for picture, lists and summary");
  command.add_option("--at", at, "ask at these poses, rows `x y deg`, not over the free space");
  addNumber(command, "--places", options.places, "spread over the free space", 1, kMost);
  addNumber(command, "--scans", options.scans, "at each place", 1, kMost);
  addNumber(command, "--drives", options.drives, "where one scan is not enough", 0, kMost);
  addNumber(command, "--seed", options.seed, "of the simulation", 0, 4294967295.0);
}

void runCheck(const CheckArguments& arguments, const char* program)
{
  std::vector<std::filesystem::path> inputs = filesOfMapSource(arguments.map);
  inputs.push_back(arguments.laser);
  inputs.push_back(arguments.at);
  if (!arguments.out.empty()) checkCheckFolder(arguments.out, inputs);
  ProgressLine progress;
  const auto map = std::make_shared<const FeatureMap>(buildMapFromFile(
      arguments.map, {}, {}, [&](double share) { progress.showBar("building the map", share); },
      arguments.reading.in()));
  progress.finish();
  warn(program, arguments.map, warningOfMapSource(arguments.map));
  warn(program, arguments.map, warningOfMap(*map));
  const MapCheck check = checkOf(arguments, map);
  std::cout << checkTable(check);
  if (arguments.out.empty()) return;
  std::filesystem::create_directories(arguments.out);
  const std::string name = arguments.map.filename().string();
  const std::string title =
      fmt::format("{}: first pose right {:.3f}, localized {:.3f} of simulated scans", name,
                  check.recall(), check.localizedShare());
  savePicture(checkPicture(check, *map->field(), title), arguments.out / CheckFiles::kPicture);
  writeCheckFiles(check, name, arguments.out);
  syncFolder(arguments.out);
  std::cout << fmt::format("{:<24}{}\n", "written to", arguments.out.string());
}
}  // namespace sigloc
