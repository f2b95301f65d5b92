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
#include "picture_file.h"
#include "progress_line.h"
#include "sigloc/io/file_output.h"
#include "warn.h"

namespace sigloc
{
namespace
{
MapCheck checkOf(const MapArguments& arguments, const std::shared_ptr<const FeatureMap>& map)
{
  CheckOptions options = arguments.options;
  if (!arguments.at.empty()) options.poses = readPoses(arguments.at, boundsOf(*map));
  SimulatedLaserOptions laser =
      laserOfMap(readMapSource(arguments.input, arguments.reading.in({arguments.input})));
  if (!arguments.laser.empty()) laser = readLaser(arguments.laser, laser);
  ProgressLine progress;
  try
  {
    return checkMap(map, laser, options,
                    [&](double share) { progress.showBar("checking the map", share); });
  }
  catch (const std::invalid_argument& error)
  {
    throw std::runtime_error(arguments.input.string() + ": " + error.what());
  }
}
}  // namespace

void runCheck(const MapArguments& arguments, const char* program)
{
  std::vector<std::filesystem::path> inputs = filesOfMapSource(arguments.input);
  inputs.push_back(arguments.laser);
  inputs.push_back(arguments.at);
  if (!arguments.output.empty())
  {
    checkCheckFolder(arguments.output, inputs);
    checkWritableFolder(arguments.output);
  }
  ProgressLine progress;
  const auto map = std::make_shared<const FeatureMap>(buildMapFromFile(
      arguments.input, {}, {}, [&](double share) { progress.showBar("building the map", share); },
      arguments.reading.in({arguments.input})));
  progress.finish();
  warn(program, arguments.input, warningOfMapSource(arguments.input));
  warn(program, arguments.input, warningOfMap(*map));
  const MapCheck check = checkOf(arguments, map);
  std::cout << checkTable(check);
  if (arguments.output.empty()) return;
  const bool is_new = std::filesystem::create_directories(arguments.output);
  const std::string name = arguments.input.filename().string();
  const std::string title =
      fmt::format("{}: first pose right {:.3f}, localized {:.3f} of simulated scans", name,
                  check.recall(), check.localizedShare());
  try
  {
    savePicture(checkPicture(check, *map->field(), title), arguments.output / CheckFiles::kPicture);
    writeCheckFiles(check, name, arguments.output);
    syncFolder(arguments.output);
  }
  catch (const std::exception&)
  {
    // Half of the files are of no use, and an empty folder is of none.
    std::error_code ignored;
    if (is_new) std::filesystem::remove_all(arguments.output, ignored);
    throw;
  }
  std::cout << fmt::format("{:<24}{}\n", "written to", arguments.output.string());
}
}  // namespace sigloc
