// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "command_line.h"
#include "sigloc/localize/LocalizationSetup.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
const std::filesystem::path kShare = SIGLOC_SHARE_FOLDER;

TEST(ShippedConfigurations, defaultsEqualTheCode)
{
  const TemporaryFolder folder;
  const CommandResult printed = run(folder, "sigloc-localize", {"--print-defaults"});
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_EQ(readBytes(kShare / "sigloc-defaults.ini"), printed.output)
      << "made with: sigloc-localize --print-defaults >share/sigloc/sigloc-defaults.ini";
}

TEST(ShippedConfigurations, defaultsTellOfTheTracker)
{
  const TemporaryFolder folder;
  const std::string defaults = run(folder, "sigloc-localize", {"--print-defaults"}).output;
  EXPECT_NE(defaults.find("[LocalizationExperiment]:\n# tracker = gaussians"), std::string::npos);
  writeText(folder / "run.ini", defaults +
                                    "[LocalizationExperiment]\ntracker = particles\nmap_file = " +
                                    kLabMap.string() + "\nrawlog_file = " + kLabLog.string());
  const LocalizationSetup setup = readLocalizationSetup(folder / "run.ini");
  EXPECT_TRUE(setup.use_particles);
  EXPECT_TRUE(setup.warnings.empty());
}

TEST(ShippedConfigurations, allAreRead)
{
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kShare))
  {
    if (entry.path().extension() != ".ini") continue;
    ++count;
    EXPECT_NO_THROW(readOptionSections(entry.path())) << entry.path();
    if (entry.path().filename().string().rfind("demo-", 0) == 0)
    {
      EXPECT_NO_THROW(readLocalizationSetup(entry.path())) << entry.path();
    }
  }
  EXPECT_GE(count, 3U);
}
}  // namespace
}  // namespace sigloc
