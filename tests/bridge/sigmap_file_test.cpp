// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "bridge/sample_maps.h"
#include "sigloc/io/file_output.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
std::string loadError(const std::filesystem::path& path)
{
  return messageOf<std::runtime_error>([&] { loadSigmap(path); });
}
}  // namespace

TEST(SigmapFile, RoundTripsExactly)
{
  const TemporaryFolder folder;
  const FeatureMap map = sampleMap(300, 220);
  saveSigmap(map, folder / "m.sigmap");
  expectSameMap(loadSigmap(folder / "m.sigmap"), map);
}

/// A map of two rooms in opposite corners of a frame, in tiles.
FeatureMap mapInTiles()
{
  OccupancyRaster raster;
  raster.frame = {{-3, 5}, 0.05, 900, 800};
  raster.cells.assign(std::size_t{900} * 800, CellState::unknown);
  for (std::size_t y = 0; y < 90; ++y)
  {
    for (std::size_t x = 0; x < 110; ++x)
    {
      const bool edge = x < 2 || y < 2 || x >= 108 || y >= 88;
      raster.cells[y * 900 + x] = edge ? CellState::wall : CellState::free;
      raster.cells[(y + 700) * 900 + x + 780] = edge ? CellState::solid_wall : CellState::free;
    }
  }
  return FeatureMap(sampleFeatures(), inTilesWhereSparse(buildDenseField(raster), 0));
}

// It packs to a thousandth, as hostile files do.
TEST(SigmapFile, RoundTripsAnEmptyHall)
{
  constexpr std::uint32_t kSide = 4200;
  OccupancyRaster raster;
  raster.frame = {{-3, 5}, 0.05, kSide, kSide};
  raster.cells.assign(std::size_t{kSide} * kSide, CellState::free);
  std::fill_n(raster.cells.begin(), kSide, CellState::wall);
  const FeatureMap map(sampleFeatures(), buildDenseField(raster));
  const TemporaryFolder folder;
  saveSigmap(map, folder / "m.sigmap");
  EXPECT_LT(std::filesystem::file_size(folder / "m.sigmap"), 1U << 20U);
  const FeatureMap loaded = loadSigmap(folder / "m.sigmap");
  EXPECT_EQ(loaded.field()->free_area, map.field()->free_area);
  EXPECT_EQ(loaded.field()->wall_cells, kSide);
}

TEST(SigmapFile, RoundTripsFieldsInTiles)
{
  const TemporaryFolder folder;
  const FeatureMap map = mapInTiles();
  ASSERT_TRUE(map.field()->isTiled());
  saveSigmap(map, folder / "m.sigmap");
  const FeatureMap loaded = loadSigmap(folder / "m.sigmap");
  expectSameMap(loaded, map);
  EXPECT_EQ(loaded.field()->tiles, map.field()->tiles);
}

TEST(SigmapFile, NeverTakesACutOrFlippedByteOfTilesForAnotherMap)
{
  const TemporaryFolder folder;
  const auto path = folder / "m.sigmap";
  const FeatureMap map = mapInTiles();
  saveSigmap(map, path);
  const std::string good = readBytes(path);
  std::mt19937 random(11);
  for (int k = 0; k < 200; ++k)
  {
    std::string bad = good;
    if (k % 2 == 0)
    {
      bad.resize(random() % good.size());
    }
    else
    {
      const std::size_t at = 10 + random() % (bad.size() - 10);
      bad[at] = static_cast<char>(bad[at] ^ 0x10);
    }
    writeText(path, bad);
    // In a run of equal bytes, a copy from another distance gives the same content.
    const bool refused = !loadError(path).empty();
    EXPECT_TRUE(refused || k % 2 != 0) << k;
    if (!refused) expectSameMap(loadSigmap(path), map);
  }
}

TEST(SigmapFile, RoundTripsMapsWithoutFieldOrFeatures)
{
  const TemporaryFolder folder;
  const FeatureMap points(sampleFeatures());
  saveSigmap(points, folder / "points.sigmap");
  expectSameMap(loadSigmap(folder / "points.sigmap"), points);
  saveSigmap(FeatureMap{}, folder / "none.sigmap");
  EXPECT_TRUE(loadSigmap(folder / "none.sigmap").empty());
}

TEST(SigmapFile, WritesTheSameBytesEveryTimeAndLeavesNothingElse)
{
  const TemporaryFolder folder;
  saveSigmap(sampleMap(40, 30), folder / "a.sigmap");
  saveSigmap(sampleMap(40, 30), folder / "b.sigmap");
  EXPECT_EQ(readBytes(folder / "a.sigmap"), readBytes(folder / "b.sigmap"));
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(files, std::filesystem::directory_iterator{}), 2);
}

