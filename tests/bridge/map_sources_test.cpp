// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <random>
#include <sstream>
#include <stdexcept>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{

/// 4 x 3 pixels, first row on top: wall, free, unknown, free / walls and unknowns / ...
void writeRosMap(const TemporaryFolder& folder, const std::string& yaw = "0.0")
{
  const unsigned char pixels[] = {0, 254, 205, 254, 254, 254, 254, 205, 205, 205, 205, 0};
  std::string image = "P5\n4 3\n255\n";
  for (const unsigned char pixel : pixels) image.push_back(static_cast<char>(pixel));
  writeText(folder / "m.pgm", image);
  writeText(folder / "m.yaml", "image: m.pgm\nresolution: 0.1\norigin: [1.0, -2.0, " + yaw +
                                   "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

template <class Object>
void writeObject(const std::filesystem::path& path, const Object& object)
{
  writeObjects(path, {std::make_shared<Object>(object)});
}

std::string flaser(int beams, double range, const std::string& tail = "1 2 0.5 1 2 0.5 10 host 10")
{
  std::ostringstream line;
  line << "FLASER " << beams;
  for (int i = 0; i < beams; ++i) line << ' ' << range + 0.001 * i;
  line << ' ' << tail << '\n';
  return line.str();
}
}  // namespace

TEST(MapSources, ReadsTheSimplemapsOfMrpt)
{
  const MapSource source = readMapSource(kLabMap);
  const auto& scans = std::get<std::vector<PosedScans>>(source);
  ASSERT_GT(scans.size(), 20U);
  EXPECT_EQ(scans.front().scans.size(), 1U);
}

TEST(MapSources, TakesPosesAndScansOfASimplemap)
{
  mrpt::maps::CSimpleMap simplemap;
  const auto pose =
      mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(1, 2, 0, 0.5, 0, 0));
  simplemap.insert(pose, makeFrame(makeScan(1.0)));
  simplemap.insert(pose, makeFrame(makeOdometry(1.0, {})));
  const auto posed = posedScansOf(simplemap);
  ASSERT_EQ(posed.size(), 1U) << "a frame without a scan gives none";
  EXPECT_NEAR(posed[0].map_from_robot.phi, 0.5, 1e-12);
  EXPECT_EQ(posed[0].scans[0].ranges.size(), 181U);
}

TEST(MapSources, ReadsAGridmapWithItsThreeStates)
{
  mrpt::maps::COccupancyGridMap2D grid(-1.0F, 1.0F, 2.0F, 3.0F, 0.1F);
  grid.fill(0.5F);
  grid.setCell(3, 2, 0.05F);
  grid.setCell(4, 2, 0.95F);
  const OccupancyRaster raster = rasterOf(grid);
  EXPECT_EQ(raster.frame.width, grid.getSizeX());
  EXPECT_NEAR(raster.frame.origin.x, -1.0, 1e-6);
  EXPECT_NEAR(raster.frame.origin.y, 2.0, 1e-6);
  const auto cell = [&](std::size_t x, std::size_t y)
  { return raster.cells[y * raster.frame.width + x]; };
  EXPECT_EQ(cell(3, 2), CellState::solid_wall);
  EXPECT_EQ(cell(4, 2), CellState::free);
  EXPECT_EQ(cell(5, 2), CellState::unknown);

  const TemporaryFolder folder;
  writeObjects(folder / "g.gridmap", {std::make_shared<mrpt::maps::COccupancyGridMap2D>(grid)});
  const MapSource source = readMapSource(folder / "g.gridmap");
  EXPECT_EQ(std::get<OccupancyRaster>(source).cells, raster.cells);
}

