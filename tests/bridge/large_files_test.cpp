// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of gigabytes that are no maps, and small ones that unpack to gigabytes. They are refused by
// their beginning or by their size, before memory or time is taken for the rest.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "bridge/unpacked_file.h"
#include "io/text_rows.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
namespace fs = std::filesystem;

constexpr std::uintmax_t kLargeSize = std::uintmax_t{3} << 30U;  // bytes

/// The most memory of this process so far [kB].
long peak()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// A file that begins so and is a hole from there on. It takes no room on the disk.
void writeLarge(const fs::path& path, const std::string& head)
{
  writeText(path, head);
  fs::resize_file(path, kLargeSize);
}

template <class T>
void appendValue(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Writes some bytes and so many MB of zeros, packed by gzip.
void writeBomb(const fs::path& path, const std::string& head, int megabytes = 600)
{
  mrpt::io::CFileGZOutputStream file(path.string(), mrpt::io::OpenMode::TRUNCATE, 1);
  file.Write(head.data(), head.size());
  const std::string zeros(std::size_t{1} << 20U, '\0');
  for (int i = 0; i < megabytes; ++i) file.Write(zeros.data(), zeros.size());
}

TEST(LargeFiles, AreRefusedByTheirBeginningOrSize)
{
  // One row of so many pixels, which libpng would take 447 MB for.
  using namespace std::string_literals;
  const std::string wide =
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x17\xd7\x84\0\0\0\0\1\b\0\0\0\0\xf3\xd4\xca\x97"
      "\0\0\0\fIDAT"s;
  // 20 000 x 20 000 pixels, of which no row is whole before the last pass.
  const std::string interlaced =
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20\b\0\0\0\1\xb1\x1c\x29\x73"
      "\0\0\0\fIDAT"s;
  const TemporaryFolder folder;
  ReadingOptions reading;
  reading.image_resolution = 0.05;
  struct Case
  {
    const char* name;
    std::string head;
    const char* reason;
  };
  const std::vector<Case> cases = {
      {"m.csv", "x,y\n1,2\n", "holds more than 256 MB"},
      {"m.txt", "1 2 3\n", "holds more than 256 MB"},
      {"m.log", "PARAM x 1\n", "holds more than 1024 MB"},
      {"m.ply", "ply\nformat ascii 1.0\n", "header"},
      {"m.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "header"},
      {"m.pcd", "# .PCD\n", "not a PCD file"},
      {"m.png", "\x89PNG\r\n\x1a\n", "not a PNG picture"},
      {"m.png", wide, "400000000 x 1 pixels"},
      {"m.png", interlaced, "an interlaced picture of more than 100 MB"},
      {"m.pgm", "P5\n10 10\n255\n", "has no free cell"},
      {"m.pgm", "P5\n90000 90000\n255\n", "90000 x 90000 pixels"},
      {"m.yaml", "image: m.pgm\n", "more than 64 kB"},
      {"m.sigmap", "(\xb5/\xfd", "not a .sigmap"},
      {"m.sigmap", "none", "not a .sigmap"},
      {"m.metricmap", "\x9f", "not an MRPT file"},
      {"m.metricmap", "\x9bmrpt::maps::CMultiMetricMap\x0b", "holds more than 1024 MB"},
      {"m.simplemap", unpacked(kLabMap, 200), "truncated or damaged"},
      {"m.gridmap", "\x9fmrpt::maps::COccupancyGridMap2D\6", "truncated or damaged"},
  };
  const long before = peak();
  for (const Case& large : cases)
  {
    writeLarge(folder / large.name, large.head);
    const std::string message = mapErrorOf(folder / large.name, reading);
    EXPECT_EQ(message.rfind((folder / large.name).string() + ": ", 0), 0U) << message;
    EXPECT_NE(message.find(large.reason), std::string::npos) << large.reason << ": " << message;
    fs::remove(folder / large.name);
  }
  EXPECT_LT(peak() - before, 150000) << "[kB]";
}

TEST(LargeFiles, TextWithoutEndIsRefused)
{
  const TemporaryFolder folder;
  writeText(folder / "m.csv", std::string(std::size_t{9} << 20U, 'x'));
  EXPECT_NE(mapErrorOf(folder / "m.csv").find("line 1: longer than 8 MB"), std::string::npos);
  writeText(folder / "rows", "a\n\nb\n");
  std::string lines;
  for (detail::TextLines rows(folder / "rows"); rows.next();)
    lines += std::to_string(rows.index()) + std::string(rows.line()) + " ";
  EXPECT_EQ(lines, "0a 1 2b ");
  EXPECT_THROW(detail::TextLines(folder / "rows", 4), std::runtime_error);
}

TEST(LargeFiles, WhatUnpacksToGigabytesIsRefusedOnTheWay)
{
  const TemporaryFolder folder;
  const std::string map = unpacked(kLabMap, std::size_t{1} << 24U);
  const long before = peak();
  const std::string grid = "\x9fmrpt::maps::COccupancyGridMap2D\6";
  for (const auto& [name, head] : {std::pair<const char*, std::string>{"m.simplemap", map},
                                   {"m.gridmap", grid},
                                   {"m.metricmap", grid},
                                   {"m.csv.gz", "x,y\n"}})
  {
    writeBomb(folder / name, head);
    const std::string message = mapErrorOf(folder / name);
    EXPECT_EQ(message, (folder / name).string() + ": unpacks to more than 50 times its size");
  }
  writeBomb(folder / "m.rawlog", unpacked(kLabLog, std::size_t{1} << 20U));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { RawlogReader(folder / "m.rawlog"); }),
            (folder / "m.rawlog").string() + ": unpacks to more than 50 times its size");
  EXPECT_LT(peak() - before, 150000) << "[kB]";
}

