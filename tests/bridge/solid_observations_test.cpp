// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Observations of points in space as planar scans. The room is 8 m x 5 m around the origin, and the
// robot stands in it at (0.5, -0.3), turned by 0.4 rad.
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "bridge/log_steps.h"
#include "bridge/room_map.h"
#include "bridge/unpacked_file.h"
#include "sigloc/io/RawlogReader.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation;

namespace
{
const TPose2D kRobot(0.5, -0.3, 0.4);  // in the room
const mrpt::poses::CPose3D kMount(0.2, 0.1, 0.6, 0.3, 0, 0);  // robot_from_sensor
constexpr double kTime = 1e9;  // [s]

/// The distance from a place in the room to its walls.
double toWall(const TPoint2D& place, double angle)
{
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  const double x = dx > 0 ? kHalfWidth - place.x : -kHalfWidth - place.x;
  const double y = dy > 0 ? kHalfDepth - place.y : -kHalfDepth - place.y;
  return std::min(std::abs(dx) > 1e-9 ? x / dx : 1e9, std::abs(dy) > 1e-9 ? y / dy : 1e9);
}

/// The sensor in the room, seen from above.
TPose2D sensorInRoom()
{
  return kRobot + TPose2D(kMount.x(), kMount.y(), kMount.yaw());
}

/// What the sensor measures from its own place: the wall, or the floor before it.
double rangeOf(double azimuth, double up)
{
  const TPose2D sensor = sensorInRoom();
  const double wall = toWall({sensor.x, sensor.y}, sensor.phi + azimuth) / std::cos(up);
  return up < 0 ? std::min(wall, kMount.z() / -std::sin(up)) : wall;
}

template <class Observation>
std::shared_ptr<Observation> made(const std::string& label)
{
  auto observation = Observation::Create();
  observation->timestamp = mrpt::Clock::fromDouble(kTime);
  observation->sensorLabel = label;
  observation->setSensorPose(kMount);
  return observation;
}

CObservation::Ptr pointCloud()
{
  auto cloud = made<mrpt::obs::CObservationPointCloud>("CLOUD");
  auto points = mrpt::maps::CSimplePointsMap::Create();
  for (double up = -0.6; up < 0.6; up += 0.05)
  {
    for (double azimuth = -M_PI; azimuth < M_PI; azimuth += 0.01)
    {
      const double range = rangeOf(azimuth, up);
      points->insertPoint(static_cast<float>(range * std::cos(up) * std::cos(azimuth)),
                          static_cast<float>(range * std::cos(up) * std::sin(azimuth)),
                          static_cast<float>(range * std::sin(up)));
    }
  }
  cloud->pointcloud = points;
  return cloud;
}

/// A camera with an image of depths, and with a picture beside it.
std::shared_ptr<mrpt::obs::CObservation3DRangeScan> depthCamera(bool is_depth = true)
{
  constexpr int kRows = 60;
  constexpr int kColumns = 160;
  constexpr double kFocal = 120;  // [pixels]
  auto camera = made<mrpt::obs::CObservation3DRangeScan>("KINECT");
  camera->maxRange = 20;
  camera->hasRangeImage = true;
  camera->range_is_depth = is_depth;
  camera->rangeImage_setSize(kRows, kColumns);
  camera->cameraParams.nrows = kRows;
  camera->cameraParams.ncols = kColumns;
  camera->cameraParams.setIntrinsicParamsFromValues(kFocal, kFocal, kColumns / 2.0, kRows / 2.0);
  for (int row = 0; row < kRows; ++row)
  {
    for (int column = 0; column < kColumns; ++column)
    {
      const double left = -(column - kColumns / 2.0) / kFocal;
      const double up = -(row - kRows / 2.0) / kFocal;
      const double flat = std::hypot(1, left);
      const double range = rangeOf(std::atan2(left, 1), std::atan2(up, flat));
      const double depth = range / std::hypot(flat, up);
      camera->rangeImage(row, column) =
          static_cast<std::uint16_t>(std::lround(1000 * (is_depth ? depth : range)));
    }
  }
  camera->hasIntensityImage = true;
  camera->intensityImage.resize(32, 24, mrpt::img::CH_RGB);
  return camera;
}

CObservation::Ptr cameraOfPoints()
{
  auto camera = depthCamera();
  mrpt::maps::CSimplePointsMap points;
  camera->unprojectInto(points);
  auto bare = made<mrpt::obs::CObservation3DRangeScan>("KINECT");
  bare->maxRange = 20;
  bare->hasPoints3D = true;
  bare->resizePoints3DVectors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points.getPoint(i, bare->points3D_x[i], bare->points3D_y[i], bare->points3D_z[i]);
  return bare;
}

/// One turn of a VLP-16, which turns clockwise.
std::shared_ptr<mrpt::obs::CObservationVelodyneScan> velodyne()
{
  using Velodyne = mrpt::obs::CObservationVelodyneScan;
  constexpr std::size_t kPackets = 74;
  constexpr double kBlockStep = 0.4;  // [deg] of two firings
  constexpr std::uint32_t kMicroseconds = 1327;  // of a packet
  auto scan = made<Velodyne>("VELODYNE");
  scan->minRange = 0.3;
  scan->maxRange = 100;
  scan->calibration = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
  for (std::size_t packet = 0; packet < kPackets; ++packet)
  {
    std::string bytes;
    const auto put = [&bytes](std::uint32_t value, int count)
    {
      for (int i = 0; i < count; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFFU);
    };
    for (std::size_t block = 0; block < Velodyne::BLOCKS_PER_PACKET; ++block)
    {
      const double azimuth = kBlockStep * static_cast<double>(packet * 12 + block);
      put(Velodyne::UPPER_BANK, 2);
      put(static_cast<std::uint32_t>(std::lround(100 * azimuth)) % 36000, 2);
      for (std::size_t shot = 0; shot < 32; ++shot)
      {
        const double up = scan->calibration.laser_corrections[shot % 16].verticalCorrection;
        const double turned = azimuth + (shot < 16 ? 0 : kBlockStep / 2);
        const double range = rangeOf(-turned * M_PI / 180, up * M_PI / 180);
        put(static_cast<std::uint32_t>(std::lround(range / 0.002)), 2);
        put(50, 1);
      }
    }
    put(kMicroseconds * static_cast<std::uint32_t>(packet + 1), 4);
    put(0x37, 1);
    put(0x22, 1);
    Velodyne::TVelodyneRawPacket raw;
    std::memcpy(&raw, bytes.data(), sizeof(raw));
    scan->scan_packets.push_back(raw);
  }
  return scan;
}

CObservation::Ptr rotatingOfVelodyne()
{
  auto scan = mrpt::obs::CObservationRotatingScan::Create();
  scan->fromVelodyne(*velodyne());
  return scan;
}

CObservation::Ptr rotatingOfLaser()
{
  auto laser = makeScan(kTime, 1, "SICK");
  laser->sensorPose = kMount;
  laser->maxRange = 20;
  laser->resizeScan(361);
  for (std::size_t i = 0; i < 361; ++i)
  {
    const double azimuth = -0.5 * M_PI + M_PI * static_cast<double>(i) / 360;
    laser->setScanRange(i, static_cast<float>(rangeOf(azimuth, 0)));
    laser->setScanRangeValidity(i, true);
  }
  auto scan = mrpt::obs::CObservationRotatingScan::Create();
  scan->fromScan2D(*laser);
  return scan;
}

/// The one scan of a log with one observation.
LaserScan scanOf(const CObservation::Ptr& observation, const ReadingOptions& reading = {})
{
  const TemporaryFolder folder;
  writeObjects(folder / "one.rawlog", {observation});
  const auto steps = stepsOf(folder / "one.rawlog", reading);
  if (steps.size() != 1 || steps[0].scans.size() != 1) throw std::runtime_error("not one scan");
  EXPECT_EQ(steps[0].time, kTime);
  return steps[0].scans[0];
}

/// Every beam ends at a wall, and there are enough of them.
void expectWalls(const LaserScan& scan, std::size_t least, double tolerance)
{
  std::size_t valid = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    if (scan.valid[i] == 0) continue;
    ++valid;
    const TPose2D sensor = kRobot + scan.robot_from_sensor;
    const double bearing = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    const double wall = toWall({sensor.x, sensor.y}, sensor.phi + bearing);
    EXPECT_NEAR(static_cast<double>(scan.ranges[i]), wall, tolerance) << bearing;
  }
  EXPECT_GE(valid, least);
}
}  // namespace

