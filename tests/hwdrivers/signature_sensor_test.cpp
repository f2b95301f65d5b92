// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "hwdrivers/SignatureSensor.h"

#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <mrpt/config/CConfigFile.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <array>

#include <cmath>

#include "bridge/rawlog_files.h"
#include "hwdrivers/RawlogReplay.h"
#include "sigloc/plugin/ObservationSignatures.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::hwdrivers::CGenericSensor;

namespace
{
mrpt::config::CConfigFileMemory config(const std::string& rawlog, const std::string& more = {})
{
  mrpt::config::CConfigFileMemory ini;
  ini.setContent(
      "[L]\ndriver=SignatureSensor\nprocess_rate=100\nsensorLabel=FRONT\n"
      "laser_driver=RawlogReplay\nstop_after_end_s=0.05\nrawlog=" +
      rawlog + "\n" + more);
  return ini;
}

CGenericSensor::Ptr sensorWith(const mrpt::config::CConfigFileMemory& ini)
{
  auto sensor = CGenericSensor::createSensorPtr(SignatureSensor::classSignatureSensor.className);
  sensor->loadConfig(ini, "L");
  sensor->initialize();
  return sensor;
}

std::vector<mrpt::obs::CObservation::Ptr> playAll(CGenericSensor& sensor)
{
  std::vector<mrpt::obs::CObservation::Ptr> all;
  for (int i = 0; i < 1000; ++i)
  {
    sensor.doProcess();
    for (const auto& [time, object] : sensor.getObservations())
    {
      all.push_back(std::dynamic_pointer_cast<mrpt::obs::CObservation>(object));
    }
  }
  return all;
}

/// Gives the process an empty pipe as its standard input, and back what it had.
class EmptyInput
{
 public:
  EmptyInput() : before_(dup(STDIN_FILENO))
  {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    writing_ = ends[1];
  }
  ~EmptyInput()
  {
    if (before_ >= 0) dup2(before_, STDIN_FILENO);
    close(before_);
    close(writing_);
  }
  EmptyInput(const EmptyInput&) = delete;
  EmptyInput& operator=(const EmptyInput&) = delete;

  static int waitingKeys()
  {
    int count = 0;
    EXPECT_EQ(ioctl(STDIN_FILENO, FIONREAD, &count), 0);
    return count;
  }

 private:
  int before_;
  int writing_ = -1;
};
}  // namespace

TEST(SignatureSensor, PressesAKeyOnceAfterTheLogHasEnded)
{
  const EmptyInput input;
  const TemporaryFolder folder;
  const auto path = folder / "in.rawlog";
  writeObjects(path, {makeScan(1, 3.0F, "FRONT"), makeScan(2, 4.0F, "FRONT")});
  const auto sensor = sensorWith(config(path.string()));
  for (int i = 0; i < 6; ++i) sensor->doProcess();
  EXPECT_EQ(EmptyInput::waitingKeys(), 0) << "0.05 s are five calls after the end";
  EXPECT_NO_THROW(playAll(*sensor));
  EXPECT_EQ(EmptyInput::waitingKeys(), 1);
}

TEST(SignatureSensor, AddsSignaturesToWhatALogHolds)
{
  const TemporaryFolder folder;
  const auto path = folder / "in.rawlog";
  writeObjects(path,
               {makeScan(1, 3.0F, "FRONT"), makeOdometry(1.5, {1, 0, 0}), makeScan(2, 4.0F, "")});
  const auto sensor = sensorWith(config(path.string()));
  const auto all = playAll(*sensor);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0]->sensorLabel, "FRONT");
  EXPECT_EQ(all[1]->sensorLabel, "FRONT_SIGNATURES");
  EXPECT_EQ(all[1]->timestamp, all[0]->timestamp);
  EXPECT_EQ(all[2]->sensorLabel, "ODOMETRY");
  EXPECT_EQ(all[3]->sensorLabel, "FRONT") << "what had no label";
  EXPECT_TRUE(std::dynamic_pointer_cast<ObservationSignatures>(all[4]));
}