TEST(MapSources, ReadsARosMapUprightAndInItsPlace)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  const MapSource source = readMapSource(folder / "m.yaml");
  const auto& raster = std::get<OccupancyRaster>(source);
  EXPECT_NEAR(raster.frame.origin.x, 1.0, 1e-6);
  EXPECT_NEAR(raster.frame.origin.y, -2.0, 1e-6);
  EXPECT_NEAR(raster.frame.resolution, 0.1, 1e-6);
  ASSERT_EQ(raster.frame.width, 4U);
  ASSERT_EQ(raster.frame.height, 3U);
  EXPECT_EQ(raster.cells[3], CellState::solid_wall) << "the image's last row is the map's lowest";
  EXPECT_EQ(raster.cells[0], CellState::unknown);
  EXPECT_EQ(raster.cells[8], CellState::solid_wall);
  EXPECT_EQ(raster.cells[9], CellState::free);
  EXPECT_EQ(raster.cells[10], CellState::unknown);
}

// Mode raw: a pixel is the occupancy in per cent, and unknown above 100.
TEST(MapSources, ReadsARosMapOfRawOccupancies)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  writeText(folder / "m.yaml", readBytes(folder / "m.yaml") + "mode: raw\n");
  const std::string pixels = {100, 0, static_cast<char>(255), 30, 60, 50, 101, 0, 0, 0, 0, 100};
  writeText(folder / "m.pgm", "P5\n4 3\n255\n" + pixels);
  const auto raster = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
  EXPECT_NEAR(raster.frame.origin.x, 1.0, 1e-6);
  EXPECT_NEAR(raster.frame.resolution, 0.1, 1e-6);
  ASSERT_EQ(raster.cells.size(), 12U);
  const std::vector<CellState> top(raster.cells.begin() + 8, raster.cells.end());
  EXPECT_EQ(top, (std::vector<CellState>{CellState::solid_wall, CellState::free, CellState::unknown,
                                         CellState::free}));
  EXPECT_EQ(raster.cells[4], CellState::wall) << "60 % occupied";
  EXPECT_EQ(raster.cells[5], CellState::unknown) << "50 %";
  EXPECT_EQ(raster.cells[6], CellState::unknown) << "101";
  EXPECT_EQ(raster.cells[3], CellState::solid_wall) << "the image's last row is the map's lowest";

  writeText(folder / "m.pgm", "no image");
  EXPECT_NE(mapErrorOf(folder / "m.yaml").find("m.pgm: is no PGM or PNG picture"),
            std::string::npos);
  writeText(folder / "m.pgm", "\x1f\x8b and so on");
  EXPECT_NE(mapErrorOf(folder / "m.yaml").find("m.pgm: is packed; unpack the picture first"),
            std::string::npos);
  EXPECT_NE(mapErrorOf(folder / "m.pgm")
                .find("image_resolution), or its .yaml file; did you mean 'm.yaml'?"),
            std::string::npos);
}

TEST(MapSources, TakesAWholeTurnForNone)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  const auto straight = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
  for (const char* const yaw : {"6.283185307179586", "-6.2831853"})
  {
    writeRosMap(folder, yaw);
    const auto turned = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
    EXPECT_EQ(turned.cells, straight.cells) << yaw;
    EXPECT_NEAR(turned.frame.origin.x, straight.frame.origin.x, 1e-6);
  }
}

TEST(MapSources, RefusesRosMapsThatMakeNoSense)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  const std::string sound = readBytes(folder / "m.yaml");
  const auto errorWith = [&](const std::string& text, const std::string& instead)
  {
    std::string yaml = sound;
    yaml.replace(yaml.find(text), text.size(), instead);
    writeText(folder / "m.yaml", yaml);
    return mapErrorOf(folder / "m.yaml");
  };
  const std::string thresholds = "free_thresh <= occupied_thresh";
  EXPECT_NE(errorWith("0.65", "0.1").find(thresholds), std::string::npos);
  EXPECT_NE(errorWith("0.65", "65").find(thresholds), std::string::npos);
  EXPECT_NE(errorWith("0.196", "-0.1").find(thresholds), std::string::npos);
  EXPECT_NE(errorWith("0.196", ".nan").find("m.yaml: "), std::string::npos);
  for (const char* const resolution : {"1e-9", "1e9", "0", "-0.1"})
  {
    EXPECT_NE(errorWith("0.1", resolution).find("cells of "), std::string::npos) << resolution;
  }
  EXPECT_NE(errorWith("0.1", ".nan").find("m.yaml: "), std::string::npos);
}

