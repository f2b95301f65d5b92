// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/track.h"

#include <algorithm>
#include <iostream>

#include "commands.h"

namespace sigloc
{
namespace
{
struct TrackFlags
{
  CommonOptions common;
  TrackOptions options;
  std::vector<double> map_from_truth;

  int run(const std::string& command_line)
  {
    options.map_from_truth = poseOfFlag(map_from_truth);
    if (!common.methods.empty()) options.methods = common.methods;
    options.method.seed = common.seed;
    options.method.region = common.poseRegion();
    options.method.use_dense_field = !common.no_dense;
    if (common.max_queries > 0) options.starts = std::min(options.starts, common.max_queries);
    options.threads = common.threads;
    options.command = command_line;
    options.progress = progressBar(common.quiet);
    const TrackReport report = runTrack(options);
    writeTrackReport(report, common.out);
    if (!common.quiet) std::cout << trackTable(report);
    return report.complete ? 0 : 2;
  }
};
}  // namespace

std::function<int()> setUpTrack(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<TrackFlags>();
  TrackOptions& options = flags->options;
  command.add_option("--map", options.map, "whatever sigloc-map build takes")->required();
  command.add_option("--rawlog", options.rawlog, "the drive")->required();
  command
      .add_option("--ground-truth", options.ground_truth,
                  "truth of the drive: rows `time x y phi`, 3 or 7 columns, or a simplemap")
      ->required();
  command.add_option("--starts", options.starts, "places to wake up at")->capture_default_str();
  command.add_option("--travel", options.travel, "[m] driven after each")->capture_default_str();
  command.add_option("--start-from", options.start_from,
                     "simplemap: wake up only where its key frames were taken");
  command.add_flag("--kidnap", options.kidnap, "half-way, carry the robot to another start");
  command
      .add_option("--map-from-truth", flags->map_from_truth,
                  "x,y,deg: frame of the truth in the map")
      ->delimiter(',')
      ->expected(3);
  flags->common.declare(command);
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
