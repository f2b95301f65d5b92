// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/ObservationSignatures.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include "bridge/rawlog_files.h"
#include "bridge/sample_maps.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::poses::CPose3D;

namespace
{
/// A scan from the middle of a room of 8 m x 5 m, half a circle ahead.
mrpt::obs::CObservation2DRangeScan halfCircleScan()
{
  auto scan = *makeScan(12.5);
  for (std::size_t i = 0; i < scan.getScanSize(); ++i)
  {
    const double angle = (static_cast<double>(i) - 90.0) * M_PI / 180.0;
    const double to_x = 4.0 / std::max(1e-9, std::abs(std::cos(angle)));
    const double to_y = 2.5 / std::max(1e-9, std::abs(std::sin(angle)));
    scan.setScanRange(i, static_cast<float>(std::min(to_x, to_y)));
  }
  scan.sensorPose = CPose3D(0.2, 0, 0.3, 0, 0, 0);
  return scan;
}

std::string textOf(const mrpt::obs::CObservation& observation)
{
  std::ostringstream text;
  observation.getDescriptionAsText(text);
  return text.str();
}
}  // namespace

TEST(ObservationSignatures, HoldsTheFeaturesOfAScan)
{
  const ObservationSignatures seen(halfCircleScan());
  EXPECT_EQ(seen.sensorLabel, "LASER_SIGNATURES");
  EXPECT_EQ(seen.source_label, "LASER");
  EXPECT_EQ(mrpt::Clock::toDouble(seen.timestamp), 12.5);
  // The wall ahead, in the robot frame, and the walls to both sides with their corners.
  ASSERT_EQ(seen.features.size(), 5U);
  EXPECT_NEAR(seen.features[1].position.x, 4.2, 0.01);
  CPose3D laser;
  seen.getSensorPose(laser);
  EXPECT_EQ(laser.z(), 0.3);

  const auto signatures = seen.signatures();
  ASSERT_EQ(signatures.size(), 5U);
  for (const Signature& signature : signatures) EXPECT_EQ(signature.relations.size(), 4U);
  // Between the two corners: the depth of the room.
  EXPECT_EQ(seen.features[3].type, FeatureType::corner);
  EXPECT_EQ(signatures[3].relations.back().other, 4U);
  EXPECT_NEAR(signatures[3].relations.back().key.value, 5.0, 0.02);
}

TEST(ObservationSignatures, SurvivesALogThroughTheBaseClass)
{
  const ObservationSignatures seen(halfCircleScan());
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<ObservationSignatures>(seen));
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << frame;
  memory.Seek(0);
  mrpt::obs::CSensoryFrame copy;
  archive >> copy;
  const auto read = copy.getObservationByClass<ObservationSignatures>();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensorLabel, seen.sensorLabel);
  EXPECT_EQ(read->source_label, seen.source_label);
  EXPECT_EQ(read->timestamp, seen.timestamp);
  EXPECT_EQ(read->sensorPose(), seen.sensorPose());
  ASSERT_EQ(read->features.size(), seen.features.size());
  for (std::size_t i = 0; i < seen.features.size(); ++i)
  {
    expectSameFeature(read->features[i], seen.features[i]);
  }
  ASSERT_EQ(read->returns.size(), 181U);
  EXPECT_EQ(read->returns, seen.returns);
  EXPECT_NEAR(read->returns[90].x, 4.2, 1e-6);  // straight ahead
}

TEST(ObservationSignatures, ReadsALogOfBeforeItsReturns)
{
  // Of version 0: the same bytes without the returns, which come last but for the end mark.
  ObservationSignatures seen(halfCircleScan());
  seen.returns.clear();
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << seen;
  const auto* const data = static_cast<const char*>(memory.getRawBufferData());
  std::string bytes(data, memory.getTotalBytesCount());
  const std::string name = "sigloc::ObservationSignatures";
  const std::size_t version_at = bytes.find(name) + name.size();
  ASSERT_EQ(bytes.at(version_at), 1);
  bytes[version_at] = 0;
  bytes.erase(bytes.size() - 1 - sizeof(std::uint32_t), sizeof(std::uint32_t));
  mrpt::io::CMemoryStream older(bytes.data(), bytes.size());
  auto older_archive = mrpt::serialization::archiveFrom(older);
  const auto read = older_archive.ReadObject<ObservationSignatures>();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->features.size(), seen.features.size());
  EXPECT_TRUE(read->returns.empty());
}

