// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// On a terminal a bar shows how far a map is built; elsewhere nothing does.
#include <gtest/gtest.h>

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
}  // namespace
}  // namespace sigloc
