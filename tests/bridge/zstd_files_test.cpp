// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that are compressed by zstd, as MRPT writes them by default since 2.15.7.
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <random>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "bridge/unpacked_file.h"
#include "io/archive/gzip_input.h"
#include "io/archive/zstd_walk.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// One frame of zstd, with the checksum that its program and MRPT add.
std::string zstdFrame(const std::string& bytes)
{
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress2(context, out.data(), out.size(), bytes.data(), bytes.size()));
  ZSTD_freeCCtx(context);
  return out;
}

/// A frame that zstd skips, of one of its sixteen kinds.
std::string skippable(unsigned kind, std::size_t size)
{
  std::string frame = {static_cast<char>(0x50U + kind), '\x2A', '\x4D', '\x18'};
  for (unsigned i = 0; i < 4; ++i) frame += static_cast<char>(size >> (8 * i) & 0xFFU);
  return frame + std::string(size, 'n');
}

std::string noise(std::size_t count)
{
  std::mt19937 generator(5);
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(generator() & 0xFFU);
  return bytes;
}

TEST(ZstdFiles, holdWhatWasPacked)
{
  const TemporaryFolder folder;
  for (const std::size_t size : {1U, 1000U, 131072U, 1000000U})
  {
    const std::string bytes = noise(size);
    writeText(folder / "a", zstdFrame(bytes));
    EXPECT_EQ(unpacked(folder / "a"), bytes) << size;
    EXPECT_NO_THROW(detail::requireIntact(folder / "a"));
    writeText(folder / "a", zstdFrame(bytes) + zstdFrame(bytes));
    EXPECT_EQ(unpacked(folder / "a"), bytes + bytes) << "two frames of " << size;
  }
}

TEST(ZstdFiles, framesToBeSkippedAreSkipped)
{
  const TemporaryFolder folder;
  const std::string bytes = noise(200000);
  for (const std::size_t size : {0U, 1U, 3000U, 300000U})
  {
    for (const unsigned kind : {0U, 7U, 15U})
    {
      const std::string skipped = skippable(kind, size);
      writeText(folder / "a",
                skipped + skipped + zstdFrame(bytes) + skipped + zstdFrame("b") + skipped);
      EXPECT_EQ(unpacked(folder / "a"), bytes + "b") << size << ' ' << kind;
      EXPECT_NO_THROW(detail::requireIntact(folder / "a"));
    }
  }
  writeText(folder / "m.simplemap",
            skippable(3, 50) + zstdFrame(unpacked(kLabMap)) + skippable(3, 50));
  EXPECT_EQ(std::get<std::vector<PosedScans>>(readMapSource(folder / "m.simplemap")).size(),
            std::get<std::vector<PosedScans>>(readMapSource(kLabMap)).size());
  writeText(folder / "m.simplemap", zstdFrame(unpacked(kLabMap)) + skippable(3, 50).substr(0, 40));
  EXPECT_NE(mapErrorOf(folder / "m.simplemap").find("truncated"), std::string::npos);
  writeText(folder / "m.simplemap", skippable(3, 50));
  EXPECT_NE(mapErrorOf(folder / "m.simplemap").find("not an MRPT file"), std::string::npos);
}

TEST(ZstdFiles, namesThatEndInZstAreTaken)
{
  const TemporaryFolder folder;
  const std::filesystem::path office =
      std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "../../maps/office.gridmap.gz";
  writeText(folder / "m.simplemap.zst", zstdFrame(unpacked(kLabMap)));
  writeText(folder / "m.gridmap.zst", zstdFrame(unpacked(office)));
  EXPECT_FALSE(
      std::get<std::vector<PosedScans>>(readMapSource(folder / "m.simplemap.zst")).empty());
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.gridmap.zst")).cells,
            std::get<OccupancyRaster>(readMapSource(office)).cells);
  writeText(folder / "m.log.zst", zstdFrame("FLASER 3 1 2 1 0 0 0 0 0 0 1 host 1\n"));
  EXPECT_TRUE(RawlogReader(folder / "m.log.zst").next());
}

TEST(ZstdFiles, aReadyMapMayBePackedSoInPlaceOfItsOwnPacking)
{
  const TemporaryFolder folder;
  const FeatureMap map = buildMapFromFile(kLabMap, {}, {});
  saveSigmap(map, folder / "m.sigmap");
  writeText(folder / "packed.sigmap", zstdFrame(unpacked(folder / "m.sigmap")));
  EXPECT_EQ(loadSigmap(folder / "packed.sigmap").features().size(), map.features().size());
}

