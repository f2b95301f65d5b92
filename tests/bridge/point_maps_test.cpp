// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Maps of points: every form of their files gives the same walls, and hostile ones are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>
#include <sstream>
#include <variant>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "io/points/point_files.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
using Points = std::vector<std::array<float, 3>>;

/// The walls of a room of 6 m x 4 m around the origin, with points on the floor and the ceiling.
Points roomPoints()
{
  Points points;
  for (int i = 0; i <= 150; ++i)
  {
    const float x = -3.0F + 0.04F * static_cast<float>(i);
    const float y = -2.0F + 0.04F * static_cast<float>(std::min(i, 100));
    for (const float z : {0.5F, 1.0F})
    {
      points.insert(points.end(), {{x, -2, z}, {x, 2, z}, {-3, y, z}, {3, y, z}});
    }
    points.push_back({x, 0.3F, 0});
    points.push_back({0.72F, y, 2.5F});
  }
  return points;
}

template <class T>
std::string bytesOf(T value, bool swapped)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string textOf(const Points& points)
{
  std::ostringstream rows;
  for (const auto& point : points) rows << point[0] << " " << point[1] << " " << point[2] << "\n";
  return rows.str();
}

std::string plyHeader(const std::string& format, std::size_t count)
{
  return "ply\nformat " + format + " 1.0\ncomment by hand\nelement face 1\n" +
         "property list uchar int vertex_index\nelement vertex " + std::to_string(count) +
         "\nproperty uchar red\nproperty double x\nproperty float y\nproperty float "
         "z\nend_header\n";
}

std::string plyOf(const Points& points, const std::string& format)
{
  std::string ply = plyHeader(format, points.size());
  if (format == "ascii")
  {
    ply += "3 0 1 2\n";
    std::istringstream rows(textOf(points));
    for (std::string row; std::getline(rows, row);) ply += "255 " + row + "\n";
    return ply;
  }
  const bool swapped = format == "binary_big_endian";
  ply += '\3';
  for (std::int32_t i = 0; i < 3; ++i) ply += bytesOf(i, swapped);
  for (const auto& point : points)
  {
    ply += '\7' + bytesOf(static_cast<double>(point[0]), swapped) + bytesOf(point[1], swapped) +
           bytesOf(point[2], swapped);
  }
  return ply;
}

std::string pcdHeader(const std::string& data, std::size_t count)
{
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS intensity x y z\nSIZE 4 4 4 4\nTYPE U F F F\n"
         "COUNT 2 1 1 1\nWIDTH " +
         std::to_string(count) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         std::to_string(count) + "\nDATA " + data + "\n";
}

/// Packed by LZF in runs of bytes as they are, and one copy where all are zero.
std::string packed(const std::string& bytes)
{
  constexpr std::size_t kRun = 32;
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += kRun)
  {
    const std::string run = bytes.substr(at, kRun);
    const bool copies = at > 0 && run == std::string(kRun, '\0') && bytes[at - 1] == '\0';
    out += copies ? std::string({'\xE0', '\x17', '\0'}) : static_cast<char>(run.size() - 1) + run;
  }
  return out;
}

std::string pcdOf(const Points& points, const std::string& data)
{
  std::string pcd = pcdHeader(data, points.size());
  std::string columns[4];
  for (const auto& point : points)
  {
    const std::string two(8, '\0');
    if (data == "ascii") pcd += "1 2 " + textOf({point});
    if (data == "binary")
      pcd += two + bytesOf(point[0], false) + bytesOf(point[1], false) + bytesOf(point[2], false);
    columns[0] += two;
    for (std::size_t i = 0; i < 3; ++i) columns[i + 1] += bytesOf(point[i], false);
  }
  if (data != "binary_compressed") return pcd;
  const std::string all = columns[0] + columns[1] + columns[2] + columns[3];
  const std::string lzf = packed(all);
  return pcd + bytesOf(static_cast<std::uint32_t>(lzf.size()), false) +
         bytesOf(static_cast<std::uint32_t>(all.size()), false) + lzf;
}

OccupancyRaster rasterIn(const std::filesystem::path& path)
{
  return std::get<OccupancyRaster>(readMapSource(path));
}

CellState stateAt(const OccupancyRaster& raster, double x, double y)
{
  const auto column =
      static_cast<std::size_t>((x - raster.frame.origin.x) / raster.frame.resolution);
  const auto row = static_cast<std::size_t>((y - raster.frame.origin.y) / raster.frame.resolution);
  return raster.cells.at(row * raster.frame.width + column);
}
}  // namespace

