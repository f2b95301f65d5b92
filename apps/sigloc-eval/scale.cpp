// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/scale.h"

#include <algorithm>
#include <iostream>

#include "commands.h"
#include "eval/methods/feature_methods.h"
#include "eval/reports/report_files.h"
#include "failure_pictures.h"

namespace sigloc
{
namespace
{
constexpr double kMostFeatures = 1e7;
constexpr double kMostPoses = 1e6;
constexpr double kMostBuildings = 1e5;

struct ScaleFlags
{
  CommonOptions common;
  ScaleOptions options;

  int run(const std::string& command_line)
  {
    common.refusePrior("scale");
    common.checkDense({}, false);
    checkReportFolder(common.out, {});
    if (common.max_queries > 0)
    {
      options.poses = std::min<std::size_t>(options.poses, common.max_queries);
      options.slow_poses = std::min<std::size_t>(options.slow_poses, common.max_queries);
    }
    if (!options.buildings.empty()) options.methods = {"signature"};
    common.passTo(options, command_line);
    options.seed = common.seed;
    options.generator.seed = common.seed;
    if (!common.quiet)
    {
      options.progress = [](const std::string& line) { std::cerr << line << "\n"; };
    }
    const ScaleReport report = runScale(options);
    writeScaleReport(report, common.out);
    FailuresByFolder failures;
    for (const ScaleRow& row : report.rows)
    {
      std::string folder = "features-" + std::to_string(row.map_features);
      if (row.wanted > 0) folder += "-observed-" + std::to_string(row.wanted);
      failures.emplace_back(folder, row.failures);
    }
    drawFailures(failures, common.out);
    if (!common.quiet) std::cout << scaleTable(report);
    return 0;
  }
};
}  // namespace

std::function<int()> setUpScale(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<ScaleFlags>();
  ScaleOptions& options = flags->options;
  command
      .add_option("--map-features", options.map_features,
                  "map sizes (default: 1000,4000,16000, on the DLR log 50,100,200 and all)")
      ->check(numberFrom(1, kMostFeatures))
      ->delimiter(',');
  command
      .add_option("--observed", options.observed,
                  "counts that the observed features are thinned to, in the first map")
      ->check(numberFrom(1, kMostFeatures))
      ->delimiter(',');
  CLI::Option* const buildings =
      command
          .add_option("--buildings", options.buildings,
                      "growth with the area: one scan among so many offices of 48 m x 15 m")
          ->check(numberFrom(1, kMostBuildings))
          ->delimiter(',');
  addNumber(command, "--density", options.world.density, "features per m^2", 1e-3, 100);
  addNumber(command, "--range", options.world.range, "m, within which features are seen", 0.1,
            1000);
  addNumber(command, "--noise", options.world.observation_sigma, "m, of the observations", 0, 10);
  addNumber(command, "--spurious", options.world.spurious, "share of the observed features", 0,
            0.95);
  addNumber(command, "--poses", options.poses, "poses a row", 1, kMostPoses);
  addNumber(command, "--slow-poses", options.slow_poses, "poses a row of methods linear in the map",
            1, kMostPoses);
  addNumber(command, "--slow-limit", options.slow_limit, "largest map for those", 0, kMostFeatures);
  CLI::Option* const dlr = command.add_option(
      "--dlr", options.dlr, "folder of the DLR log: growth on it, not in simulated worlds");
  command.add_option("--local-map-steps", options.local_map_steps, "on the log: of a local map")
      ->check(numberFrom(1, kMostPoses))
      ->needs(dlr);
  for (const char* of_worlds :
       {"--density", "--range", "--noise", "--spurious", "--slow-poses", "--slow-limit"})
  {
    dlr->excludes(command.get_option(of_worlds));
    buildings->excludes(command.get_option(of_worlds));
  }
  for (const char* of_features : {"--map-features", "--observed", "--dlr"})
  {
    buildings->excludes(command.get_option(of_features));
  }
  flags->common.declare(command, featureMethodNames());
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
