// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/merge.h"

#include <iostream>

#include "commands.h"
#include "eval/reports/report_files.h"
#include "out_option.h"

namespace sigloc
{
namespace
{
struct MergeFlags
{
  std::vector<std::filesystem::path> runs;
  std::string out;
  bool quiet = false;

  int run(const std::string& command_line) const
  {
    checkReportFolder(out, filesOfRuns(runs));
    const MergedRuns merged = mergeRuns(runs, command_line);
    writeRunReport(merged.report, out);
    if (!quiet) std::cout << merged.report.text;
    return merged.complete ? 0 : 2;
  }
};
}  // namespace

std::function<int()> setUpMerge(CLI::App& command, const std::string& command_line)
{
  const auto flags = std::make_shared<MergeFlags>();
  command.add_option("DIR", flags->runs, "folders that runs of relocate, sweep or track wrote")
      ->required();
  command.add_option(kOut, flags->out, "folder for the pooled results")->required();
  command.add_flag("--quiet", flags->quiet, "no table");
  return [flags, command_line] { return flags->run(command_line); };
}
}  // namespace sigloc
