// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// What later versions of MRPT write is read as what version 2.5 writes. The golden simplemap was
// written by MRPT 2.14.7 on Debian 13; it has four key frames, two of them with a speed. So was the
// golden log: a rotating scan made of a planar one, and the same with its ranges in another file.
// The other files are made by hand: scans of version 8 end with the duration of the sweep, and grid
// maps of version 7 differ by their version alone.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstring>

#include "bridge/rawlog_files.h"
#include "io/GroundTruth.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

const std::filesystem::path kGolden =
    std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "mrpt_2_14_7.simplemap";
const std::filesystem::path kGoldenLog =
    std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "mrpt_2_14_7_rotating.rawlog";

std::string bytesOf(const mrpt::serialization::CSerializable& object)
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << object;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

/// An object with another version, and something more before its end flag.
std::string inVersion(char version, std::string bytes, const std::string& more)
{
  const std::size_t name = static_cast<unsigned char>(bytes[0]) & 0x7FU;
  bytes[1 + name] = version;
  return bytes.substr(0, bytes.size() - 1) + more + bytes.back();
}

/// A scan as MRPT 2.15 writes it.
std::string newerScan(const mrpt::obs::CObservation2DRangeScan& scan)
{
  const float duration = 0.025F;
  std::string more(sizeof(duration), '\0');
  std::memcpy(more.data(), &duration, sizeof(duration));
  return inVersion(8, bytesOf(scan), more);
}

/// The bytes with every `from` as `to`, which there must be.
std::string replaced(std::string bytes, const std::string& from, const std::string& to)
{
  std::size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos);
  for (; at != std::string::npos; at = bytes.find(from, at + to.size()))
  {
    bytes.replace(at, from.size(), to);
  }
  return bytes;
}

/// The golden simplemap's scans, as its maker set them.
void expectGoldenScans(const std::vector<PosedScans>& posed)
{
  ASSERT_EQ(posed.size(), 4U);
  for (std::size_t k = 0; k < posed.size(); ++k)
  {
    const double number = static_cast<double>(k);
    EXPECT_DOUBLE_EQ(posed[k].map_from_robot.x, number);
    EXPECT_DOUBLE_EQ(posed[k].map_from_robot.y, 0.5 * number);
    EXPECT_DOUBLE_EQ(posed[k].map_from_robot.phi, 0.25 * number);
    ASSERT_EQ(posed[k].scans.size(), 1U);
    const LaserScan& scan = posed[k].scans.front();
    ASSERT_EQ(scan.ranges.size(), 61U);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      EXPECT_EQ(scan.valid[i] != 0, i % 10 != 3) << i;
      const double range = 2 + 0.25 * number + 0.03125 * static_cast<double>(i);
      EXPECT_EQ(static_cast<double>(scan.ranges[i]), scan.valid[i] != 0 ? range : 0) << i;
    }
  }
}

TEST(NewerFiles, aSimplemapOfMrpt214IsRead)
{
  expectGoldenScans(std::get<std::vector<PosedScans>>(readMapSource(kGolden)));
  EXPECT_EQ(warningOfMapSource(kGolden), "");
  const GroundTruth truth = GroundTruth::read(kGolden, {});
  const auto third = truth.at(2, 1002);
  ASSERT_TRUE(third.has_value());
  EXPECT_DOUBLE_EQ(third->x, 2);
}

TEST(NewerFiles, aSimplemapOfMrpt214CutOffIsRefused)
{
  const std::string whole = [&]
  {
    mrpt::io::CFileGZInputStream file(kGolden.string());
    std::string bytes(1U << 16U, '\0');
    bytes.resize(file.Read(bytes.data(), bytes.size()));
    return bytes;
  }();
  const TemporaryFolder folder;
  writeText(folder / "m.simplemap", whole);
  expectGoldenScans(std::get<std::vector<PosedScans>>(readMapSource(folder / "m.simplemap")));
  for (std::size_t size = 30; size < whole.size(); size += 7)
  {
    writeText(folder / "m.simplemap", whole.substr(0, size));
    EXPECT_THROW(readMapSource(folder / "m.simplemap"), std::runtime_error) << size;
  }
}

