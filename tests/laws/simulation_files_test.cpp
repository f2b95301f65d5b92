// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/simulation_files.h"

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <fstream>
#include <string>

#include <Eigen/Core>

#include "bridge/rawlog_files.h"
#include "eval/worlds/world_generators.h"
#include "io/key_frames.h"
#include "io/scan_conversion.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using mrpt::math::TPose2D;

class SimulationFiles : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    drive_.metres = 10;
    laser_.sensor_x = 0.2;
    laser_.range_step = 0.001;
    steps_ = simulateDrive(world_, drive_, {}, laser_, 5);
  }

  const World world_ = makeWorld(WorldKind::office, {}, 3);
  DriveOptions drive_;
  LaserOptions laser_;
  std::vector<DriveStep> steps_;
  test::TemporaryFolder folder_;
};

TEST_F(SimulationFiles, ActionFrameLogReadsBack)
{
  const fs::path path = folder_ / "a.rawlog";
  writeRawlog(steps_, {}, RawlogKind::action_frame, path);
  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile(path.string()));
  ASSERT_EQ(log.size(), 2 * steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i)
  {
    const auto movement = log.getAsAction(2 * i)->getBestMovementEstimation();
    ASSERT_TRUE(movement);
    mrpt::math::CMatrixDouble33 covariance;
    mrpt::poses::CPose2D mean;
    movement->poseChange->getCovarianceAndMean(covariance, mean);
    EXPECT_EQ(mean.asTPose(), steps_[i].motion.mean);
    // MRPT stores the motion model in single precision.
    const auto difference = covariance - odometryCovariance(steps_[i].motion.mean, {});
    EXPECT_LT(difference.asEigen().cwiseAbs().maxCoeff(), 1e-9);
    const auto scans = laserScansOf(*log.getAsObservations(2 * i + 1));
    ASSERT_EQ(scans.size(), 1U);
    EXPECT_EQ(scans[0].ranges, steps_[i].scan->ranges);
    EXPECT_EQ(scans[0].valid, steps_[i].scan->valid);
    EXPECT_NEAR(scans[0].first_angle, steps_[i].scan->first_angle, 1e-6);
    EXPECT_NEAR(scans[0].angle_step, steps_[i].scan->angle_step, 1e-8);
    EXPECT_NEAR(scans[0].robot_from_sensor.x, 0.2, 1e-9);
  }
}

TEST_F(SimulationFiles, ObservationLogReadsBack)
{
  const fs::path path = folder_ / "o.rawlog";
  writeRawlog(steps_, {}, RawlogKind::observations, path);
  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile(path.string()));
  ASSERT_EQ(log.size(), 2 * steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i)
  {
    const auto odometry = log.asObservation<mrpt::obs::CObservationOdometry>(2 * i);
    EXPECT_EQ(odometry->odometry.asTPose(), steps_[i].odometry);
    EXPECT_NEAR(mrpt::Clock::toDouble(odometry->timestamp), steps_[i].time, 1e-6);
    const auto scan = log.asObservation<mrpt::obs::CObservation2DRangeScan>(2 * i + 1);
    EXPECT_NEAR(mrpt::Clock::toDouble(scan->timestamp), steps_[i].time, 1e-6);
    EXPECT_EQ(toLaserScan(*scan)->ranges, steps_[i].scan->ranges);
  }
}

TEST_F(SimulationFiles, LandmarkLogReadsBack)
{
  const World points = makeWorld(WorldKind::points, {}, 1);
  const auto steps = simulateLandmarkDrive(points, drive_, {}, {}, 5);
  const fs::path path = folder_ / "l.rawlog";
  writeRawlog(steps, {}, RawlogKind::action_frame, path);
  mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile(path.string()));
  const auto seen =
      log.getAsObservations(1)->getObservationByClass<mrpt::obs::CObservationBearingRange>();
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->sensedData.size(), steps[0].landmarks.size());
  const auto& first = seen->sensedData.front();
  const auto& place = steps[0].landmarks.front().position;
  EXPECT_NEAR(first.range * std::cos(first.yaw), place.x, 1e-5);
  EXPECT_NEAR(first.range * std::sin(first.yaw), place.y, 1e-5);
  EXPECT_EQ(first.landmarkID, -1);
}

