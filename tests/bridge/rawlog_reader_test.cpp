// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/RawlogReader.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "bridge/log_steps.h"
#include "bridge/rawlog_files.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::CMatrixDouble33;
using mrpt::poses::CPose2D;

namespace
{
CMatrixDouble33 diagonal(double xy, double phi)
{
  CMatrixDouble33 m;
  m(0, 0) = m(1, 1) = xy;
  m(2, 2) = phi;
  return m;
}

std::string logErrorOf(const std::filesystem::path& path)
{
  return messageOf<std::runtime_error>([&] { RawlogReader reader(path); });
}
}  // namespace

TEST(RawlogReader, TakesMotionAndCovarianceOfActionsAsGiven)
{
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  writeObjects(path,
               {makeAction({0, 0, 0}, diagonal(0.01, 0.001)), makeFrame(makeScan(10.0)),
                makeAction({0.5, 0.1, 0.2}, diagonal(0.04, 0.002)), makeFrame(makeScan(11.0))});
  RawlogReader reader(path);
  const auto steps = stepsOf(reader);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps[1].time, 11.0, 1e-6);
  ASSERT_TRUE(steps[1].motion);
  EXPECT_DOUBLE_EQ(steps[1].motion->mean.x, 0.5);
  EXPECT_NEAR(steps[1].motion->mean.phi, 0.2, 1e-12);
  EXPECT_NEAR(steps[1].motion->covariance(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(steps[1].motion->covariance(2, 2), 0.002, 1e-12);
  EXPECT_EQ(steps[1].scans.size(), 1U);
  EXPECT_EQ(steps[1].frame->size(), 1U);
  EXPECT_FALSE(reader.truncated());
  EXPECT_DOUBLE_EQ(reader.progress(), 1.0);
}

TEST(RawlogReader, ReadsSampledOdometryTheSameEveryTime)
{
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  movement.computeFromOdometry({0.5, 0, 0.1}, model);
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(movement);
  const TemporaryFolder folder;
  writeObjects(folder / "a.rawlog", {actions, makeFrame(makeScan(1.0))});
  const auto first = stepsOf(folder / "a.rawlog");
  const auto second = stepsOf(folder / "a.rawlog");
  ASSERT_EQ(first.size(), 1U);
  EXPECT_DOUBLE_EQ(first[0].motion->mean.x, 0.5);
  EXPECT_EQ(first[0].motion->mean, second[0].motion->mean);
  EXPECT_EQ(first[0].motion->covariance, second[0].motion->covariance);
}

TEST(RawlogReader, GivesAZeroCovarianceAFloor)
{
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  writeObjects(path, {makeAction({0.5, 0, 0}, diagonal(0, 0)), makeFrame(makeScan(1.0))});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_GT(steps[0].motion->covariance(0, 0), 0.0);
  EXPECT_GT(steps[0].motion->covariance(2, 2), 0.0);
}

TEST(RawlogReader, CountsStepsAsMrptDoesWhenAFrameComesBeforeTheFirstAction)
{
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  const auto action = makeAction({0.1, 0, 0}, diagonal(0.01, 0.001));
  writeObjects(path, {makeFrame(makeScan(9.0)), action, makeFrame(makeScan(10.0)), action,
                      makeFrame(makeScan(11.0))});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps[0].time, 10.0, 1e-6);
  EXPECT_EQ(steps[0].entry, 2U);
  EXPECT_EQ(steps[1].entry, 4U);
  writeObjects(path, {makeFrame(makeScan(9.0)), makeFrame(makeScan(10.0))});
  EXPECT_EQ(stepsOf(path).size(), 2U) << "a log of frames alone keeps them all";
}

TEST(RawlogReader, AddsUpTheMotionAcrossFramesWithoutScans)
{
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  const auto empty_frame = mrpt::obs::CSensoryFrame::Create();
  const auto turn = CPose2D(1, 0, M_PI / 2);
  writeObjects(path, {makeAction(turn, diagonal(0.01, 0.001)), empty_frame,
                      makeAction(turn, diagonal(0.01, 0.001)), makeFrame(makeScan(1.0))});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 1U);
  EXPECT_NEAR(steps[0].motion->mean.x, 1.0, 1e-9);
  EXPECT_NEAR(steps[0].motion->mean.y, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(steps[0].motion->mean.phi), M_PI, 1e-9);
  EXPECT_NEAR(steps[0].motion->covariance(2, 2), 0.002, 1e-9);
}