TEST(ObservationSignatures, RefusesAReturnWithoutAPlace)
{
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), 1e6F})
  {
    ObservationSignatures seen(halfCircleScan());
    seen.returns[3].y = wrong;
    mrpt::io::CMemoryStream memory;
    auto archive = mrpt::serialization::archiveFrom(memory);
    archive << seen;
    memory.Seek(0);
    EXPECT_THROW(archive.ReadObject<ObservationSignatures>(), std::exception);
  }
}

TEST(ObservationSignatures, MovesWithTheLaser)
{
  auto scan = halfCircleScan();
  ObservationSignatures moved(scan);
  const CPose3D elsewhere(-0.5, 0.1, 0.3, 2.0, 0, 0);
  moved.setSensorPose(elsewhere);
  scan.sensorPose = elsewhere;
  const ObservationSignatures fresh(scan);
  ASSERT_EQ(moved.features.size(), fresh.features.size());
  for (std::size_t i = 0; i < fresh.features.size(); ++i)
  {
    EXPECT_NEAR(moved.features[i].position.x, fresh.features[i].position.x, 1e-9);
    EXPECT_NEAR(moved.features[i].position.y, fresh.features[i].position.y, 1e-9);
    EXPECT_NEAR(std::cos(moved.features[i].direction - fresh.features[i].direction), 1.0, 1e-9);
  }
  ASSERT_EQ(moved.returns.size(), fresh.returns.size());
  for (std::size_t i = 0; i < fresh.returns.size(); ++i)
  {
    EXPECT_NEAR(moved.returns[i].x, fresh.returns[i].x, 1e-5);
    EXPECT_NEAR(moved.returns[i].y, fresh.returns[i].y, 1e-5);
  }
}

TEST(ObservationSignatures, DescribesExportsAndDrawsItself)
{
  const ObservationSignatures seen(halfCircleScan());
  const std::string text = textOf(seen);
  EXPECT_NE(text.find("Features of the scan 'LASER': 5"), std::string::npos) << text;
  EXPECT_NE(text.find("segment at (4.2"), std::string::npos) << text;
  ASSERT_TRUE(seen.exportTxtSupported());
  std::istringstream row(seen.exportTxtDataRow());
  std::size_t count = 0;
  row >> count;
  EXPECT_EQ(count, 5U);
  double number = 0;
  std::size_t numbers = 0;
  while (row >> number) ++numbers;
  EXPECT_EQ(numbers, 25U);
  EXPECT_EQ(seen.exportTxtHeader().find('\n'), std::string::npos);
  EXPECT_NE(seen.exportTxtHeader().find("(0=point,1=segment,2=circle,3=corner,4=wall_end"),
            std::string::npos);
  mrpt::opengl::CSetOfObjects scene;
  seen.getVisualizationInto(scene);
  EXPECT_FALSE(scene.empty());
}

TEST(ObservationSignatures, DescribesEachTypeByItsOwnSize)
{
  ObservationSignatures seen(halfCircleScan());
  seen.features = sampleFeatures();
  const std::string text = textOf(seen);
  for (const char* const expected :
       {"point at (1.000, 0.667) m +- 0.173 m\n", "segment at (1.100", "radius 0.820 m",
        "opening 59.015 deg", "wall end at (1.400", "length 1.240 m"})
  {
    EXPECT_NE(text.find(expected), std::string::npos) << expected << " in\n" << text;
  }
}

TEST(ObservationSignatures, IsEmptyForAScanThatCannotBeUsed)
{
  auto tilted = halfCircleScan();
  tilted.sensorPose = CPose3D(0, 0, 0, 0, 0.6, 0);
  const ObservationSignatures seen(tilted);
  EXPECT_TRUE(seen.features.empty());
  EXPECT_TRUE(seen.signatures().empty());
  EXPECT_EQ(seen.exportTxtDataRow(), "0");
  EXPECT_FALSE(textOf(seen).empty());
}
