// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "io/carmen_log.h"
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

TEST(CarmenLog, refusesAnglesThatAreNone)
{
  const TemporaryFolder folder;
  const auto reason = [&](const std::string& angles, const std::string& heading)
  {
    writeText(folder / "l.log", "ROBOTLASER1 0 " + angles + " 80 0.01 0 3 1.5 1.5 1.5 0 0 0 " +
                                    heading + " 0 0 0 0 0 0 0.3 0.3 1 host 1\n");
    return mapErrorOf(folder / "l.log");
  };
  for (const char* const angles : {"1e300 3.1 1.5", "1e16 3.1 1.5", "-1.5 3.1 1e300", "-1.5 9 3.3"})
    EXPECT_NE(reason(angles, "0").find("line 1: angles that no laser has"), std::string::npos);
  for (const char* const heading : {"1e300", "-1e16"})
  {
    EXPECT_NE(reason("-1.5 3.1 1.5", heading).find("line 1: heading that no robot has"),
              std::string::npos);
  }
}

TEST(CarmenLog, takesNoCorrectionOfTheLasersPoseForItsMount)
{
  const TemporaryFolder folder;
  const auto message = [](const std::string& laser, const std::string& robot)
  {
    return "ROBOTLASER1 0 -1.5 3.1 1.5 80 0.01 0 3 1.5 1.5 1.5 0 " + laser + " " + robot +
           " 0 0 0 0.3 0.3 1 host 1\n";
  };
  const auto mounts = [&](const std::string& log)
  {
    writeText(folder / "l.log", log);
    const detail::CarmenLog read = detail::readCarmenLog(folder / "l.log");
    std::vector<double> x;
    for (const detail::CarmenScan& seen : read.scans) x.push_back(seen.scan.robot_from_sensor.x);
    return x;
  };
  const std::string first = message("0.25 0 0", "0 0 0");
  EXPECT_EQ(mounts(first + message("5.25 0 0", "5 0 0")), (std::vector<double>{0.25, 0.25}));
  // Messages that tell no mount change none: of another kind, or without the robot's pose.
  const std::string flaser = "FLASER 3 1.5 1.5 1.5 5 0 0 5 0 0 1 host 1\n";
  const std::string short_one = "ROBOTLASER1 0 -1.5 3.1 1.5 80 0.01 0 3 1.5 1.5 1.5 0 5.25 0 0\n";
  EXPECT_EQ(mounts(flaser + first + short_one), (std::vector<double>{0, 0.25, 0}));
  // The laser's pose is corrected, the robot's drifts.
  EXPECT_EQ(mounts(first + message("5.75 0 0", "5 0 0")), (std::vector<double>{0, 0}));
  EXPECT_EQ(mounts(first + message("5 0 0.2", "5 0 0")), (std::vector<double>{0, 0}));
}

TEST(CarmenLog, hasAsManyReadingsAsItAnnounces)
{
  const TemporaryFolder folder;
  const std::string three = "FLASER 3 1.5 1.5 1.5 0 0 0 0 0 0 1 host 1\n";
  const std::string laser =
      "ROBOTLASER1 0 -1.5 3.1 1.5 80 0.01 0 3 1.5 1.5 1.5 0 "
      "0 0 0 0 0 0 0 0 0.3 0.3 0 1 host 1\n";
  std::string commas = three;
  std::replace(commas.begin(), commas.end(), '.', ',');
  std::string one_line = three + three;
  std::replace(one_line.begin(), one_line.end(), '\n', '\r');
  for (const std::string& sound : {three, laser})
  {
    writeText(folder / "l.log", sound);
    EXPECT_EQ(std::get<std::vector<PosedScans>>(readMapSource(folder / "l.log")).size(), 1U);
  }
  std::string few = three;
  few.replace(few.find("3 1.5"), 1, "2");
  const std::string more = laser.substr(0, laser.size() - 1) + " 7\n";
  for (const std::string& log : {few, more, commas, one_line})
  {
    writeText(folder / "l.log", log);
    EXPECT_NE(mapErrorOf(folder / "l.log").find(" readings are announced, and "), std::string::npos)
        << log;
  }
}

TEST(CarmenLog, makesNoMapWhereItIsCutOffOrBad)
{
  const TemporaryFolder folder;
  const std::string line = "FLASER 3 1.5 1.5 1.5 0 0 0 0 0 0 1 host 1\n";
  const std::string part = line.substr(0, 15);
  for (const auto& [log, why] :
       {std::pair(line + part, ": its last message is cut off"), std::pair(part, "line 1: cut off"),
        std::pair(line + part + "\n", "line 2: cut off"),
        std::pair(std::string("ODOM 1 2 3 0 0 0 1 host 1\n"), "no FLASER"),
        std::pair(std::string("FLASER -3 1 2\n"), "line 1: bad count")})
  {
    writeText(folder / "l.log", log);
    EXPECT_NE(mapErrorOf(folder / "l.log").find(why), std::string::npos) << log;
  }
}

// A range that is too frequent is taken for the laser's limit, so nothing is left of a log of one.
TEST(CarmenLog, withoutAReturnIsRefusedWithTheLimitThatItsLaserIsTakenToHave)
{
  const TemporaryFolder folder;
  for (const auto& [range, limit] : {std::pair("3.5", "3.5 m"), std::pair("nan", "80 m")})
  {
    std::string line = "FLASER 181";
    for (int i = 0; i < 181; ++i) line += std::string(" ") + range;
    writeText(folder / "l.log", line + " 0 0 0\n" + line + " 1 0 0\n");
    const std::string message =
        messageOf<std::runtime_error>([&] { buildMapFromFile(folder / "l.log", {}, {}); });
    EXPECT_EQ(message, (folder / "l.log").string() +
                           ": no scan has a valid return: every range is 0, no number, marked as "
                           "none, or at the laser's limit, which is taken to be " +
                           limit);
  }
}
}  // namespace
}  // namespace sigloc