TEST(RawlogReader, ReportsNoMotionForNaNOdometry)
{
  const TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  writeObjects(folder / "actions.rawlog",
               {makeAction({nan, 0, 0}, diagonal(0.01, 0.001)), makeFrame(makeScan(1.0)),
                makeAction({0.5, 0, 0}, diagonal(0.01, 0.001)), makeFrame(makeScan(2.0))});
  const auto steps = stepsOf(folder / "actions.rawlog");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_FALSE(steps[0].motion);
  ASSERT_TRUE(steps[1].motion);
  EXPECT_DOUBLE_EQ(steps[1].motion->mean.x, 0.5);

  mrpt::obs::CActionRobotMovement2D measured;
  measured.computeFromOdometry({nan, 0, 0}, {});
  const auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(measured);
  writeObjects(folder / "measured.rawlog", {actions, makeFrame(makeScan(1.0))});
  RawlogReader of_measured(folder / "measured.rawlog");
  EXPECT_FALSE(of_measured.next()->motion);
  EXPECT_EQ(of_measured.leftOut().motions, 1U) << "a user must be told";

  writeObjects(folder / "observations.rawlog",
               {makeOdometry(1.0, {0, 0, 0}), makeScan(1.0), makeOdometry(2.0, {nan, 0, 0}),
                makeScan(2.0), makeOdometry(3.0, {1, 0, 0}), makeScan(3.0)});
  double travelled = 0;
  RawlogReader reader(folder / "observations.rawlog");
  while (const auto step = reader.next())
  {
    ASSERT_TRUE(step->motion);
    travelled += step->motion->mean.x;
  }
  EXPECT_NEAR(travelled, 1.0, 1e-9);
  EXPECT_EQ(reader.leftOut().motions, 1U) << "a user must be told";
}

TEST(RawlogReader, DifferencesAndInterpolatesOdometryBetweenScans)
{
  const TemporaryFolder folder;
  const auto path = folder / "observations.rawlog";
  writeObjects(path, {makeOdometry(10.0, {5, 5, M_PI / 2}), makeScan(10.0),
                      makeOdometry(10.4, {5, 5, M_PI / 2}), makeScan(10.5),
                      makeOdometry(10.6, {5, 7, M_PI / 2})});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 2U);
  ASSERT_TRUE(steps[0].motion);
  EXPECT_NEAR(steps[0].motion->mean.norm(), 0.0, 1e-9);
  ASSERT_TRUE(steps[1].motion);
  EXPECT_NEAR(steps[1].motion->mean.x, 1.0, 1e-5);
  EXPECT_NEAR(steps[1].motion->mean.y, 0.0, 1e-5);
  EXPECT_GT(steps[1].motion->covariance(0, 0), 1e-4);
}

TEST(RawlogReader, GroupsSensorsThatFireTogether)
{
  const TemporaryFolder folder;
  const auto path = folder / "observations.rawlog";
  writeObjects(path, {makeScan(1.00, 3.0F, "FRONT"), makeScan(1.02, 4.0F, "BACK"),
                      makeScan(1.03, 3.0F, "FRONT"), makeScan(2.00, 3.0F, "BACK")});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].scans.size(), 2U);
  EXPECT_EQ(steps[1].scans.size(), 1U);
  EXPECT_EQ(steps[2].scans.size(), 1U);
  EXPECT_FALSE(steps[1].motion) << "the log has no odometry";
}

TEST(RawlogReader, TakesAnOdometryResetForNoMotion)
{
  const TemporaryFolder folder;
  const auto path = folder / "observations.rawlog";
  writeObjects(path, {makeOdometry(1.0, {500, 0, 0}), makeScan(1.0), makeOdometry(1.2, {0, 0, 0}),
                      makeScan(1.2)});
  const auto steps = stepsOf(path);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_FALSE(steps[1].motion);
}

