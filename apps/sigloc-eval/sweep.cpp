// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/sweep.h"

#include <algorithm>
#include <iostream>

#include "commands.h"
#include "eval/protocols/swept_quantities.h"
#include "eval/reports/report_files.h"
#include "failure_pictures.h"

namespace sigloc
{
namespace
{
struct SweepFlags
{
  CommonOptions common;
  SweepOptions options;
  std::vector<std::string> worlds;

  int run(const std::string& command_line)
  {
    common.refusePrior("sweep");
    checkReportFolder(common.out, {});
    common.passTo(options, command_line);
    for (const std::string& world : worlds) options.worlds.push_back(worldKindFrom(world));
    common.checkDense(options.methods, true);
    options.use_dense_field = !common.no_dense;
    if (common.max_queries > 0)
    {
      options.queries_per_world = std::min(options.queries_per_world, common.max_queries);
    }
    options.seed = common.seed;
    options.threads = common.threads;
    options.progress = progressBar(common.quiet);
    const SweepReport report = runSweep(options);
    writeSweepReport(report, common.out);
    FailuresByFolder failures;
    for (const SweepRow& row : report.rows)
    {
      failures.emplace_back(options.over + "-" + sweptValueText(row.value), row.failures);
    }
    drawFailures(failures, common.out);
    if (!common.quiet) std::cout << sweepTable(report);
    return 0;
  }
};

std::vector<std::string> namesOfQuantities()
{
  std::vector<std::string> names;
  for (const SweptQuantity& quantity : sweptQuantities()) names.push_back(quantity.name);
  return names;
}
}  // namespace

std::function<int()> setUpSweep(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<SweepFlags>();
  SweepOptions& options = flags->options;
  command.add_option("--over", options.over, "what is varied; all else stays")
      ->check(CLI::IsMember(namesOfQuantities()))
      ->required();
  command.add_option("--values", options.values, "values of it (default: its own)")->delimiter(',');
  command.add_option("--world", flags->worlds, "kinds of world (default: where it matters)")
      ->delimiter(',')
      ->check(CLI::IsMember({"office", "corridor", "hall", "park"}));
  addNumber(command, "--worlds-per-kind", options.worlds_per_kind, "worlds of each kind", 1, 1000);
  addNumber(command, "--queries", options.queries_per_world, "robots asked in each world", 1, 1e6);
  flags->common.declare(command, relocationMethodNames());
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
