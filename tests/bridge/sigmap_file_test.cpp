// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/map_files.h"

#include <gtest/gtest.h>

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
  // The ten bytes of gzip's own header hold none of our data (time, system).
  for (std::size_t at = 10; at < good.size(); at += 5)
  {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    writeText(path, bad);
    // In a run of equal bytes, a copy from another distance gives the same content.
    if (loadError(path).empty()) expectSameMap(loadSigmap(path), map);
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