TEST(RawlogReader, TakesAJumpOfActionsForNoMotion)
{
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  const auto small = diagonal(0.01, 0.001);
  writeObjects(path, {makeAction({0.5, 0, 0}, small), makeFrame(makeScan(1.0)),
                      makeAction({5e4, 0, 0}, small), makeFrame(makeScan(2.0)),
                      makeAction({1e30, 0, 0}, small), makeFrame(makeScan(3.0)),
                      makeAction({0.5, 0, 0}, diagonal(1e30, 0.1)), makeFrame(makeScan(4.0)),
                      makeAction({12, 0, 0}, small), makeFrame(makeScan(5.0))});
  RawlogReader reader(path);
  const auto steps = stepsOf(reader);
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_TRUE(steps[0].motion);
  EXPECT_FALSE(steps[1].motion);
  EXPECT_FALSE(steps[2].motion);
  ASSERT_TRUE(steps[3].motion);
  EXPECT_LT(steps[3].motion->covariance(0, 0), 1.0) << "as if the log gave none";
  EXPECT_TRUE(steps[4].motion) << "in a second a fast robot gets there";
  EXPECT_EQ(reader.leftOut().motions, 2U);
}

TEST(RawlogReader, LeavesOutWhatASensorCannotBe)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const TemporaryFolder folder;
  const auto path = folder / "actions.rawlog";
  double time = 0;
  std::vector<mrpt::serialization::CSerializable::Ptr> log;
  const auto add = [&](const auto& change)
  {
    const auto scan = makeScan(++time);
    change(*scan);
    log.push_back(makeFrame(scan));
  };
  using Scan = mrpt::obs::CObservation2DRangeScan;
  add([](Scan&) {});
  add([&](Scan& scan) { scan.sensorPose = {nan, 0, 0, 0, 0, 0}; });
  add([&](Scan& scan) { scan.sensorPose = {0, 0, 0, nan, 0, 0}; });
  add([&](Scan& scan) { scan.sensorPose = {1e30, 0, 0, 0, 0, 0}; });
  add([&](Scan& scan) { scan.aperture = infinity; });
  add([&](Scan& scan) { scan.aperture = 1e38F; });
  add([&](Scan& scan) { scan.aperture = 7.0F; });
  add([&](Scan& scan) { scan.resizeScanAndAssign(30001, 3, true); });
  add(
      [&](Scan& scan)
      {
        mrpt::math::CMatrixDouble33 shear = mrpt::math::CMatrixDouble33::Identity();
        shear(0, 1) = 5;
        scan.sensorPose.setRotationMatrix(shear);
      });
  add([&](Scan& scan) { scan.stdError = infinity; });
  add(
      [&](Scan& scan)
      {
        scan.maxRange = 3e38F;
        scan.setScanRange(7, 1e38F);
      });
  writeObjects(path, log);
  RawlogReader reader(path);
  const auto steps = stepsOf(reader);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(reader.leftOut().observations, 8U);
  EXPECT_LT(steps[1].scans[0].range_sigma, 0.1) << "as if the log gave none";
  EXPECT_EQ(steps[2].scans[0].valid[7], 0);
  EXPECT_EQ(steps[2].scans[0].valid[8], 1);
}

TEST(RawlogReader, LeavesOutLandmarksThatMakeNoSense)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto sound = mrpt::obs::CObservationBearingRange::Create();
  sound->validCovariances = true;
  sound->sensedData.resize(2);
  sound->sensedData[0] = {4.0F, 0.0F, 0.0F, 7, {}};
  sound->sensedData[0].covariance(0, 0) = nan;
  sound->sensedData[1] = {1e30F, 0.0F, 0.0F, 8, {}};
  auto lost = mrpt::obs::CObservationBearingRange::Create(*sound);
  lost->sensorLocationOnRobot = mrpt::poses::CPose3D(nan, 0, 0, 0, 0, 0);
  const TemporaryFolder folder;
  writeObjects(folder / "l.rawlog", {makeFrame(sound), makeFrame(lost)});
  RawlogReader reader(folder / "l.rawlog");
  const auto steps = stepsOf(reader);
  ASSERT_EQ(steps.size(), 1U);
  ASSERT_EQ(steps[0].landmarks.size(), 1U);
  EXPECT_GT(steps[0].landmarks[0].position_covariance(0, 0), 0);
  EXPECT_EQ(reader.leftOut().observations, 1U);
}