TEST(SolidObservations, PointCloudsBecomePlanarScans)
{
  expectWalls(scanOf(pointCloud()), 600, 0.03);
}

TEST(SolidObservations, DepthCamerasBecomePlanarScansOfTheirView)
{
  for (const bool is_depth : {true, false})
  {
    const LaserScan scan = scanOf(depthCamera(is_depth));
    expectWalls(scan, 130, 0.06);
    EXPECT_LT(static_cast<double>(scan.ranges.size()) * scan.angle_step, 1.3) << "67 degrees";
  }
  expectWalls(scanOf(cameraOfPoints()), 130, 0.06);
}

TEST(SolidObservations, VelodynesBecomePlanarScansOfAWholeTurn)
{
  expectWalls(scanOf(velodyne()), 1200, 0.05);
  expectWalls(scanOf(rotatingOfVelodyne()), 800, 0.1);
}

TEST(SolidObservations, RotatingScansOfOneRowAreTakenWhateverTheirHeight)
{
  ReadingOptions reading;
  reading.min_height = 5;
  reading.max_height = 6;
  expectWalls(scanOf(rotatingOfLaser(), reading), 300, 0.05);
}

TEST(SolidObservations, TheBandOfHeightsIsThatOfTheRobotsBase)
{
  ReadingOptions floor;
  floor.min_height = -0.1;
  floor.max_height = 0.1;
  const LaserScan scan = scanOf(pointCloud(), floor);
  // The steepest beams meet the floor at 0.6 m / tan(0.6).
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    if (scan.valid[i] == 0) continue;
    EXPECT_NEAR(static_cast<double>(scan.ranges[i]), 0.877, 0.01);
  }
  ReadingOptions none;
  none.min_height = 50;
  none.max_height = 60;
  const TemporaryFolder folder;
  writeObjects(folder / "one.rawlog", {pointCloud()});
  RawlogReader reader(folder / "one.rawlog", none);
  EXPECT_FALSE(reader.next());
  EXPECT_NE(reader.contents().find("1 CObservationPointCloud (no point within the heights"),
            std::string::npos)
      << reader.contents();
  EXPECT_EQ(reader.leftOut().observations, 1U);
  none.max_height = 40;
  EXPECT_THROW(RawlogReader(folder / "one.rawlog", none), std::invalid_argument);
}