TEST(ZstdFiles, whatIsPackedTwiceSaysSo)
{
  const TemporaryFolder folder;
  saveSigmap(buildMapFromFile(kLabMap, {}, {}), folder / "m.sigmap");
  const std::string map = readBytes(folder / "m.sigmap");
  const std::vector<std::pair<const char*, std::string>> cases = {
      {"a.sigmap", zstdFrame(map)},
      {"a.sigmap.zst", zstdFrame(map)},
      {"a.simplemap.gz.zst", zstdFrame(readBytes(kLabMap))},
      {"a.simplemap.zst", zstdFrame(zstdFrame(unpacked(kLabMap)))},
      {"a.ply", zstdFrame(readBytes(kLabMap))},
      {"a.txt", zstdFrame(readBytes(kLabMap))},
  };
  for (const auto& [name, bytes] : cases)
  {
    writeText(folder / name, bytes);
    EXPECT_EQ(mapErrorOf(folder / name),
              (folder / name).string() +
                  ": is compressed twice; unpack it once, with gunzip or "
                  "zstd -d");
  }
  writeText(folder / "l.rawlog", zstdFrame(readBytes(kLabMap)));
  EXPECT_THROW(RawlogReader(folder / "l.rawlog"), std::runtime_error);
}

TEST(ZstdFiles, mapsAndLogsAreReadAsPlainOnes)
{
  const TemporaryFolder folder;
  writeText(folder / "m.simplemap", zstdFrame(unpacked(kLabMap)));
  const auto expected = std::get<std::vector<PosedScans>>(readMapSource(kLabMap));
  const auto found = std::get<std::vector<PosedScans>>(readMapSource(folder / "m.simplemap"));
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(found.back().scans.front().ranges, expected.back().scans.front().ranges);

  writeText(folder / "l.rawlog", zstdFrame(unpacked(kLabLog)));
  RawlogReader plain(kLabLog);
  RawlogReader log(folder / "l.rawlog");
  double progress = 0;
  std::size_t steps = 0;
  for (auto step = plain.next(); step; step = plain.next(), ++steps)
  {
    const auto same = log.next();
    ASSERT_TRUE(same);
    ASSERT_EQ(same->scans.front().ranges, step->scans.front().ranges);
    EXPECT_GE(log.progress(), progress);
    progress = log.progress();
  }
  EXPECT_EQ(steps, 37U);
  EXPECT_FALSE(log.next() || log.truncated());
  EXPECT_DOUBLE_EQ(log.progress(), 1.0);
}

TEST(ZstdFiles, cutOffOnesAreTold)
{
  const TemporaryFolder folder;
  // zstd packs 128 kB at a time, which is more than the whole of a short log.
  std::string bytes;
  for (int k = 0; k < 20; ++k) bytes += unpacked(kLabLog);
  const std::string whole = zstdFrame(bytes + noise(300000));
  writeText(folder / "l.rawlog", whole.substr(0, whole.size() - 250000));
  RawlogReader log(folder / "l.rawlog");
  std::size_t steps = 0;
  while (log.next()) ++steps;
  EXPECT_GT(steps, 10U);
  EXPECT_TRUE(log.truncated());
  const std::string map = zstdFrame(unpacked(kLabMap));
  for (const std::size_t size : {4U, 6U, 100U, 5000U, static_cast<unsigned>(map.size() - 1)})
  {
    writeText(folder / "m.simplemap", map.substr(0, size));
    EXPECT_THROW(readMapSource(folder / "m.simplemap"), std::runtime_error) << size;
  }
}

TEST(ZstdFiles, damagedOnesAreRefused)
{
  const TemporaryFolder folder;
  const std::string whole = zstdFrame(unpacked(kLabMap));
  std::mt19937 generator(9);
  for (int k = 0; k < 40; ++k)
  {
    std::string spoilt = whole;
    spoilt[8 + generator() % (spoilt.size() - 8)] ^= static_cast<char>(1 + generator() % 255);
    writeText(folder / "m.simplemap", spoilt);
    EXPECT_THROW(readMapSource(folder / "m.simplemap"), std::runtime_error) << k;
  }
}

// A few kilobytes of it would fill all memory.
TEST(ZstdFiles, numbersThatUnpackToFarMoreAreRefused)
{
  const TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 40000000\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  for (const auto& [name, head] :
       {std::pair<const char*, std::string>{"points.txt", ""}, {"points.ply", ply}})
  {
    std::string rows = head;
    while (rows.size() <= detail::kUsualLimits.always) rows += "1 2 0\n";
    writeText(folder / name, zstdFrame(rows));
    EXPECT_EQ(mapErrorOf(folder / name),
              (folder / name).string() + ": unpacks to more than 50 times its size");
  }
}

