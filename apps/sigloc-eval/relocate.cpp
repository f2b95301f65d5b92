// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/relocate.h"

#include <iostream>
#include <limits>

#include "commands.h"
#include "eval/reports/report_files.h"
#include "failure_pictures.h"
#include "reading_arguments.h"

namespace sigloc
{
namespace
{
struct RelocateFlags
{
  CommonOptions common;
  EvaluationSources sources;
  std::vector<double> map_from_queries;
  ReadingArguments reading;
  MapScanOptions scans_in_map;
  bool simulated = false;

  int run(const std::string& command_line) const
  {
    checkReportFolder(common.out, inputFiles(sources.map, {sources.queries, sources.rawlog,
                                                           sources.ground_truth}));
    RelocateOptions options;
    options.sources = sources;
    options.sources.reading = reading.in({sources.map});
    options.sources.map_from_queries = poseOfFlag(map_from_queries);
    options.sources.max_queries = common.max_queries;
    options.scans_in_map = scans_in_map;
    options.scans_in_map.seed = common.seed;
    common.passTo(options, command_line);
    common.checkDense(options.methods, true);
    common.passToMethods(options);
    if (simulated || scans_in_map.count > 0) options.gates = simulationGates();
    const RelocateReport report = runRelocate(options);
    writeRelocateReport(report, common.out);
    FailuresByFolder failures;
    for (const auto& method : report.methods) failures.emplace_back("", method.failures);
    drawFailures(failures, common.out);
    if (!common.quiet) std::cout << relocateTable(report);
    return exitCode(report.complete, sources.rawlog);
  }
};
}  // namespace

std::function<int()> setUpRelocate(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<RelocateFlags>();
  EvaluationSources& sources = flags->sources;
  command.add_option("--map", sources.map, "whatever sigloc-map build takes")->required();
  flags->reading.declare(command);
  command.add_option("--queries", sources.queries, "simplemap: every key frame is a query");
  command.add_option("--rawlog", sources.rawlog, "rawlog: every step with truth is a query");
  command.add_option("--ground-truth", sources.ground_truth,
                     "truth of the rawlog: rows `time x y phi`, or 3 or 7 columns");
  command
      .add_option("--interleave", sources.interleave,
                  "every k-th scan of the map is a query, the rest map")
      ->check(numberFrom(2, std::numeric_limits<std::uint32_t>::max()));
  addPoseOption(command, "--map-from-queries", flags->map_from_queries,
                "frame of the queries' truth in the map");
  command.add_flag("--foreign", sources.foreign, "the queries are of another place");
  CLI::Option* const in_map =
      command
          .add_option("--scans-in-map", flags->scans_in_map.count,
                      "simulate so many queries in the map itself, at free places")
          ->check(numberFrom(1, 1e6));
  addNumber(command, "--view", flags->scans_in_map.view_deg, "[deg] of their laser", 10, 360)
      ->needs(in_map);
  addNumber(command, "--range-sigma", flags->scans_in_map.range_sigma, "[m] of their ranges", 0, 1)
      ->needs(in_map);
  addNumber(command, "--map-sigma", flags->scans_in_map.map_sigma,
            "[m] of the map, common to 0.2 rad of a scan", 0, 1)
      ->needs(in_map);
  command.add_flag("--simulated", flags->simulated,
                   "the truth is exact: every confident answer that is not right is wrong");
  flags->common.declare(command, relocationMethodNames());
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