TEST(PointMaps, EveryFormOfFileGivesTheSameWalls)
{
  const TemporaryFolder folder;
  const Points room = roomPoints();
  writeText(folder / "m.txt", "x y z\n" + textOf(room));
  const OccupancyRaster expected = rasterIn(folder / "m.txt");
  EXPECT_EQ(expected.frame.resolution, 0.05);
  EXPECT_EQ(stateAt(expected, 1, 2.001), CellState::solid_wall);
  EXPECT_EQ(stateAt(expected, -2.999, 1), CellState::solid_wall);
  EXPECT_EQ(stateAt(expected, 1, 0.3), CellState::free) << "a point on the floor is no wall";
  EXPECT_EQ(stateAt(expected, 0.72, 1), CellState::free) << "nor is one on the ceiling";
  EXPECT_EQ(stateAt(expected, 3.4, 0), CellState::unknown) << "outside";
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"})
  {
    writeText(folder / "m.ply", plyOf(room, format));
    EXPECT_EQ(rasterIn(folder / "m.ply").cells, expected.cells) << format;
  }
  for (const std::string data : {"ascii", "binary", "binary_compressed"})
  {
    writeText(folder / "m.pcd", pcdOf(room, data));
    EXPECT_EQ(rasterIn(folder / "m.pcd").cells, expected.cells) << data;
  }
}

TEST(PointMaps, TakeTheHeightsThatAreAskedFor)
{
  const TemporaryFolder folder;
  writeText(folder / "m.ply", plyOf(roomPoints(), "ascii"));
  ReadingOptions reading;
  reading.min_height = 0.9;
  reading.max_height = 3;
  const auto ceiling = std::get<OccupancyRaster>(readMapSource(folder / "m.ply", reading));
  EXPECT_EQ(stateAt(ceiling, 0.72, 1), CellState::solid_wall);
  reading.min_height = 5;
  reading.max_height = 6;
  EXPECT_NE(mapErrorOf(folder / "m.ply", reading).find("they are at 0.00 to 2.50 m, see --heights"),
            std::string::npos);
  // All at one height, as those of a planar laser: whatever it is.
  Points flat = roomPoints();
  for (auto& point : flat) point[2] = 0;
  writeText(folder / "m.ply", plyOf(flat, "ascii"));
  EXPECT_EQ(stateAt(rasterIn(folder / "m.ply"), 1, 2.001), CellState::solid_wall);
}

TEST(PointMaps, PointsThatLieFarApartGetCoarserCells)
{
  const TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 200; ++i)
  {
    const std::string at = std::to_string(0.12 * i);
    rows += at + " 0\n" + at + " 4\n";
  }
  writeText(folder / "m.txt", rows);
  EXPECT_EQ(rasterIn(folder / "m.txt").frame.resolution, 0.2);
}

TEST(PointMaps, PlacesWithWallsToOneSideOnlyAreNotFree)
{
  const TemporaryFolder folder;
  // Two walls with a corridor between them, and a third one that is far from both.
  std::string rows = "x y z\n";
  for (int i = 0; i < 2000; ++i)
  {
    const std::string at = std::to_string(0.04 * i);
    rows += at + " 0 1\n" + at + " 3 1\n" + at + " 80 1\n";
  }
  writeText(folder / "m.txt", rows);
  const OccupancyRaster raster = rasterIn(folder / "m.txt");
  for (const float x : {10.0F, 40.0F, 70.0F})
  {
    EXPECT_EQ(stateAt(raster, x, 1.5F), CellState::free) << x;
    for (const float y : {4.5F, 30.0F, 45.0F, 78.5F})
      EXPECT_EQ(stateAt(raster, x, y), CellState::unknown) << x << " " << y;
  }
}

TEST(PointMaps, RowsThatAreFarApartStayLandmarks)
{
  const TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 300; ++i)
    rows += std::to_string(i % 20) + " " + std::to_string(i / 20) + " 0.1\n";
  writeText(folder / "m.txt", rows);
  EXPECT_EQ(std::get<FeatureMap>(readMapSource(folder / "m.txt")).features().size(), 300U);
  EXPECT_EQ(warningOfMapSource(folder / "m.txt"), "");
  // So do rows whose columns are named as those of landmarks.
  writeText(folder / "m.txt", "x y radius\n" + textOf(roomPoints()));
  EXPECT_TRUE(std::holds_alternative<FeatureMap>(readMapSource(folder / "m.txt")));
}

TEST(PointMaps, RowsThatAreCutOffOrNotAlikeAreRefused)
{
  const TemporaryFolder folder;
  const std::string rows = textOf(roomPoints());
  const auto refusal = [&](const std::string& text)
  {
    writeText(folder / "m.txt", text);
    std::string message = mapErrorOf(folder / "m.txt");
    EXPECT_EQ(message.rfind((folder / "m.txt").string() + ": ", 0), 0U) << message;
    EXPECT_EQ(messageOf<std::runtime_error>([&] { warningOfMapSource(folder / "m.txt"); }),
              message);
    return message.substr(message.find(": ") + 2);
  };
  const std::string cut = "its last row is cut off or damaged";
  for (const std::string last : {"1.5", "1.5 2", "1.5 2.", "1.5 -", "1.5 2.0 -", "1.5 2.0 1e"})
  {
    EXPECT_EQ(refusal(rows + last), cut) << last;
    EXPECT_EQ(refusal("x y z\n" + rows + last + "\n\n# the end\n"), cut) << last;
  }
  EXPECT_EQ(refusal("1.5 2.0\n" + rows), "line 2: no point of 2 numbers as the others");
  EXPECT_EQ(refusal("x y z\n1 2 3\n1 2\n" + rows), "line 3: no point of 3 numbers as the others");
  EXPECT_EQ(refusal("1 2 3\n1 nan 3\n" + rows), "line 2: no point of 3 numbers as the others");
}

