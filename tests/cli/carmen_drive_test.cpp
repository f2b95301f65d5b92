// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A CARMEN log as a drive: the answer is that of the same drive as a rawlog.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command_line.h"
#include "runs.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using mrpt::math::TPose2D;
using nlohmann::json;

const std::filesystem::path kDrive = kSources / "rawlogs/office.rawlog";

/// A step as a ROBOTLASER1 message; its robot is at `odometry`, its laser turned by `turn` [rad].
std::string robotLaser(const RawlogStep& step, const TPose2D& odometry, double turn)
{
  const LaserScan& scan = step.scans.front();
  std::ostringstream line;
  line << std::setprecision(10) << "ROBOTLASER1 0 " << scan.first_angle << " 0 " << scan.angle_step
       << " " << scan.max_range << " " << scan.range_sigma << " 0 " << scan.ranges.size();
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    line << " " << (scan.valid[i] != 0 ? scan.ranges[i] : 0.0F);
  TPose2D laser = odometry + scan.robot_from_sensor;
  laser.phi += turn;
  line << " 0";
  for (const TPose2D& pose : {laser, odometry})
    line << " " << pose.x << " " << pose.y << " " << pose.phi;
  line << " 0 0 0 0 0 " << step.time << " host " << step.time << "\n";
  return line.str();
}

/// The office's drive as a CARMEN log, with a mount that tells a wrong `turn` [rad].
std::string carmenDrive(double turn = 0)
{
  std::string log = "# a comment, and a message that is no scan\nODOM 0 0 0 0 0 0 1 host 1\n";
  RawlogReader reader(kDrive);
  TPose2D odometry;
  while (const auto step = reader.next())
  {
    if (step->motion) odometry = odometry + step->motion->mean;
    log += robotLaser(*step, odometry, turn);
  }
  return log;
}

json summaryOfDrive(const TemporaryFolder& folder, const std::string& log, const std::string& out,
                    int code = 0)
{
  const CommandResult result =
      run(folder, "sigloc-localize",
          {"--map", kOffice.string(), "--log", log, "--out", out, "--quiet"});
  EXPECT_EQ(result.exit_code, code) << result.errors;
  return summaryOf(folder, out);
}

TEST(CarmenDrive, aMountThatIsTurnedIsTold)
{
  constexpr double kTurn = 0.5;
  const TemporaryFolder folder;
  writeText(folder / "drive.clf", carmenDrive(kTurn));
  const CommandResult result = run(
      folder, "sigloc-localize", {"--map", kOffice.string(), "--log", "drive.clf", "--out", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const json summary = summaryOf(folder);
  ASSERT_GT(summary["localized_steps"], 10);
  EXPECT_NEAR(summary["odometry_turn_deg"], kTurn * 180 / M_PI, 6);
  EXPECT_NEAR(summary["odometry_stretch"], 1, 0.1);
  EXPECT_NE(result.output.find("to the left: is the yaw of the laser's mount right?"),
            std::string::npos)
      << result.output;
}

TEST(CarmenDrive, isLocalizedAsItsRawlogIs)
{
  const TemporaryFolder folder;
  writeText(folder / "drive.clf", carmenDrive());
  const json expected = summaryOfDrive(folder, kDrive.string(), "rawlog");
  const json carmen = summaryOfDrive(folder, "drive.clf", "carmen");
  EXPECT_EQ(carmen["steps"], expected["steps"]);
  EXPECT_EQ(carmen["final_verdict"], "localized");
  EXPECT_NEAR(carmen["distance_m"].get<double>(), expected["distance_m"].get<double>(), 0.1);
  EXPECT_NEAR(carmen["steps_to_localized"].get<double>(),
              expected["steps_to_localized"].get<double>(), 5);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(carmen["final_pose"][i].get<double>(), expected["final_pose"][i].get<double>(),
                0.02);
  }
}

TEST(CarmenDrive, thatIsCutOffIsReadUpToThere)
{
  const TemporaryFolder folder;
  const std::string whole = carmenDrive();
  writeText(folder / "whole.log", whole);
  writeText(folder / "cut.log", whole.substr(0, whole.size() - 700));
  writeText(folder / "damaged.log", whole.substr(0, whole.size() - 700) + "\n");
  const json expected = summaryOfDrive(folder, "whole.log", "whole");
  constexpr int kCutOff = 2;
  const json cut = summaryOfDrive(folder, "cut.log", "cut", kCutOff);
  EXPECT_EQ(cut["steps"].get<int>(), expected["steps"].get<int>() - 1);
  const CommandResult damaged =
      run(folder, "sigloc-localize",
          {"--map", kOffice.string(), "--log", "damaged.log", "--out", "damaged"});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_NE(damaged.errors.find("cut off"), std::string::npos) << damaged.errors;
}

TEST(CarmenDrive, isWrittenAsARawlogWithThePoses)
{
  const TemporaryFolder folder;
  writeText(folder / "drive.log", carmenDrive());
  const json summary = summaryOfDrive(folder, "drive.log", "out");
  RawlogReader annotated(folder / "out/annotated.rawlog");
  std::size_t steps = 0;
  std::size_t poses = 0;
  while (const auto step = annotated.next())
  {
    ++steps;
    for (const auto& seen : *step->frame) poses += seen->sensorLabel == "sigloc" ? 1 : 0;
  }
  EXPECT_EQ(steps, summary["steps"].get<std::size_t>());
  EXPECT_GE(poses, summary["localized_steps"].get<std::size_t>() - 1);
}

TEST(CarmenDrive, withoutOdometryAndTimesItIsAnsweredToo)
{
  const TemporaryFolder folder;
  std::string line = "FLASER 181";
  for (int i = 0; i < 181; ++i) line += " 3";
  writeText(folder / "drive.log", line + " 0 0 0\n" + line + " 0 0 0\n");
  const json summary = summaryOfDrive(folder, "drive.log", "out");
  EXPECT_EQ(summary["steps"], 2);
  EXPECT_TRUE(summary["distance_m"].is_null());
}

TEST(CarmenDrive, oneWithoutAReturnIsToldInOneLine)
{
  const TemporaryFolder folder;
  for (const char* const range : {"nan", "3"})
  {
    std::string line = "FLASER 181";
    for (int i = 0; i < 181; ++i) line += std::string(" ") + range;
    writeText(folder / "drive.log", line + " 0 0 0\n" + line + " 0 0 0\n");
    const CommandResult result =
        run(folder, "sigloc-localize", {"--map", kOffice.string(), "--log", "drive.log"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("drive.log: no scan has a valid return: every range is"),
              std::string::npos)
        << result.errors;
  }
}

TEST(CarmenDrive, aBadOneIsRefusedInOneLine)
{
  const TemporaryFolder folder;
  writeText(folder / "none.log", "ODOM 1 2 3 0 0 0 1 host 1\n");
  writeText(folder / "cut.clf", "FLASER 180 1 2 3\n");
  for (const auto& [log, why] :
       {std::pair("none.log", "no FLASER"), std::pair("cut.clf", "line 1")})
  {
    const CommandResult result =
        run(folder, "sigloc-localize", {"--map", kOffice.string(), "--log", log, "--out", "out"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find(why), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}
}  // namespace
}  // namespace sigloc