TEST(NewerFiles, rotatingScansOfMrpt214AreRead)
{
  RawlogReader log(kGoldenLog);
  const auto step = log.next();
  ASSERT_TRUE(step);
  ASSERT_EQ(step->scans.size(), 1U);
  const LaserScan& scan = step->scans.front();
  EXPECT_DOUBLE_EQ(scan.max_range, 20);
  EXPECT_DOUBLE_EQ(scan.robot_from_sensor.x, 0.2);
  std::size_t beam = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    if (scan.valid[i] == 0) continue;
    if (beam == 90) ++beam;  // its maker set no range there
    EXPECT_NEAR(static_cast<double>(scan.ranges[i]), 2 + 0.01 * static_cast<double>(beam), 1e-5);
    const double bearing = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    EXPECT_NEAR(bearing, (static_cast<double>(beam) - 90) * M_PI / 180, scan.angle_step);
    ++beam;
  }
  EXPECT_EQ(beam, 181U);
  EXPECT_FALSE(log.next() || log.truncated());
  EXPECT_NE(log.contents().find("1 CObservationRotatingScan (its ranges are in another file)"),
            std::string::npos)
      << log.contents();
}

TEST(NewerFiles, aLogWithScansOfMrpt215IsReadAsTheOlderOne)
{
  const TemporaryFolder folder;
  std::string older;
  std::string newer;
  for (int k = 0; k < 5; ++k)
  {
    const auto scan = makeScan(k, 2.0F + 0.5F * static_cast<float>(k));
    scan->setScanHasIntensity(k % 2 == 1);
    if (k % 2 == 1) scan->setScanIntensity(3, 7);
    const std::string odometry = bytesOf(*makeOdometry(k, {0.1 * k, 0, 0}));
    older += odometry + bytesOf(*scan);
    newer += odometry + newerScan(*scan);
  }
  writeText(folder / "older.rawlog", older);
  writeText(folder / "newer.rawlog", newer);
  RawlogReader expected(folder / "older.rawlog");
  RawlogReader found(folder / "newer.rawlog");
  for (int k = 0; k < 5; ++k)
  {
    const auto a = expected.next();
    const auto b = found.next();
    ASSERT_TRUE(a && b) << k;
    ASSERT_EQ(b->scans.size(), 1U);
    EXPECT_EQ(a->scans.front().ranges, b->scans.front().ranges);
    EXPECT_EQ(a->scans.front().valid, b->scans.front().valid);
    EXPECT_EQ(a->time, b->time);
    EXPECT_EQ(a->motion->mean.x, b->motion->mean.x);
  }
  EXPECT_FALSE(found.next());
  EXPECT_FALSE(found.truncated());
}

/// A comment as MRPT 2.14 writes it.
std::string newerComment(const mrpt::obs::CObservationComment& comment, const std::string& label)
{
  std::string bytes = bytesOf(comment);
  const std::size_t name = static_cast<unsigned char>(bytes[0]) & 0x7FU;
  bytes.resize(name + 2 + sizeof(std::uint32_t) + comment.text.size() + sizeof(std::uint64_t));
  return inVersion(1, bytes + '\x88',
                   static_cast<char>(label.size()) + std::string(3, '\0') + label);
}

TEST(NewerFiles, commentsOfMrpt214StandBetweenScans)
{
  mrpt::obs::CObservationComment comment;
  comment.text = "a comment";
  const TemporaryFolder folder;
  const std::string scan = bytesOf(*makeScan(1, 2.5F));
  const std::string said = newerComment(comment, "sigloc");
  writeText(folder / "log.rawlog", said + scan + said + bytesOf(*makeScan(2, 3.5F)) + said);
  RawlogReader log(folder / "log.rawlog");
  for (const float range : {2.5F, 3.5F})
  {
    const auto step = log.next();
    ASSERT_TRUE(step) << range;
    EXPECT_EQ(step->scans.front().ranges[7], range);
  }
  EXPECT_FALSE(log.next() || log.truncated());

  auto frame = makeFrame(makeScan(3, 4.5F));
  frame->insert(std::make_shared<mrpt::obs::CObservationComment>(comment));
  const std::string action = bytesOf(*makeAction({0.5, 0, 0}, mrpt::math::CMatrixDouble33()));
  writeText(folder / "framed.rawlog", action + replaced(bytesOf(*frame), bytesOf(comment), said));
  RawlogReader framed(folder / "framed.rawlog");
  const auto step = framed.next();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->scans.front().ranges[7], 4.5F);
  EXPECT_FALSE(framed.next() || framed.truncated());
}

