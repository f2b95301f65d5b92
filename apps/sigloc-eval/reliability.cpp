// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/reliability.h"

#include <iostream>

#include "commands.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
struct ReliabilityFlags
{
  CommonOptions common;
  ReliabilityOptions options;

  int run(const std::string& command_line)
  {
    checkReportFolder(common.out, {});
    options.seed = common.seed;
    options.threads = common.threads;
    options.command = command_line;
    options.progress = progressBar(common.quiet);
    const ReliabilityReport report = runReliability(options);
    writeReliabilityReport(report, common.out);
    if (!common.quiet) std::cout << reliabilityTable(report);
    return 0;
  }
};
}  // namespace

std::function<int()> setUpReliability(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<ReliabilityFlags>();
  ReliabilityOptions& options = flags->options;
  addNumber(command, "--worlds", options.worlds, "simulated buildings", 1, 1e6);
  addNumber(command, "--poses", options.poses, "scans a building", 1, 1e6);
  command.add_option("--clutter", options.clutter, "shares of beams that end too early")
      ->delimiter(',')
      ->check(numberFrom(0, 1));
  flags->common.declareRunning(command);
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