TEST_F(SimulationFiles, SimpleMapReadsBackAndFitsTheGridMap)
{
  const auto scans = simulateMapping(world_, 3.0, 0.35, laser_, 5);
  writeSimpleMap(scans, folder_ / "m.simplemap");
  writeGridMap(world_, 0.05, folder_ / "m.gridmap.gz");

  mrpt::io::CFileGZInputStream file((folder_ / "m.gridmap.gz").string());
  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(file) >> grid;
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile((folder_ / "m.simplemap").string()));
  ASSERT_EQ(map.size(), scans.size());

  std::size_t returns = 0;
  std::size_t near_wall = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    const auto [pose, frame] = keyFrameOf(map, i);
    const TPose2D robot = mrpt::poses::CPose2D(pose->getMeanVal()).asTPose();
    EXPECT_NEAR(robot.x, scans[i].map_from_robot.x, 1e-9);
    EXPECT_NEAR(robot.phi, scans[i].map_from_robot.phi, 1e-9);
    EXPECT_GT(grid.getPos(static_cast<float>(robot.x), static_cast<float>(robot.y)), 0.9F);
    for (const LaserScan& scan : laserScansOf(*frame))
    {
      for (std::size_t k = 0; k < scan.ranges.size(); k += 5)
      {
        if (scan.valid[k] == 0) continue;
        const double angle = scan.first_angle + static_cast<double>(k) * scan.angle_step;
        const auto end = robot.composePoint(scan.robot_from_sensor.composePoint(
            {scan.ranges[k] * std::cos(angle), scan.ranges[k] * std::sin(angle)}));
        ++returns;
        bool wall = false;
        for (int dx = -1; dx <= 1; ++dx)
        {
          for (int dy = -1; dy <= 1; ++dy)
          {
            const int x = grid.x2idx(static_cast<float>(end.x)) + dx;
            const int y = grid.y2idx(static_cast<float>(end.y)) + dy;
            wall = wall || grid.getCell(x, y) < 0.1F;
          }
        }
        near_wall += wall ? 1 : 0;
      }
    }
  }
  ASSERT_GT(returns, 1000U);
  EXPECT_GT(static_cast<double>(near_wall) / static_cast<double>(returns), 0.98);
}

TEST_F(SimulationFiles, EqualInputsGiveEqualBytes)
{
  const auto write = [&](const std::string& stem)
  {
    const World world = makeWorld(WorldKind::office, {}, 3);
    const auto steps = simulateDrive(world, drive_, {}, laser_, 5);
    writeRawlog(steps, {}, RawlogKind::action_frame, folder_ / (stem + ".a"));
    writeRawlog(steps, {}, RawlogKind::observations, folder_ / (stem + ".o"));
    writeSimpleMap(simulateMapping(world, 3.0, 0.35, laser_, 5), folder_ / (stem + ".s"));
    writeGridMap(world, 0.05, folder_ / (stem + ".g"));
    writeTruth(steps, folder_ / (stem + ".t"));
  };
  write("one");
  write("two");
  for (const char* kind : {".a", ".o", ".s", ".g", ".t"})
  {
    const std::string first = test::readBytes(folder_ / (std::string("one") + kind));
    EXPECT_GT(first.size(), 500U) << kind;
    EXPECT_EQ(first, test::readBytes(folder_ / (std::string("two") + kind))) << kind;
  }
}

TEST_F(SimulationFiles, TruthHasOneRowAStep)
{
  writeTruth(steps_, folder_ / "truth.txt");
  std::ifstream file(folder_ / "truth.txt");
  for (const DriveStep& step : steps_)
  {
    double time = 0;
    TPose2D pose;
    ASSERT_TRUE(file >> time >> pose.x >> pose.y >> pose.phi);
    EXPECT_NEAR(time, step.time, 1e-3);
    EXPECT_NEAR(pose.x, step.world_from_robot.x, 1e-6);
    EXPECT_NEAR(pose.y, step.world_from_robot.y, 1e-6);
    EXPECT_NEAR(pose.phi, step.world_from_robot.phi, 1e-6);
  }
}

TEST_F(SimulationFiles, FailuresNameThePathAndLeaveNothing)
{
  const fs::path path = folder_ / "missing/a.rawlog";
  try
  {
    writeRawlog(steps_, {}, RawlogKind::action_frame, path);
    FAIL() << "no exception";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_EQ(std::string(error.what()).rfind(path.string() + ": ", 0), 0U) << error.what();
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}
}  // namespace
}  // namespace sigloc