TEST(SigmapFile, NeverTakesACutOrFlippedByteForAnotherMap)
{
  const TemporaryFolder folder;
  const auto path = folder / "m.sigmap";
  const FeatureMap map = sampleMap(24, 18);
  saveSigmap(map, path);
  const std::string good = readBytes(path);
  for (std::size_t size = 0; size < good.size(); size += 7)
  {
    writeText(path, good.substr(0, size));
    EXPECT_EQ(loadError(path).rfind(path.string() + ": ", 0), 0U) << "cut to " << size;
  }
  for (std::size_t at = 0; at < good.size(); at += 5)
  {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    writeText(path, bad);
    // In a run of equal bytes, a copy from another distance gives the same content.
    if (loadError(path).empty()) expectSameMap(loadSigmap(path), map);
  }
}

TEST(SigmapFile, ReadsTheGzipOfOlderVersions)
{
  const TemporaryFolder folder;
  const FeatureMap map = sampleMap(24, 18);
  sigloc::writeObjects(folder / "old.sigmap",
                       [&](mrpt::serialization::CArchive& archive)
                       {
                         const std::string magic = "sigloc-map\n";
                         archive.WriteBuffer(magic.data(), magic.size());
                         writeFeatureMap(map, archive);
                       });
  expectSameMap(loadSigmap(folder / "old.sigmap"), map);
}

// Older versions wrote distances in steps of 5 mm up to 1.27 m, and anybody may write anything.
TEST(SigmapFile, ReadsEveryDistanceOfEveryState)
{
  constexpr std::uint32_t kBytes = 256;
  constexpr std::uint32_t kStates = 4;
  DenseField field;
  field.frame = {{0, 0}, 0.05, kBytes, kStates};
  for (std::uint32_t k = 0; k < kBytes * kStates; ++k)
    field.cells.emplace_back(static_cast<CellState>(k / kBytes));
  field.free_area = kBytes * 0.05 * 0.05;
  field.wall_cells = 2 * kBytes;
  mrpt::io::CMemoryStream written;
  auto out = mrpt::serialization::archiveFrom(written);
  writeFeatureMap(FeatureMap({}, field), out);
  // The planes of the distances, two offsets and the states come last.
  auto* bytes = static_cast<std::uint8_t*>(written.getRawBufferData());
  std::uint8_t* plane = bytes + written.getTotalBytesCount() - 4 * field.cells.size();
  for (std::uint32_t k = 0; k < kBytes * kStates; ++k) plane[k] = static_cast<std::uint8_t>(k);
  written.Seek(0);
  auto in = mrpt::serialization::archiveFrom(written);
  const FeatureMap read = readFeatureMap(in);
  for (std::uint32_t k = 0; k < kBytes * kStates; ++k)
  {
    const DenseCell& cell = read.field()->cells[k];
    const auto state = static_cast<CellState>(k / kBytes);
    const int byte = static_cast<int>(k % kBytes);
    ASSERT_EQ(cell.state(), state) << k;
    if (isWall(state))
      ASSERT_EQ(cell.distance(), 0) << k;
    else if (byte == 255)
      ASSERT_EQ(cell.distance(), DenseCell::kFar);
    else
      ASSERT_EQ(cell.distance(), std::clamp((byte + 1) / 2, 1, 126)) << k;
  }
}

TEST(SigmapFile, SaysWhetherAMapIsTooOldOrTooNew)
{
  const TemporaryFolder folder;
  const auto reasonFor = [&](std::uint8_t version)
  {
    const auto path = folder / "other.sigmap";
    sigloc::writeObjects(path,
                         [version](mrpt::serialization::CArchive& archive)
                         {
                           const std::string magic = "sigloc-map\n";
                           archive.WriteBuffer(magic.data(), magic.size());
                           archive << version;
                         });
    return loadError(path);
  };
  EXPECT_NE(reasonFor(99).find("version 99"), std::string::npos) << reasonFor(99);
  EXPECT_NE(reasonFor(99).find("a newer sigloc made it"), std::string::npos) << reasonFor(99);
  EXPECT_NE(reasonFor(1).find("build it again"), std::string::npos) << reasonFor(1);
}

TEST(SigmapFile, RefusesForeignFiles)
{
  const TemporaryFolder folder;
  std::mt19937 random(20120212);
  std::string noise(3000, '\0');
  for (char& c : noise) c = static_cast<char>(random());
  writeText(folder / "noise.sigmap", noise);
  writeText(folder / "text.sigmap", "x y\n1 2\n");
  EXPECT_NE(loadError(folder / "noise.sigmap").find("not a .sigmap"), std::string::npos);
  EXPECT_NE(loadError(folder / "text.sigmap").find("not a .sigmap"), std::string::npos);
  EXPECT_NE(loadError(folder / "missing.sigmap").find("no such file"), std::string::npos);
  EXPECT_NE(loadError(folder.path()).find("folder"), std::string::npos);
}

TEST(SigmapFile, NamesTheFolderThatTakesNoFile)
{
  const auto path = std::filesystem::path("/nonexistent-folder/m.sigmap");
  const std::string message = messageOf<std::runtime_error>([&] { saveSigmap({}, path); });
  EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
}
