// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that are compressed by gzip, and what may stand behind their contents.
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "io/archive/gzip_input.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

constexpr const char* kDamaged =
    ": damaged: its check fails; gzip -dc or zstd -dc unpacks what is left of it";

/// One member of gzip.
std::string gzipMember(const std::string& bytes)
{
  const TemporaryFolder folder;
  gzFile file = gzopen((folder / "a").c_str(), "wb6");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return readBytes(folder / "a");
}

struct Contents
{
  std::string bytes;
  bool damaged = false;
};

/// Reads a file in pieces of random size, small and large.
Contents contentsOf(const std::filesystem::path& path)
{
  std::mt19937 generator(3);
  detail::GzipInput input(path);
  Contents contents;
  for (bool more = true; more;)
  {
    std::string piece(generator() % 2 == 0 ? 1 + generator() % 9 : 1 + generator() % 600000, '\0');
    const std::size_t got = input.Read(piece.data(), piece.size());
    more = got == piece.size();
    contents.bytes.append(piece, 0, got);
  }
  contents.damaged = input.damaged();
  return contents;
}

Contents contentsOf(const TemporaryFolder& folder, const std::string& file)
{
  writeText(folder / "file", file);
  return contentsOf(folder / "file");
}

std::string mixed(std::size_t count)
{
  std::mt19937 generator(5);
  std::string bytes(count, 'a');
  for (std::size_t i = 0; i < count; i += 1 + generator() % 7)
    bytes[i] = static_cast<char>(generator() & 0xFFU);
  return bytes;
}

TEST(GzipFiles, holdWhatWasPackedInOneMemberOrSeveral)
{
  const TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 1000U, 262144U, 3000000U})
  {
    const std::string bytes = mixed(size);
    const std::string member = gzipMember(bytes);
    for (const std::string& zeros : {std::string(), std::string(700000, '\0')})
    {
      const auto [one, damaged] = contentsOf(folder, member + zeros);
      EXPECT_TRUE(one == bytes && !damaged) << size;
      const auto [two, second_damaged] = contentsOf(folder, member + zeros + member);
      EXPECT_TRUE(two == bytes + bytes && !second_damaged) << size;
    }
  }
}

TEST(GzipFiles, cutOffOnesAreToldAndGiveWhatTheyHave)
{
  const TemporaryFolder folder;
  const std::string bytes = mixed(20000);
  const std::string whole = gzipMember(bytes);
  std::size_t before = 0;
  for (std::size_t size = 4; size < whole.size(); size += 1 + size / 5)
  {
    const auto [got, damaged] = contentsOf(folder, whole.substr(0, size));
    EXPECT_TRUE(damaged) << size;
    EXPECT_TRUE(got == bytes.substr(0, got.size())) << size;
    EXPECT_GE(got.size(), before);
    before = got.size();
  }
  EXPECT_GT(before, 10000U);
}

TEST(GzipFiles, whatFollowsThemAndIsNoneIsDamage)
{
  const TemporaryFolder folder;
  const std::string bytes = mixed(5000);
  for (const std::string& junk :
       {std::string("x"), std::string("\x1f"), readBytes(kLabMap).substr(0, 5),
        std::string(20, '\0') + "junk", mixed(300000)})
  {
    const auto [got, damaged] = contentsOf(folder, gzipMember(bytes) + junk);
    EXPECT_TRUE(damaged) << junk.size();
    EXPECT_TRUE(got.substr(0, bytes.size()) == bytes);
  }
  const auto log = folder / "l.rawlog";
  writeText(log, readBytes(kLabLog) + "the end");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { RawlogReader reader(log); }),
            log.string() + kDamaged);
  const auto map = folder / "m.simplemap";
  writeText(map, readBytes(kLabMap) + "the end");
  EXPECT_EQ(mapErrorOf(map), map.string() + kDamaged);
  writeText(log, readBytes(kLabLog) + "\n");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { RawlogReader reader(log); }),
            log.string() + kDamaged);
}

TEST(GzipFiles, noByteThatIsChangedChangesTheContentsUnnoticed)
{
  const TemporaryFolder folder;
  const std::string bytes = mixed(3000);
  const std::string whole = gzipMember(bytes);
  std::mt19937 generator(9);
  std::size_t noticed = 0;
  for (int k = 0; k < 200; ++k)
  {
    std::string spoilt = whole;
    spoilt[2 + generator() % (spoilt.size() - 2)] ^= static_cast<char>(1 + generator() % 255);
    const auto [got, damaged] = contentsOf(folder, spoilt);
    EXPECT_TRUE(damaged || got == bytes) << k;
    noticed += damaged ? 1 : 0;
  }
  EXPECT_GT(noticed, 180U);
}

TEST(GzipFiles, whatFollowsAMapIsNotLostWithoutAWord)
{
  const TemporaryFolder folder;
  const auto office = std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "../../maps/office.gridmap.gz";
  for (const auto& [name, source] :
       {std::pair<const char*, std::filesystem::path>{"m.simplemap", kLabMap},
        {"m.gridmap", office}})
  {
    const std::string bytes = contentsOf(source).bytes;
    for (const std::string& more : {std::string("x"), bytes})
    {
      writeText(folder / name, gzipMember(bytes + more));
      const std::string message = mapErrorOf(folder / name);
      EXPECT_NE(message.find(": more follows its '"), std::string::npos) << message;
    }
  }
}

TEST(GzipFiles, aMapMayBeOfSeveralMembersOrHaveZerosBehindIt)
{
  const TemporaryFolder folder;
  saveSigmap(buildMapFromFile(kLabMap, {}, {}), folder / "m.sigmap");
  const std::string bytes = contentsOf(folder / "m.sigmap").bytes;
  const std::string two = gzipMember(bytes.substr(0, 1000)) + gzipMember(bytes.substr(1000));
  const std::string zeros = gzipMember(bytes) + std::string(600, '\0');
  for (const std::string& file :
       {gzipMember(bytes), two, zeros, gzipMember(bytes) + gzipMember("")})
  {
    writeText(folder / "again.sigmap", file);
    saveSigmap(loadSigmap(folder / "again.sigmap"), folder / "m2.sigmap");
    EXPECT_EQ(readBytes(folder / "m2.sigmap"), readBytes(folder / "m.sigmap"));
  }
}
}  // namespace
}  // namespace sigloc
