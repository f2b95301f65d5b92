// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-map: builds, describes, draws and checks the maps that sigloc localizes in.
#include <CLI/CLI.hpp>

#include "arguments.h"
#include "load_work.h"
#include "number_option.h"
#include "out_option.h"
#include "run_app.h"
#include "sigloc/io/map_files.h"

namespace
{
void declareCheck(CLI::App& command, sigloc::MapArguments& arguments)
{
  constexpr double kMost = 1e6;
  sigloc::CheckOptions& options = arguments.options;
  command.add_option("file", arguments.input, "map to check")->required();
  arguments.reading.declare(command);
  command.add_option("--laser", arguments.laser,
                     "ini with [laser]; default: that of the map's own scans, else 270 degrees");
  command.add_option(sigloc::kOut, arguments.output, "folder for picture, lists and summary");
  command.add_option("--at", arguments.at,
                     "ask at these poses, rows `x y deg`, not over the free space");
  sigloc::addNumber(command, "--places", options.places, "spread over the free space", 1, kMost);
  sigloc::addNumber(command, "--scans", options.scans, "at each place", 1, kMost);
  sigloc::addNumber(command, "--drives", options.drives, "where one scan is not enough", 0, kMost);
  sigloc::addNumber(command, "--seed", options.seed, "of the simulation", 0, 4294967295.0);
}
}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Builds, describes, draws and checks maps for localization by signatures.",
               "sigloc-map");
  app.require_subcommand(1);
  sigloc::MapArguments arguments;

  CLI::App* build_command =
      app.add_subcommand("build", "Builds a .sigmap from one of: " + sigloc::mapFormatNames() +
                                      ". .gz or .zst may follow, but for ROS maps and images.");
  build_command->add_option("-i,--input", arguments.input, "map source")->required();
  build_command->add_option(sigloc::kOutOrOutput, arguments.output, ".sigmap to write")->required();
  build_command->add_option("--config", arguments.config,
                            "ini with [sigloc.map], [sigloc.features] and [sigloc.reading]");
  arguments.reading.declare(*build_command);

  CLI::App* info_command = app.add_subcommand("info", "Describes a map of any kind");
  info_command->add_option("file", arguments.input, "map to read")->required();
  info_command->add_flag("--json", arguments.as_json, "as JSON");
  arguments.reading.declare(*info_command);

  CLI::App* draw_command = app.add_subcommand("draw", "Draws a map of any kind");
  draw_command->add_option("file", arguments.input, "map to read")->required();
  draw_command->add_option(sigloc::kOutOrOutput, arguments.output, "PNG to write")->required();
  arguments.reading.declare(*draw_command);

  CLI::App* check_command =
      app.add_subcommand("check", "Tells where in a map a robot is found, from simulated scans");
  declareCheck(*check_command, arguments);

  const auto work = [&]
  {
    using sigloc::MapCommand;
    if (info_command->parsed()) arguments.command = MapCommand::info;
    if (draw_command->parsed()) arguments.command = MapCommand::draw;
    if (check_command->parsed()) arguments.command = MapCommand::check;
    const bool draws = arguments.command == MapCommand::draw;
    return sigloc::loadWork<decltype(siglocMap)>(
        "siglocMap", draws ? sigloc::Pictures::perhaps : sigloc::Pictures::none)(arguments);
  };
  return sigloc::runApp(app, argc, argv, work);
}