TEST(SignatureSensor, TurnsTheMotionOfPairsIntoOdometry)
{
  const TemporaryFolder folder;
  const auto path = folder / "in.rawlog";
  const auto covariance = mrpt::math::CMatrixDouble33();
  writeObjects(path, {makeAction({0.5, 0, M_PI / 2}, covariance), makeFrame(makeScan(1)),
                      makeAction({0.5, 0, 0}, covariance), makeFrame(makeScan(2))});
  const auto sensor = sensorWith(config(path.string()));
  const auto all = playAll(*sensor);
  ASSERT_EQ(all.size(), 6U);
  const auto last = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(all[3]);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->odometry.x(), 0.5, 1e-9);
  EXPECT_NEAR(last->odometry.y(), 0.5, 1e-9);
  EXPECT_EQ(last->timestamp, all[4]->timestamp);
}

TEST(SignatureSensor, PlaysALogAtThePaceAskedFor)
{
  const TemporaryFolder folder;
  const auto path = folder / "in.rawlog";
  constexpr double kHour = 3600;
  writeObjects(path, {makeScan(1), makeScan(1), makeScan(1 + kHour)});
  EXPECT_EQ(playAll(*sensorWith(config(path.string(), "pace=1\n"))).size(), 4U)
      << "the last is due in an hour, with its features";
  EXPECT_EQ(playAll(*sensorWith(config(path.string(), "pace=0\n"))).size(), 6U);
  const std::string refused =
      messageOf<std::exception>([&] { sensorWith(config(path.string(), "pace=-1\n")); });
  EXPECT_NE(refused.find("pace must be in"), std::string::npos) << refused;
}

TEST(ReplayPace, EntriesAreDueWhenTheyWereRecorded)
{
  ReplayPace twice(2);
  EXPECT_TRUE(twice.isDue(1e9, 50)) << "the first, whatever the clocks show";
  EXPECT_FALSE(twice.isDue(1e9 + 4, 51.9));
  EXPECT_TRUE(twice.isDue(std::nullopt, 51.9)) << "what has no time waits for nothing";
  EXPECT_TRUE(twice.isDue(1e9 + 4, 52.1));
  EXPECT_TRUE(twice.isDue(1e9 - 100, 52.1)) << "a time that jumps back is past";
  EXPECT_TRUE(ReplayPace(0).isDue(1e9, 0));
}

TEST(SignatureSensor, RefusesWhatItDoesNotKnow)
{
  const auto message = [](const mrpt::config::CConfigFileMemory& ini)
  { return messageOf<std::exception>([&] { sensorWith(ini); }); };
  EXPECT_NE(message(config("/nonexistent.rawlog")).find("/nonexistent.rawlog: no such file"),
            std::string::npos);
  EXPECT_NE(message(config("x", "features.min_segmnt_length=1\n")).find("min_segmnt_length"),
            std::string::npos);
  auto unknown = config("x");
  unknown.write("L", "laser_driver", std::string("CNoSuchLaser"));
  EXPECT_NE(message(unknown).find("CNoSuchLaser"), std::string::npos);
  auto itself = config("x");
  itself.write("L", "laser_driver", std::string("SignatureSensor"));
  EXPECT_NE(message(itself).find("no such sensor"), std::string::npos);
}

TEST(SignatureSensor, TakesTheShippedFilesOfEveryLaser)
{
  for (const char* const name :
       {"rawlog-grabber.ini", "rawlog-sick.ini", "rawlog-rplidar.ini", "rawlog-replay.ini"})
  {
    const mrpt::config::CConfigFile ini(std::string(SIGLOC_SHARE_FOLDER) + "/" + name);
    const auto sensor =
        CGenericSensor::createSensorPtr(ini.read_string("LASER", "driver", "", true));
    ASSERT_TRUE(sensor) << name;
    EXPECT_NO_THROW(sensor->loadConfig(ini, "LASER")) << name;
  }
}