TEST(NewerFiles, framesWithScansOfMrpt215AreRead)
{
  const auto first = makeScan(1, 2.5F);
  const auto second = makeScan(1, 4.5F, "BACK");
  for (const bool foreign : {false, true})
  {
    auto frame = makeFrame(first);
    if (foreign) frame->insert(mrpt::obs::CObservationIMU::Create());
    frame->insert(second);
    std::string bytes = bytesOf(*makeAction({0.5, 0, 0}, mrpt::math::CMatrixDouble33())) +
                        replaced(bytesOf(*frame), bytesOf(*first), newerScan(*first));
    bytes = replaced(bytes, bytesOf(*second), newerScan(*second));
    const TemporaryFolder folder;
    writeText(folder / "log.rawlog", bytes + bytes);
    RawlogReader log(folder / "log.rawlog");
    for (int k = 0; k < 2; ++k)
    {
      const auto step = log.next();
      ASSERT_TRUE(step) << k << foreign;
      ASSERT_EQ(step->scans.size(), 2U);
      EXPECT_EQ(step->scans[0].ranges[7], 2.5F);
      EXPECT_EQ(step->scans[1].ranges[7], 4.5F);
    }
    EXPECT_FALSE(log.next() || log.truncated());
  }
}

TEST(NewerFiles, aSimplemapWithScansOfMrpt215IsRead)
{
  const auto scan = makeScan(1, 2.5F);
  mrpt::maps::CSimpleMap map;
  for (int k = 0; k < 3; ++k)
  {
    map.insert(mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(k, 0, 0, 0, 0, 0)),
               makeFrame(scan));
  }
  const TemporaryFolder folder;
  writeText(folder / "m.simplemap", replaced(bytesOf(map), bytesOf(*scan), newerScan(*scan)));
  const auto posed = std::get<std::vector<PosedScans>>(readMapSource(folder / "m.simplemap"));
  ASSERT_EQ(posed.size(), 3U);
  EXPECT_EQ(posed[2].map_from_robot.x, 2.0);
  EXPECT_EQ(posed[2].scans.front().ranges[90], 2.5F);
}

TEST(NewerFiles, aGridMapOfMrpt3IsReadAsTheOlderOne)
{
  mrpt::maps::COccupancyGridMap2D grid(0, 5, 0, 4, 0.1F);
  grid.fill(0.9F);
  for (int x = 0; x < 50; ++x) grid.setCell(x, 20, 0.1F);
  const TemporaryFolder folder;
  writeText(folder / "older.gridmap", bytesOf(grid));
  writeText(folder / "newer.gridmap", inVersion(7, bytesOf(grid), ""));
  const auto expected = std::get<OccupancyRaster>(readMapSource(folder / "older.gridmap"));
  const auto found = std::get<OccupancyRaster>(readMapSource(folder / "newer.gridmap"));
  EXPECT_EQ(found.cells, expected.cells);
  EXPECT_EQ(found.frame.width, expected.frame.width);
}

TEST(NewerFiles, versionsThatNobodyKnowsAreNamed)
{
  const TemporaryFolder folder;
  mrpt::maps::COccupancyGridMap2D grid(0, 5, 0, 4, 0.1F);
  for (const int version : {8, 200})
  {
    writeText(folder / "m.gridmap", inVersion(static_cast<char>(version), bytesOf(grid), ""));
    try
    {
      readMapSource(folder / "m.gridmap");
      FAIL() << "read a grid map of version " << version;
    }
    catch (const std::runtime_error& error)
    {
      const std::string named = "of version " + std::to_string(version) + ", which is not known";
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
  }
}
}  // namespace
}  // namespace sigloc
