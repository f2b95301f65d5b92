// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The campus as people have it: as nav2 exports it, as an image, in a multi-map, as points. A drive
// ends at the same pose in each.
#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <variant>

#include "bridge/rawlog_files.h"
#include "io/archive/gzip_input.h"
#include "sigloc/io/map_files.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
const auto kCampus = kDatasets / "2006-MalagaCampus.gridmap.gz";
const auto kDrive = kDatasets / "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

/// The belief at the end of the drive.
Belief endOfDrive(const std::filesystem::path& map_file)
{
  const auto map = std::make_shared<const FeatureMap>(buildMapFromFile(map_file, {}, {}));
  HypothesisTracker tracker(std::make_shared<const SignatureMatcher>(map));
  RawlogReader log(kDrive);
  while (const auto step = log.next()) tracker.step(step->motion, observe(*step));
  return tracker.belief();
}

const OccupancyRaster& campus()
{
  static const auto kRaster = std::get<OccupancyRaster>(readMapSource(kCampus));
  return kRaster;
}

const mrpt::math::TPose2D& expected()
{
  static const mrpt::math::TPose2D kPose = endOfDrive(kCampus).hypotheses.at(0).pose.mean;
  return kPose;
}

/// An image of the campus in three shades, of the campus' own size. Its frame is turned by `yaw`
/// about the middle of the campus; `origin` gets its lower left corner.
std::string imageOf(int wall, int free, int unknown, double yaw, mrpt::math::TPose2D& origin)
{
  const RasterFrame& frame = campus().frame;
  const mrpt::math::TPoint2D half(0.5 * frame.width * frame.resolution,
                                  0.5 * frame.height * frame.resolution);
  const mrpt::math::TPose2D middle(frame.origin.x + half.x, frame.origin.y + half.y, yaw);
  const mrpt::math::TPoint2D corner = middle.composePoint(-half);
  origin = {corner.x, corner.y, yaw};
  std::string image =
      "P5\n" + std::to_string(frame.width) + " " + std::to_string(frame.height) + "\n255\n";
  for (std::uint32_t row = frame.height; row-- > 0;)
  {
    for (std::uint32_t column = 0; column < frame.width; ++column)
    {
      const auto at =
          origin.composePoint({(column + 0.5) * frame.resolution, (row + 0.5) * frame.resolution});
      const double x = std::floor((at.x - frame.origin.x) / frame.resolution);
      const double y = std::floor((at.y - frame.origin.y) / frame.resolution);
      const bool inside = x >= 0 && y >= 0 && x < frame.width && y < frame.height;
      const CellState state =
          inside
              ? campus()
                    .cells[static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x)]
              : CellState::unknown;
      const int shade = isWall(state) ? wall : state == CellState::free ? free : unknown;
      image.push_back(static_cast<char>(shade));
    }
  }
  return image;
}

std::string yamlOf(const std::string& mode, const mrpt::math::TPose2D& origin)
{
  std::ostringstream yaml;
  yaml.precision(15);
  yaml << "image: m.pgm\nmode: " << mode << "\nresolution: " << campus().frame.resolution
       << "\norigin: [" << origin.x << ", " << origin.y << ", " << origin.phi
       << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
  return yaml.str();
}

void expectSamePose(const Belief& belief, const char* what)
{
  const double cell = campus().frame.resolution;
  ASSERT_FALSE(belief.hypotheses.empty()) << what;
  const mrpt::math::TPose2D& pose = belief.hypotheses.front().pose.mean;
  EXPECT_LT(std::hypot(pose.x - expected().x, pose.y - expected().y), cell) << what;
  EXPECT_LT(std::abs(std::remainder(pose.phi - expected().phi, 2 * M_PI)), 0.01) << what;
  EXPECT_EQ(belief.verdict, Verdict::localized) << what;
}
}  // namespace

TEST(CampusMaps, EveryModeOfANavigationMapGivesTheSamePose)
{
  const TemporaryFolder folder;
  mrpt::math::TPose2D origin;
  const std::string image = imageOf(0, 254, 205, 0, origin);
  writeText(folder / "m.pgm", image);
  writeText(folder / "m.yaml", yamlOf("trinary", origin));
  expectSamePose(endOfDrive(folder / "m.yaml"), "trinary");
  const auto trinary = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
  // The same cells make the same map.
  writeText(folder / "m.yaml", yamlOf("scale", origin));
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells, trinary.cells);
  writeText(folder / "m.pgm", imageOf(100, 0, 255, 0, origin));
  writeText(folder / "m.yaml", yamlOf("raw", origin));
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells, trinary.cells);
  // An image alone lies at the map's origin.
  writeText(folder / "m.pgm", image);
  ReadingOptions reading;
  reading.image_resolution = campus().frame.resolution;
  const auto alone = std::get<OccupancyRaster>(readMapSource(folder / "m.pgm", reading));
  EXPECT_EQ(alone.cells, trinary.cells);
  EXPECT_EQ(alone.frame.origin, mrpt::math::TPoint2D(0, 0));
}

TEST(CampusMaps, ATurnedOriginGivesTheSamePose)
{
  const TemporaryFolder folder;
  mrpt::math::TPose2D origin;
  writeText(folder / "m.pgm", imageOf(0, 254, 205, 0.1, origin));
  writeText(folder / "m.yaml", yamlOf("trinary", origin));
  expectSamePose(endOfDrive(folder / "m.yaml"), "turned");
}

TEST(CampusMaps, AMultiMapGivesTheSamePose)
{
  const TemporaryFolder folder;
  detail::GzipInput input(kCampus);
  auto archive = mrpt::serialization::archiveFrom(input);
  const auto grid =
      std::dynamic_pointer_cast<mrpt::maps::COccupancyGridMap2D>(archive.ReadObject());
  ASSERT_TRUE(grid);
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1, 2, 0);
  auto multi = mrpt::maps::CMultiMetricMap::Create();
  multi->maps.push_back(points);
  multi->maps.push_back(grid);
  writeObjects(folder / "m.metricmap", {multi});
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.metricmap")).cells, campus().cells);
  expectSamePose(endOfDrive(folder / "m.metricmap"), "multi-map");
}

TEST(CampusMaps, PointsGiveTheSamePoseAndTellThatTheyLackFreeSpace)
{
  const TemporaryFolder folder;
  const RasterFrame& frame = campus().frame;
  std::ostringstream rows;
  std::size_t count = 0;
  for (std::size_t i = 0; i < campus().cells.size(); ++i)
  {
    if (!isWall(campus().cells[i])) continue;
    ++count;
    rows << frame.origin.x + (static_cast<double>(i % frame.width) + 0.5) * frame.resolution << " "
         << frame.origin.y + (static_cast<double>(i / frame.width) + 0.5) * frame.resolution
         << " 0.5\n";
  }
  writeText(folder / "m.ply", "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
                                  "\nproperty float x\nproperty float y\nproperty float z\n"
                                  "end_header\n" +
                                  rows.str());
  expectSamePose(endOfDrive(folder / "m.ply"), "points");
  EXPECT_NE(warningOfMapSource(folder / "m.ply").find("no free space"), std::string::npos);
  writeText(folder / "m.txt", rows.str());
  const auto as_rows = std::get<OccupancyRaster>(readMapSource(folder / "m.txt"));
  EXPECT_EQ(as_rows.cells, std::get<OccupancyRaster>(readMapSource(folder / "m.ply")).cells);
  EXPECT_NE(warningOfMapSource(folder / "m.txt").find("not as landmarks"), std::string::npos);
}