TEST(ZstdFiles, unpackedBytesAreLimitedByTheFilesSize)
{
  const auto unpackedBytes = [](const std::filesystem::path& path, std::uint64_t always)
  {
    detail::GzipInput input(path);
    input.limitTo({detail::kUsualLimits.most, always});
    return detail::restOf(input);
  };
  constexpr std::size_t kSize = 1U << 20U;
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "zeros";
  writeText(path, zstdFrame(std::string(kSize, '0')));
  EXPECT_EQ(unpackedBytes(path, kSize).size(), kSize);
  EXPECT_THROW(unpackedBytes(path, kSize / 4), std::runtime_error);
  writeText(path, std::string(kSize, '0'));
  EXPECT_EQ(unpackedBytes(path, kSize / 4).size(), kSize) << "which is not packed";
  std::filesystem::resize_file(path, (std::uintmax_t{1} << 32U) + 1);  // takes no room on the disk
  EXPECT_THROW(unpackedBytes(path, kSize), std::runtime_error);
}

detail::PackedContents walkOver(const std::string& bytes)
{
  return detail::walkZstd(
      [&bytes](std::uint64_t place, std::size_t count)
      { return place < bytes.size() ? bytes.substr(place, count) : std::string(); });
}

TEST(ZstdFiles, aWalkOverTheHeadsTellsTheSizeAndWhatIsCutOff)
{
  for (const std::size_t size : {0U, 1U, 255U, 256U, 70000U, 1000000U})
  {
    const std::string frame = zstdFrame(noise(size));
    EXPECT_EQ(walkOver(frame).least, size);
    EXPECT_GE(walkOver(frame).most, size);
    EXPECT_FALSE(walkOver(frame).cut_off);
    const std::string more = frame + skippable(3, 20) + zstdFrame(std::string(size, '0'));
    EXPECT_EQ(walkOver(more).least, 2 * size);
    EXPECT_FALSE(walkOver(more).cut_off);
    for (std::size_t end = 1; end < frame.size(); end += 1 + end / 3)
      EXPECT_TRUE(walkOver(frame.substr(0, end)).cut_off) << end << " of " << size;
  }
  EXPECT_FALSE(walkOver(zstdFrame("a") + "no zstd").cut_off);
}

TEST(ZstdFiles, aWalkOverAHoleEnds)
{
  const std::string head("(\xb5/\xfd\0X", 6);  // zeros are blocks of nothing from here on
  std::uint64_t farthest = 0;
  const auto contents = detail::walkZstd(
      [&](std::uint64_t place, std::size_t count)
      {
        farthest = std::max(farthest, place + count);
        return place == 0 ? head + std::string(count - head.size(), '\0')
                          : std::string(count, '\0');
      });
  EXPECT_FALSE(contents.cut_off);
  EXPECT_LT(farthest, detail::kMostWithoutOutput + (1U << 16U));
}

TEST(ZstdFiles, whatIsToldToUnpackToMuchIsRefusedBeforeAnythingIsRead)
{
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "zeros";
  constexpr std::size_t kSize = 1U << 20U;
  writeText(path, zstdFrame(std::string(kSize, '0')));
  detail::GzipInput input(path);
  EXPECT_NO_THROW(input.limitTo({detail::kUsualLimits.most, kSize}));
  EXPECT_THROW(input.limitTo({detail::kUsualLimits.most, kSize / 4}), std::runtime_error);
  EXPECT_EQ(input.getPosition(), 0U);
}

TEST(ZstdFiles, whatUnpacksToTooMuchIsRefusedBeforeItIsRead)
{
  // A stream does not tell its size, and its zeros are packed blocks.
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "stream";
  constexpr std::size_t kSize = 1U << 20U;
  const std::string zeros(kSize / 2, '0');
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  std::string out(2 * ZSTD_compressBound(kSize), '\0');
  ZSTD_outBuffer to{out.data(), out.size(), 0};
  for (const ZSTD_EndDirective end : {ZSTD_e_continue, ZSTD_e_end})
  {
    ZSTD_inBuffer from{zeros.data(), zeros.size(), 0};
    ASSERT_EQ(ZSTD_isError(ZSTD_compressStream2(context, &to, &from, end)), 0U);
  }
  ZSTD_freeCCtx(context);
  out.resize(to.pos);
  writeText(path, out);
  detail::GzipInput input(path);
  EXPECT_NO_THROW(input.limitTo({detail::kUsualLimits.most, kSize}));
  EXPECT_EQ(detail::restOf(input).size(), kSize);
  detail::GzipInput again(path);
  EXPECT_THROW(again.limitTo({detail::kUsualLimits.most, kSize / 4}), std::runtime_error);
  EXPECT_EQ(again.getPosition(), 0U);
}
}  // namespace
}  // namespace sigloc