TEST(RawlogReader, TurnsBearingsAndRangesIntoPoints)
{
  auto observation = mrpt::obs::CObservationBearingRange::Create();
  observation->timestamp = mrpt::Clock::fromDouble(1.0);
  observation->sensorLocationOnRobot = mrpt::poses::CPose3D(1, 0, 0, M_PI / 2, 0, 0);
  observation->sensor_std_range = 0.1F;
  observation->sensor_std_yaw = 0.01F;
  observation->sensedData.resize(2);
  observation->sensedData[0] = {4.0F, 0.0F, 0.0F, 7, {}};
  observation->sensedData[1] = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F, 8, {}};
  const TemporaryFolder folder;
  writeObjects(folder / "l.rawlog", {makeFrame(observation)});
  const auto steps = stepsOf(folder / "l.rawlog");
  ASSERT_EQ(steps.size(), 1U);
  ASSERT_EQ(steps[0].landmarks.size(), 1U);
  const Feature& point = steps[0].landmarks[0];
  EXPECT_NEAR(point.position.x, 1.0, 1e-9);
  EXPECT_NEAR(point.position.y, 4.0, 1e-9);
  EXPECT_NEAR(point.position_covariance(1, 1), 0.01, 1e-6) << "along the line of sight";
  EXPECT_NEAR(point.position_covariance(0, 0), 0.0016, 1e-6) << "across it";
  EXPECT_EQ(point.label, -1);
}

TEST(RawlogReader, ReadsTheDemoLogOfMrpt)
{
  RawlogReader reader(kLabLog);
  const auto steps = stepsOf(reader);
  EXPECT_EQ(steps.size(), 37U);
  EXPECT_FALSE(reader.truncated());
  double length = 0;
  for (const auto& step : steps) length += step.motion ? step.motion->mean.norm() : 0.0;
  EXPECT_NEAR(length, 13.0, 0.1);
}

TEST(RawlogReader, MarksATruncatedLog)
{
  const TemporaryFolder folder;
  const auto path = folder / "cut.rawlog";
  const std::string bytes = readBytes(kLabLog);
  writeText(path, bytes.substr(0, bytes.size() / 2));
  RawlogReader reader(path);
  const auto steps = stepsOf(reader);
  EXPECT_GT(steps.size(), 5U);
  EXPECT_LT(steps.size(), 37U);
  EXPECT_TRUE(reader.truncated());
}

TEST(RawlogReader, RefusesDamagedCompressedLogsAndNeverCrashes)
{
  const TemporaryFolder folder;
  const auto path = folder / "damaged.rawlog";
  const std::string bytes = readBytes(kLabLog);
  std::mt19937 random(20120215);
  for (int i = 0; i < 200; ++i)
  {
    std::string damaged = bytes;
    damaged[10 + random() % (bytes.size() - 18)] ^= static_cast<char>(1U << random() % 8U);
    writeText(path, damaged);
    const std::string message = messageOf<std::runtime_error>([&] { stepsOf(path); });
    EXPECT_EQ(message,
              path.string() +
                  ": damaged: its check fails; gzip -dc or zstd -dc unpacks what is left of it");
  }
}

TEST(RawlogReader, TellsWhatToDoWithAnotherKindOfLog)
{
  const TemporaryFolder folder;
  writeText(folder / "drive.rawlog", "# CARMEN\nFLASER 3 1 2 3 0 0 0 0 0 0 1 host 1\n");
  EXPECT_EQ(logErrorOf(folder / "drive.rawlog"),
            (folder / "drive.rawlog").string() +
                ": not a rawlog; a CARMEN log is named .log, .clf or .carmen");
  writeText(folder / "drive.bag", "#ROSBAG V2.0\n");
  EXPECT_EQ(
      logErrorOf(folder / "drive.bag"),
      (folder / "drive.bag").string() + ": not a rawlog; sigloc-bag2rawlog makes one of a ROS bag");
}

TEST(RawlogReader, NamesFileAndReasonForUnusableFiles)
{
  const TemporaryFolder folder;
  std::mt19937 random(20120211);
  std::string noise(5000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  writeText(folder / "random.rawlog", noise);
  writeText(folder / "empty.rawlog", "");
  writeText(folder / "text.rawlog", "FLASER 3 1 2 3\n");
  writeText(folder / "stub.rawlog", readBytes(kLabLog).substr(0, 40));
  writeObjects(folder / "foreign.rawlog", {mrpt::poses::CPosePDFGaussian::Create()});
  for (const char* name : {"random", "empty", "text", "stub", "foreign", "missing"})
  {
    const auto path = folder / (std::string(name) + ".rawlog");
    const std::string message = logErrorOf(path);
    EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << name << " -> " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_FALSE(logErrorOf(folder.path()).empty()) << "a folder is no rawlog";
}
