// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/landmarks.h"

#include <iostream>
#include <stdexcept>

#include "commands.h"
#include "eval/methods/feature_methods.h"
#include "eval/reports/report_files.h"
#include "failure_pictures.h"

namespace sigloc
{
namespace
{
struct LandmarksFlags
{
  CommonOptions common;
  LandmarksOptions options;
  std::string map_part = "first-half";

  /// Refuses options of the other data set.
  void checkUse(const CLI::App& command) const
  {
    common.refusePrior("landmarks");
    common.checkDense({}, false);
    const bool dlr = options.dataset == "dlr";
    const std::vector<std::string> others =
        dlr ? std::vector<std::string>{"--max-travel"}
            : std::vector<std::string>{"--local-map-steps", "--map-part", "--visited-share",
                                       "--visited-distance"};
    for (const std::string& other : others)
    {
      if (command.count(other) > 0)
      {
        throw std::invalid_argument(other + ": has no use for --dataset " + options.dataset);
      }
    }
  }

  int run(const std::string& command_line)
  {
    checkReportFolder(common.out, {});
    common.passTo(options, command_line);
    options.first_half_map = map_part == "first-half";
    options.max_queries = common.max_queries;
    options.seed = common.seed;
    if (!common.quiet)
    {
      options.progress = [](const std::string& line) { std::cerr << line << "\n"; };
    }
    const LandmarksReport report = runLandmarks(options);
    writeLandmarksReport(report, common.out);
    drawFailures({{"", report.failures}}, common.out);
    if (!common.quiet) std::cout << landmarksTable(report);
    return 0;
  }
};
}  // namespace

std::function<int()> setUpLandmarks(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<LandmarksFlags>();
  LandmarksOptions& options = flags->options;
  command.add_option("--dataset", options.dataset, "which data set PATH holds")
      ->check(CLI::IsMember({"dlr", "victoria-park"}))
      ->required();
  command.add_option("PATH", options.path, "folder of the data set")->required();
  command
      .add_option("--local-map-steps", options.local_map_steps,
                  "dlr: steps a local map holds, one row each")
      ->check(numberFrom(1, 1e6))
      ->delimiter(',');
  command.add_option("--map-part", flags->map_part, "dlr: map of the first half, or as given")
      ->check(CLI::IsMember({"first-half", "given"}));
  addNumber(command, "--visited-share", options.visited_share,
            "dlr: a query is a later visit when more than this share of its discs is mapped", 0, 1);
  addNumber(command, "--visited-distance", options.visited_distance,
            "dlr: and when a pose of the first half is so near, m", 1e-3, 1e3);
  addNumber(command, "--max-travel", options.max_travel, "victoria-park: m, longest local map",
            1e-3, 1e6);
  addNumber(command, "--stride", options.query_stride, "every so many steps is a query", 1, 1e6);
  flags->common.declare(command, featureMethodNames());
  return [flags, command_line, &command]
  {
    flags->checkUse(command);
    return flags->run(command_line);
  };
}
}  // namespace sigloc
