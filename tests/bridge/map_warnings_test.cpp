// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

#include "bridge/rawlog_files.h"
#include "sigloc/io/map_files.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
/// The warning of a simplemap of two key frames, the second one at `pose`.
std::string warningWith(const mrpt::poses::CPose3D& pose)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  for (const mrpt::poses::CPose3D& place : {mrpt::poses::CPose3D(), pose})
  {
    const auto pdf = mrpt::poses::CPose3DPDFGaussian::Create();
    pdf->mean = place;
    map.insert(pdf, makeFrame(makeScan(1)));
  }
  EXPECT_TRUE(map.saveToFile((folder / "m.simplemap").string()));
  return warningOfMapSource(folder / "m.simplemap");
}
}  // namespace

TEST(MapWarnings, TellOfKeyFramesThatAreNotUsedAsTheyAre)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(warningWith({1, 2, 0.2, 0, 0, 0}), "");
  EXPECT_NE(warningWith({nan, 2, 0, 0, 0, 0}).find("1 key frame left out"), std::string::npos);
  EXPECT_NE(warningWith({1, 2, 3, 0, 0, 0}).find("heights"), std::string::npos);
}

TEST(MapWarnings, SayNothingOfOtherSources)
{
  const TemporaryFolder folder;
  writeText(folder / "trees.csv", "1 2\n");
  EXPECT_EQ(warningOfMapSource(folder / "trees.csv"), "");
}

TEST(LandmarkFile, MayBeginWithTheMarkOfUtf8)
{
  const TemporaryFolder folder;
  writeText(folder / "trees.csv", "\xEF\xBB\xBFx,y\n1,2\n");
  writeText(folder / "bare.csv",
            "\xEF\xBB\xBF"
            "3,4\n");
  for (const auto& [name, x] : {std::pair{"trees.csv", 1.0}, std::pair{"bare.csv", 3.0}})
  {
    const MapSource source = readMapSource(folder / name);
    const auto& map = std::get<FeatureMap>(source);
    ASSERT_EQ(map.features().size(), 1U);
    EXPECT_EQ(map.features()[0].position.x, x);
  }
}

namespace
{
/// A room of 10 m x 8 m with a niche, in cells of `resolution` [m]; `inverted` swaps wall and free.
std::string warningOfRoom(double resolution, bool inverted)
{
  OccupancyRaster raster;
  raster.frame.resolution = resolution;
  raster.frame.width = 100;
  raster.frame.height = 80;
  const CellState wall = inverted ? CellState::free : CellState::solid_wall;
  const CellState free = inverted ? CellState::solid_wall : CellState::free;
  raster.cells.assign(std::size_t{100} * 80, free);
  const auto block = [&](std::uint32_t x_0, std::uint32_t x_1, std::uint32_t y_0, std::uint32_t y_1)
  {
    for (std::uint32_t y = y_0; y < y_1; ++y)
    {
      for (std::uint32_t x = x_0; x < x_1; ++x) raster.cells[std::size_t{y} * 100 + x] = wall;
    }
  };
  block(0, 100, 0, 2);
  block(0, 100, 78, 80);
  block(0, 2, 0, 80);
  block(98, 100, 0, 80);
  for (const std::uint32_t at : {20U, 40U, 60U}) block(at, at + 8, 30, 42);
  return warningOfMap(buildMapFromRaster(raster, {}, {}, {}));
}
}  // namespace

TEST(MapWarnings, TellOfMapsThatCannotBeMeant)
{
  EXPECT_EQ(warningOfRoom(0.1, false), "");
  EXPECT_NE(warningOfRoom(0.1, true).find("are they swapped?"), std::string::npos);
  EXPECT_NE(warningOfRoom(0.6, false).find("resolution in metres"), std::string::npos);
  EXPECT_NE(warningOfRoom(0.01, false).find("m2 of free space; is its resolution"),
            std::string::npos);
  EXPECT_NE(warningOfMap(FeatureMap(std::vector<Feature>(3))).find("only 3 features"),
            std::string::npos);
}

TEST(MapWarnings, AMissingMapIsToldWhateverItsEnding)
{
  const TemporaryFolder folder;
  writeText(folder / "office.simplemap", "x");
  const auto misspelt = folder / "office.simplmap";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { filesOfMapSource(misspelt); }),
            misspelt.string() + ": no such file; did you mean 'office.simplemap'?");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { filesOfMapSource(""); }),
            "the name of the map is empty");
}

TEST(MapWarnings, AnInvertedMapWithoutAFeatureIsToldForWhatItIs)
{
  constexpr int kSide = 120;
  const TemporaryFolder folder;
  std::string image = "P5\n120 120\n255\n";
  for (int y = 0; y < kSide; ++y)
  {
    for (int x = 0; x < kSide; ++x)
    {
      const int depth = std::min({x, y, kSide - 1 - x, kSide - 1 - y});  // into the room
      image.push_back(static_cast<char>(depth < 20 ? 205 : depth < 22 ? 0 : 254));
    }
  }
  writeText(folder / "m.pgm", image);
  writeText(folder / "m.yaml",
            "image: m.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 1\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  try
  {
    buildMapFromFile(folder / "m.yaml", {}, {});
    FAIL() << "a map without a wall was taken";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("are they swapped?"), std::string::npos)
        << error.what();
  }
}
