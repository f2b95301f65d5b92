// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "commands.h"
#include "eval/data/reference_path.h"
#include "eval/reports/report_files.h"
#include "out_option.h"
#include "reading_arguments.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
struct ReferenceFlags
{
  std::filesystem::path map;
  std::filesystem::path rawlog;
  std::vector<double> last;
  ReadingArguments reading;
  std::filesystem::path out;

  int run() const
  {
    checkWritableFolder(out.has_parent_path() ? out.parent_path() : ".");
    refuseToReplaceInputs(out, inputFiles(map, {rawlog}));
    checkReferenceFile(out);
    const ReferencePath reference = referencePath(map, rawlog, poseOfFlag(last), reading.in({map}));
    writeReferencePath(reference, out);
    std::cout << reference.poses.size() << " poses; the worst scan has "
              << static_cast<int>(100 * reference.worst_goodness) << " % of its points paired\n";
    return 0;
  }
};
}  // namespace

std::function<int()> setUpReference(CLI::App& command, const std::string& /*command_line*/)
{
  const auto flags = std::make_shared<ReferenceFlags>();
  command.add_option("--map", flags->map, "a map of scans, as sigloc-map build takes")->required();
  command.add_option("--rawlog", flags->rawlog, "with odometry")->required();
  addPoseOption(command, "--last", flags->last, "the known pose at the end of the log")->required();
  flags->reading.declare(command);
  command.add_option(kOut, flags->out, "file for the rows `time x y phi`")->required();
  return [flags] { return flags->run(); };
}
}  // namespace sigloc
