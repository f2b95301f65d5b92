// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// On a terminal a bar shows how far a map is built, and a line how far a log is read. Elsewhere
// there is no bar, and a line for each tenth of the log.
#include <gtest/gtest.h>

#include <sstream>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

TEST(Progress, aBarIsShownOnATerminalWhileAMapIsBuilt)
{
  const TemporaryFolder folder;
  const std::string build =
      commandLine("sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"});
  const CommandResult piped = runShell(folder, build);
  EXPECT_EQ(piped.exit_code, 0) << piped.errors;
  EXPECT_EQ(piped.output.find("building the map"), std::string::npos) << piped.output;
  const CommandResult shown = runShell(folder, "script -qec \"" + build + "\" /dev/null");
  EXPECT_EQ(shown.exit_code, 0) << shown.errors;
  EXPECT_NE(shown.output.find("building the map ["), std::string::npos) << shown.output;
  EXPECT_NE(shown.output.find("] 100 %"), std::string::npos) << shown.output;
}

TEST(Progress, aLineForEachTenthOfALogElsewhere)
{
  const TemporaryFolder folder;
  const CommandResult result =
      run(folder, "sigloc-localize",
          {"--map", kOffice.string(), "--log", (kSources / "rawlogs/office.rawlog").string()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  std::istringstream lines(result.output);
  int shown = 0;
  for (std::string line; std::getline(lines, line);)
    shown += line.find(" %  step ") != std::string::npos ? 1 : 0;
  EXPECT_GE(shown, 9) << result.output;
  EXPECT_LE(shown, 11) << result.output;
}

TEST(Progress, aRunWithoutTruthSaysNothingOfIt)
{
  const TemporaryFolder folder;
  const CommandResult result =
      run(folder, "sigloc-localize", {"--map", kLabMap.string(), "--log", kLabLog.string()});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const char* const absent : {"unknown", "first right", "confidently", "final error"})
    EXPECT_EQ(result.output.find(absent), std::string::npos) << absent << "\n" << result.output;
  EXPECT_NE(result.output.find("\nat the end "), std::string::npos);
}
}  // namespace
}  // namespace sigloc