TEST(SolidObservations, ALogWithALaserKeepsToIt)
{
  const TemporaryFolder folder;
  auto frame = makeFrame(pointCloud());
  frame->insert(makeScan(kTime));
  writeObjects(folder / "both.rawlog",
               {makeAction({0.1, 0, 0}, mrpt::math::CMatrixDouble33()), frame});
  const auto steps = stepsOf(folder / "both.rawlog");
  ASSERT_EQ(steps.size(), 1U);
  ASSERT_EQ(steps[0].scans.size(), 1U);
  EXPECT_EQ(steps[0].scans[0].ranges.size(), 181U);
}

TEST(SolidObservations, RangesInOtherFilesAreNotOpened)
{
  const TemporaryFolder folder;
  auto cloud = made<mrpt::obs::CObservationPointCloud>("CLOUD");
  cloud->setAsExternalStorage(
      "/dev/zero", mrpt::obs::CObservationPointCloud::ExternalStorageFormat::KittiBinFile);
  writeObjects(folder / "l.rawlog", {cloud});
  RawlogReader reader(folder / "l.rawlog");
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.contents(), "1 CObservationPointCloud (its points are in another file)");
}

TEST(SolidObservations, ReadsTheLogsOfMrptsOwnTests)
{
  for (const auto& [name, least] : {std::pair{"test_velodyne_VLP16.rawlog", 300},
                                    {"rot_scan_velodyne.rawlog", 300},
                                    {"rot_scan_2d.rawlog", 100},
                                    {"tests_rgbd.rawlog", 50}})
  {
    const auto steps = stepsOf(kDatasets / name);
    ASSERT_FALSE(steps.empty()) << name;
    const auto& valid = steps[0].scans.at(0).valid;
    EXPECT_GT(std::count(valid.begin(), valid.end(), 1), least) << name;
  }
}

TEST(SolidObservations, HostileCountsDoNoHarm)
{
  const TemporaryFolder folder;
  auto small = depthCamera();
  small->rangeImage_setSize(4, 6);
  auto packets = velodyne();
  packets->scan_packets.resize(1);
  for (const CObservation::Ptr& sound :
       std::vector<CObservation::Ptr>{small, packets, rotatingOfLaser(), cameraOfPoints()})
  {
    writeObjects(folder / "sound.rawlog", {sound});
    const std::string bytes = unpacked(folder / "sound.rawlog", 1U << 20U);
    // The counts are near the front; behind them a byte in some is enough.
    for (std::size_t at = 0; at < bytes.size(); at += at < 400 ? 5 : 499)
    {
      for (const char value : {'\xFF', '\0'})
      {
        std::string spoilt = bytes;
        for (std::size_t i = at; i < std::min(at + 4, bytes.size()); ++i) spoilt[i] = value;
        writeText(folder / "spoilt.rawlog", spoilt);
        try
        {
          for (const RawlogStep& step : stepsOf(folder / "spoilt.rawlog"))
          {
            for (const LaserScan& scan : step.scans)
            {
              EXPECT_TRUE(std::all_of(scan.ranges.begin(), scan.ranges.end(),
                                      [](float range) { return std::isfinite(range); }));
              observe(step);
            }
          }
        }
        catch (const std::runtime_error&)
        {
          // Refused, by the name of its class or for want of an end.
        }
      }
    }
  }
}
