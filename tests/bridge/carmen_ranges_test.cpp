// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "sigloc/io/map_files.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

TEST(CarmenLog, refusesRangesThatAreNone)
{
  const TemporaryFolder folder;
  const auto log = [](const std::string& range)
  {
    return "FLASER 3 1 1 1 0 0 0 0 0 0 1 host 1\nFLASER 3 1.5 " + range +
           " 2 0 0 0 0 0 0 1 host 1\n";
  };
  for (const char* const range : {"abc", "1.2.3", "1e999", "nano", "-5"})
  {
    writeText(folder / "l.log", log(range));
    const std::string what = range[0] == '-' ? "negative range" : "bad number";
    const std::string told = "line 2: " + what + " '" + range + "'";
    EXPECT_NE(mapErrorOf(folder / "l.log").find(told), std::string::npos) << range;
  }
  for (const char* const range : {"0", "81.83", "nan", "-nan", "inf"})
  {
    writeText(folder / "l.log", log(range));
    const MapSource source = readMapSource(folder / "l.log");
    const LaserScan& scan = std::get<std::vector<PosedScans>>(source)[1].scans[0];
    EXPECT_EQ(scan.valid, (std::vector<std::uint8_t>{1, 0, 1})) << range;
  }
}
}  // namespace
}  // namespace sigloc