TEST(MapSources, RefusesGridmapsOfAbsurdCells)
{
  const TemporaryFolder folder;
  for (const float cell : {1e-4F, 20.0F})
  {
    mrpt::maps::COccupancyGridMap2D grid(0, 20 * cell, 0, 20 * cell, cell);
    grid.fill(0.9F);
    grid.setCell(3, 3, 0.01F);
    writeObject(folder / "m.gridmap", grid);
    EXPECT_NE(mapErrorOf(folder / "m.gridmap").find("not of 0.005 to 1 m"), std::string::npos)
        << cell;
  }
}

/// The messages of reading a map at (x, y), one for each kind of file that has positions.
std::vector<std::string> errorsOfMapsAt(const TemporaryFolder& folder, double x, double y)
{
  const std::string place = std::to_string(x) + " " + std::to_string(y);
  writeText(folder / "m.log", flaser(180, 3, place + " 0.5 " + place + " 0.5 10 host 10"));
  writeText(folder / "m.txt", place + "\n");
  mrpt::maps::CSimpleMap simplemap;
  simplemap.insert(
      mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(x, y, 0, 0.5, 0, 0)),
      makeFrame(makeScan(1.0)));
  writeObject(folder / "m.simplemap", simplemap);
  mrpt::maps::COccupancyGridMap2D grid(static_cast<float>(x), static_cast<float>(x + 2),
                                       static_cast<float>(y), static_cast<float>(y + 2), 0.1F);
  grid.fill(0.9F);
  grid.setCell(3, 3, 0.01F);
  writeObject(folder / "m.gridmap", grid);
  writeRosMap(folder);
  std::string yaml = readBytes(folder / "m.yaml");
  yaml.replace(yaml.find("1.0, -2.0"), 9, std::to_string(x) + ", " + std::to_string(y));
  writeText(folder / "m.yaml", yaml);
  std::vector<std::string> errors;
  for (const char* const name : {"m.log", "m.txt", "m.simplemap", "m.gridmap", "m.yaml"})
  {
    errors.push_back(mapErrorOf(folder / name));
  }
  return errors;
}

TEST(MapSources, RefusesMapsThatFloatsCannotHold)
{
  const TemporaryFolder folder;
  for (const std::string& error : errorsOfMapsAt(folder, 9e4, -9e4)) EXPECT_EQ(error, "");
  for (const std::string& error : errorsOfMapsAt(folder, 5e5, 5e6))
  {
    EXPECT_EQ(error.rfind((folder / "m.").string(), 0), 0U) << error;
    EXPECT_NE(error.find("shift the map's origin"), std::string::npos) << error;
  }
  Feature landmark;
  landmark.position = {5e5, 5e6};
  const std::string error = messageOf<std::invalid_argument>([&] { FeatureMap({landmark}); });
  EXPECT_NE(error.find("shift the map's origin"), std::string::npos) << error;
}

TEST(MapSources, RefusesRosMapsItCannotHonour)
{
  const TemporaryFolder folder;
  testing::internal::CaptureStderr();
  writeRosMap(folder);
  writeText(folder / "m.pgm", "P5\n4 3\n255\n\x01");
  EXPECT_FALSE(mapErrorOf(folder / "m.yaml").empty());
  std::filesystem::remove(folder / "m.pgm");
  EXPECT_NE(mapErrorOf(folder / "m.yaml").find("m.pgm: no such file"), std::string::npos);
  writeText(folder / "m.yaml", "hello: [1, 2\n");
  EXPECT_NE(mapErrorOf(folder / "m.yaml").find("not a ROS map"), std::string::npos);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the library never prints";
}