TEST(PointMaps, ARowWithoutEndIsNoPoint)
{
  const TemporaryFolder folder;
  std::string row = textOf(roomPoints());
  std::replace(row.begin(), row.end(), '\n', ' ');
  for (const char* const name : {"m.txt", "m.csv"})
  {
    for (const std::string names : {"", "x y z\n"})
    {
      writeText(folder / name, names + row);
      const std::string message = mapErrorOf(folder / name);
      EXPECT_NE(message.find(" columns, more than 100"), std::string::npos) << message;
      EXPECT_NE(message.find(names.empty() ? "line 1: " : "line 2: "), std::string::npos);
    }
  }
}

// Rays from everywhere in such a map took minutes.
TEST(PointMaps, RefusePointsThatAreScatteredOverALargePlace)
{
  const TemporaryFolder folder;
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> place(-490, 490);
  Points points;
  for (int i = 0; i < 200000; ++i) points.push_back({place(generator), place(generator), 1});
  writeText(folder / "m.ply", plyOf(points, "binary_little_endian"));
  EXPECT_EQ(mapErrorOf(folder / "m.ply"),
            (folder / "m.ply").string() +
                ": 200000 points scattered over 981 m x 981 m, which make no walls");
}

TEST(PointMaps, RefuseHostileFilesInOneLine)
{
  const TemporaryFolder folder;
  const Points few = {{1, 2, 1}, {3, 4, 1}};
  const std::string little = "binary_little_endian";
  const auto nan = bytesOf(std::nanf(""), false);
  struct Case
  {
    const char* name;
    std::string bytes;
    const char* reason;
  };
  const std::vector<Case> cases = {
      {"m.ply", plyHeader("ascii", 4000000000U) + "3 0 1 2\n255 1 2 3\n", "cut off"},
      {"m.ply", plyHeader(little, 4000000000U) + std::string(50, '\0'), "cut off"},
      {"m.ply", plyHeader(little, 1) + "\xFF\1\1", "cut off"},
      {"m.ply",
       "ply\nformat ascii 1.0\nelement none 4000000000\nelement vertex 1\n"
       "property float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n",
       "damaged"},
      {"m.ply", plyHeader("ascii", 1).substr(0, 90), "its header"},
      {"m.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "end_header\n1 2\n",
       "have no z"},
      {"m.ply", "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "header"},
      {"m.ply", plyOf(Points(3, {1, std::nanf(""), 1}), little), "no point"},
      {"m.ply", plyOf({{1, 2, 1}, {3e9F, 4, 1}}, little), "shift the map's origin"},
      {"m.ply", plyOf({{1, 2, 1}, {300, 400, 1}}, little), "too few for a map"},
      {"m.ply", plyOf(few, little), "no free cell"},
      {"m.pcd", pcdHeader("binary", 4000000000U) + std::string(60, '\0'), "cut off"},
      {"m.pcd", pcdHeader("ascii", 4000000000U) + "1 2 3 4 5\n", "cut off"},
      {"m.pcd",
       pcdHeader("binary_compressed", 1000000U) + bytesOf(std::uint32_t{3}, false) +
           bytesOf(std::uint32_t{20000000}, false) + "\xE0\xFF\1",
       "damaged"},
      {"m.pcd",
       pcdHeader("binary_compressed", 1U) + bytesOf(std::uint32_t{3}, false) +
           bytesOf(std::uint32_t{20}, false) + "\xE0\xFF\1",
       "damaged"},
      {"m.pcd", pcdHeader("binary_compressed", 1U) + bytesOf(std::uint32_t{900}, false), "cut off"},
      {"m.pcd", pcdHeader("zipped", 1U), "known format"},
      {"m.pcd", pcdHeader("binary", 1U) + std::string(8, '\0') + nan + nan + nan, "no point"},
      {"m.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n",
       "unknown kind"},
      {"m.pcd", "VERSION 0.7\nFIELDS x y\nPOINTS 1\nDATA ascii\n1 2\n", "does not tell"},
      {"m.pcd", "%PDF-1.4\nnothing\n", "not a PCD file"},
      {"m.ply", "%PDF-1.4\nnothing\n", "not a PLY file"},
  };
  for (const Case& hostile : cases)
  {
    writeText(folder / hostile.name, hostile.bytes);
    const std::string message = mapErrorOf(folder / hostile.name);
    EXPECT_EQ(message.rfind((folder / hostile.name).string() + ": ", 0), 0U) << message;
    EXPECT_NE(message.find(hostile.reason), std::string::npos) << hostile.reason << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}