/// The bytes before the cells of a `.sigmap` without a feature, with a field of so many cells a
/// side, which is stored whole.
std::string headOfSigmap(std::uint32_t side)
{
  std::string head = "sigloc-map\n\3" + std::string(12 + 4 * 8 + 4, '\0') + "\1";
  for (const double value : {0.0, 0.0, 0.05}) appendValue(head, value);
  for (const std::uint32_t cells : {side, side}) appendValue(head, cells);
  appendValue(head, 0.0);
  appendValue(head, std::uint32_t{0});
  return head;
}

TEST(LargeFiles, ASigmapWhoseCellsGoOnAfterItIsRefusedBeforeTheyAreRead)
{
  const TemporaryFolder folder;
  const long before = peak();
  writeBomb(folder / "one", headOfSigmap(8192), 257);
  // A second member of gzip tells the size that a sound file has.
  writeBomb(folder / "head", headOfSigmap(8192), 0);
  writeBomb(folder / "cells", headOfSigmap(8192), 256);
  for (const std::string& bytes :
       {readBytes(folder / "one"), readBytes(folder / "head") + readBytes(folder / "cells")})
  {
    writeText(folder / "m.sigmap", bytes);
    EXPECT_EQ(mapErrorOf(folder / "m.sigmap"),
              (folder / "m.sigmap").string() + ": truncated or damaged");
  }
  EXPECT_LT(peak() - before, 150000) << "[kB]";
}

TEST(LargeFiles, ASigmapOfGzipIsSoundToItsEndBeforeItIsRead)
{
  const TemporaryFolder folder;
  const long before = peak();
  writeBomb(folder / "m.sigmap", headOfSigmap(8192), 256);
  fs::resize_file(folder / "m.sigmap", fs::file_size(folder / "m.sigmap") - 6);
  EXPECT_EQ(mapErrorOf(folder / "m.sigmap"),
            (folder / "m.sigmap").string() + ": truncated or damaged");
  EXPECT_LT(peak() - before, 150000) << "[kB]";
}

TEST(LargeFiles, AGridOfCellsThatAreAlikeIsRefusedBeforeItIsRead)
{
  const TemporaryFolder folder;
  std::string head = "\x9fmrpt::maps::COccupancyGridMap2D\6\b";
  for (const std::uint32_t side : {16384U, 16384U}) appendValue(head, side);
  for (const float bound : {0.0F, 16384.0F, 0.0F, 16384.0F, 1.0F}) appendValue(head, bound);
  const long before = peak();
  writeBomb(folder / "m.gridmap", head, 256);
  EXPECT_EQ(mapErrorOf(folder / "m.gridmap"),
            (folder / "m.gridmap").string() + ": all cells of its grid are alike");
  EXPECT_LT(peak() - before, 150000) << "[kB]";
}

TEST(LargeFiles, AHoleInPackedDataEnds)
{
  const TemporaryFolder folder;
  // Zeros are blocks of nothing to zstd.
  writeLarge(folder / "m.simplemap", std::string("(\xb5/\xfd\0X", 6));
  EXPECT_EQ(mapErrorOf(folder / "m.simplemap"),
            (folder / "m.simplemap").string() + ": truncated or damaged");
}
}  // namespace
}  // namespace sigloc