TEST(MapSources, GivesFlaserMessagesTheirRightFieldOfView)
{
  const TemporaryFolder folder;
  writeText(folder / "l.log", "# a comment\nPARAM a b\n" + flaser(180, 3) + flaser(181, 3) +
                                  flaser(360, 3) + flaser(361, 3) + "ODOM 1 2 3 0 0 0 1 host 1\n");
  const MapSource source = readMapSource(folder / "l.log");
  const auto& log = std::get<std::vector<PosedScans>>(source);
  ASSERT_EQ(log.size(), 4U);
  const double degree = M_PI / 180;
  const double steps[] = {1, 1, 0.5, 0.5};
  for (std::size_t i = 0; i < 4; ++i)
  {
    const LaserScan& scan = log[i].scans[0];
    EXPECT_NEAR(scan.first_angle, -90 * degree, 1e-9);
    EXPECT_NEAR(scan.angle_step, steps[i] * degree, 1e-9);
    EXPECT_EQ(log[i].map_from_robot, (mrpt::math::TPose2D{1, 2, 0.5}));
  }
  EXPECT_NEAR(static_cast<double>(log[0].scans[0].ranges[10]), 3.01, 1e-5);
}

TEST(MapSources, ReadsRobotLaserMessages)
{
  const TemporaryFolder folder;
  writeText(folder / "l.carmen",
            "ROBOTLASER1 0 -1.0 2.0 0.5 10.0 0.02 0 5 1 2 3 10 nan 2 7 8 4 5 0.25 4 5 0.25 0 0 0 0 "
            "0 1.5 host 1.5\n");
  const MapSource source = readMapSource(folder / "l.carmen");
  const auto& log = std::get<std::vector<PosedScans>>(source);
  ASSERT_EQ(log.size(), 1U);
  const LaserScan& scan = log[0].scans[0];
  EXPECT_EQ(scan.valid, (std::vector<std::uint8_t>{1, 1, 1, 0, 0}));
  EXPECT_DOUBLE_EQ(scan.first_angle, -1.0);
  EXPECT_DOUBLE_EQ(scan.angle_step, 0.5);
  EXPECT_EQ(log[0].map_from_robot, (mrpt::math::TPose2D{4, 5, 0.25}));
}

TEST(MapSources, DropsReadingsClippedToOneValue)
{
  const TemporaryFolder folder;
  std::string line = "FLASER 180";
  for (int i = 0; i < 180; ++i) line += i < 90 ? " 50.0" : " 4.5";
  writeText(folder / "l.clf", line + " 0 0 0 0 0 0 1 host 1\n");
  const MapSource source = readMapSource(folder / "l.clf");
  const LaserScan& scan = std::get<std::vector<PosedScans>>(source)[0].scans[0];
  EXPECT_EQ(scan.valid[10], 0);
  EXPECT_EQ(scan.valid[100], 1);
}

