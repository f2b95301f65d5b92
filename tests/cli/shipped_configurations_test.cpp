// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "command_line.h"
#include "sigloc/bridge/LocalizationSetup.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
const std::filesystem::path kShare = SIGLOC_SHARE_FOLDER;

TEST(ShippedConfigurations, defaultsEqualTheCode)
{
  std::string shipped;
  std::istringstream lines(readBytes(kShare / "sigloc-defaults.ini"));
  for (std::string line; std::getline(lines, line);)
  {
    if (line.rfind("#", 0) != 0) shipped += line + "\n";
  }
  // Made with: sigloc-localize --print-defaults
  EXPECT_EQ(shipped, defaultOptionSections());
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