TEST(MapSources, ReadsLandmarkRowsAndNamedColumns)
{
  const TemporaryFolder folder;
  writeText(folder / "plain.txt", "# trees\n1 2\n3,4,0.25\n5;6;0.3;0.1\n");
  MapSource source = readMapSource(folder / "plain.txt");
  const auto& plain = std::get<FeatureMap>(source).features();
  ASSERT_EQ(plain.size(), 3U);
  EXPECT_EQ(plain[0].type, FeatureType::point);
  EXPECT_EQ(plain[1].type, FeatureType::circle);
  EXPECT_DOUBLE_EQ(plain[1].size, 0.25);
  EXPECT_DOUBLE_EQ(plain[2].position_covariance(0, 0), 0.1 * 0.1);

  writeText(folder / "named.csv", "# id,x,y,radius,var\n7,1.5,2.5,0.4,9\n");
  source = readMapSource(folder / "named.csv");
  const auto& named = std::get<FeatureMap>(source).features();
  ASSERT_EQ(named.size(), 1U);
  EXPECT_EQ(named[0].position, (mrpt::math::TPoint2D{1.5, 2.5}));
  EXPECT_DOUBLE_EQ(named[0].size, 0.4);

  writeText(folder / "bad.csv", "1,2\n1,two\n");
  EXPECT_NE(mapErrorOf(folder / "bad.csv").find("line 2: bad y"), std::string::npos);
  writeText(folder / "bad.csv", "# x,y,label\n1,2,-2.5\n");
  EXPECT_NE(mapErrorOf(folder / "bad.csv").find("line 2: label is no whole"), std::string::npos);
  writeText(folder / "only.csv", "# x,y\n");
  EXPECT_NE(mapErrorOf(folder / "only.csv").find("no landmark"), std::string::npos);
}

TEST(MapSources, NamesFileAndReasonForUnusableFilesOfEveryKind)
{
  const TemporaryFolder folder;
  std::mt19937 random(20120213);
  std::string noise(4000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  const std::string gridmap = readBytes(kDatasets / "uwb_ro-localization_demo_map.gridmap.gz");
  const std::string simplemap = readBytes(kLabMap);
  testing::internal::CaptureStderr();
  for (const char* extension :
       {"simplemap", "simplemap.gz", "gridmap", "gridmap.gz", "yaml", "log", "clf", "carmen", "csv",
        "txt", "sigmap", "ply", "pcd.gz", "metricmap", "png", "pgm", "unknown"})
  {
    const auto path = folder / (std::string("m.") + extension);
    const auto expect_refused = [&](const char* what)
    {
      const std::string message = mapErrorOf(path);
      EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << what << ": " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    expect_refused("missing");
    writeText(path, "");
    expect_refused("empty");
    writeText(path, noise);
    expect_refused("noise");
    writeText(path, gridmap.substr(0, gridmap.size() / 2));
    expect_refused("half a gridmap");
    writeText(path, simplemap.substr(0, simplemap.size() - 3));
    expect_refused("a simplemap that lacks its last bytes");
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the library never prints";
}

TEST(MapSources, ReusesACacheUntilSourceOrOptionsChange)
{
  const TemporaryFolder folder;
  const auto source = folder / "m.simplemap.gz";
  const auto cache = folder / "m.sigmap";
  std::filesystem::copy_file(kLabMap, source);
  const CachedMap first = mapWithCache(source, cache, {}, {});
  EXPECT_FALSE(first.reused);
  EXPECT_GT(first.map.features().size(), 50U);
  EXPECT_TRUE(mapWithCache(source, cache, {}, {}).reused);
  EXPECT_TRUE(mapWithCache(cache, folder / "unused.sigmap", {}, {}).reused);
  EXPECT_FALSE(std::filesystem::exists(folder / "unused.sigmap"));

  MapBuildingOptions other;
  other.merge_gap = 0.5;
  EXPECT_FALSE(mapWithCache(source, cache, other, {}).reused);
  EXPECT_FALSE(mapWithCache(source, cache, {}, {}).reused);
  writeText(cache, "broken");
  EXPECT_FALSE(mapWithCache(source, cache, {}, {}).reused);
  EXPECT_EQ(loadSigmap(cache).features().size(), first.map.features().size());

  std::filesystem::remove(source);
  std::filesystem::copy_file(kDatasets / "malaga-cs-fac-building.simplemap.gz", source);
  EXPECT_FALSE(mapWithCache(source, cache, {}, {}).reused);
}

TEST(MapSources, RefusesASourceWithoutAnyFeature)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  const auto path = folder / "m.yaml";
  const std::string message =
      messageOf<std::runtime_error>([&] { buildMapFromFile(path, {}, {}); });
  EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
}
