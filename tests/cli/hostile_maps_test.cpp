// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Well-formed files whose values nothing can have written in good faith. A checksum does not help
// against them.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class T>
void put(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

struct WrittenFeature
{
  std::uint8_t type = 1, side = 0, start_seen = 1, end_seen = 1;
  double x = 0, y = 0, direction = 0, size = 4, xx = 1e-4, xy = 0, yy = 1e-4;
  double direction_variance = 1e-4, size_variance = 1e-4;
  std::int32_t label = -1;
  std::uint32_t sightings = 1;
  std::int32_t parent = -1;
};

/// A `.sigmap` of a walled room, as bytes that a test spoils.
struct WrittenMap
{
  std::uint32_t text_length = 0;
  double error[4] = {.02, .00224, .1, .01};
  std::vector<WrittenFeature> features = {
      {1, 0, 1, 1, 3, 0, 0, 4}, {1, 0, 1, 1, 0, 2, 1.57, 6}, {1, 0, 1, 1, 0, -2, -1.57, 6}};
  std::uint32_t announced = 3;
  double x = 0, y = 0, resolution = 0.05;
  std::uint32_t width = 10, height = 10;
  double free_area = 80 * 0.0025;
  std::uint32_t wall_cells = 20;
  std::size_t written_cells = 100;
  std::uint8_t state = 1;  // of the cells that are no wall
};

std::string bodyOf(const WrittenMap& map)
{
  std::string body = "sigloc-map\n\3";
  for (int i = 0; i < 3; ++i) put(body, map.text_length);
  for (const double value : map.error) put(body, value);
  put(body, map.announced);
  for (const WrittenFeature& f : map.features)
  {
    for (const std::uint8_t b : {f.type, f.side, f.start_seen, f.end_seen}) put(body, b);
    for (const double v : {f.x, f.y, f.direction, f.size, f.xx, f.xy, f.xy, f.yy,
                           f.direction_variance, f.size_variance})
    {
      put(body, v);
    }
    put(body, f.label);
    put(body, f.sightings);
    put(body, f.parent);
  }
  put(body, std::uint8_t{1});
  for (const double v : {map.x, map.y, map.resolution}) put(body, v);
  put(body, map.width);
  put(body, map.height);
  put(body, map.free_area);
  put(body, map.wall_cells);
  const std::size_t n = map.written_cells;
  const std::size_t walls = std::min<std::size_t>(n, 20);
  body += std::string(n, '\10') + std::string(2 * n, '\0') + std::string(walls, '\2') +
          std::string(n - walls, static_cast<char>(map.state));
  return body;
}

void writePacked(const std::filesystem::path& path, const std::string& bytes)
{
  gzFile file = gzopen(path.c_str(), "wb1");
  ASSERT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
            static_cast<int>(bytes.size()));
  ASSERT_EQ(gzclose(file), Z_OK);
}

struct HostileMap
{
  const char* name;
  std::function<void(WrittenMap&)> spoil;
  const char* reason;
};

std::vector<HostileMap> hostileMaps()
{
  using M = WrittenMap;
  return {
      {"no_end_of_wall", [](M& m) { m.features[1].size = 1e8; }, "feature 1 has the size"},
      {"negative_wall", [](M& m) { m.features[1].size = -5; }, "has the size"},
      {"wall_of_no_number", [](M& m) { m.features[2].size = kNan; }, "has the size"},
      {"endless_wall", [](M& m) { m.features[2].size = kInf; }, "has the size"},
      {"round_of_a_planet",
       [](M& m)
       {
         m.features.assign(100, WrittenFeature{2, 0, 0, 0, 1, 1, 0, 9e3});
         m.announced = 100;
       },
       "m long together"},
      {"walls_without_end",
       [](M& m)
       {
         m.features.assign(200, WrittenFeature{1, 0, 0, 0, 1, 1, 0, 9e3});
         m.announced = 200;
       },
       "m long together"},
      {"crowd",
       [](M& m)
       {
         m.features.assign(1001, WrittenFeature{0, 0, 0, 0, 1, 1, 0, 0});
         m.announced = 1001;
       },
       "feature 1000 has more than 1000 others within 5 m x 5 m"},
      {"turned_beyond", [](M& m) { m.features[0].direction = 1e300; }, "has the direction"},
      {"turned_nowhere", [](M& m) { m.features[0].direction = kNan; }, "has the direction"},
      {"place_nowhere", [](M& m) { m.features[0].x = kNan; }, "has the position"},
      {"place_endless", [](M& m) { m.features[0].y = -kInf; }, "has the position"},
      {"place_far", [](M& m) { m.features[0].y = 2e5; }, "100000 m"},
      {"wall_far",
       [](M& m)
       {
         m.features[0].x = 99900;
         m.features[0].direction = 1.57;
         m.features[0].size = 300;
       },
       "100000 m"},
      {"variance_huge", [](M& m) { m.features[0].xx = 1e300; }, "covariance"},
      {"variance_negative", [](M& m) { m.features[0].yy = -1e-4; }, "covariance"},
      {"not_semidefinite", [](M& m) { m.features[0].xy = 1; }, "covariance"},
      {"turn_variance", [](M& m) { m.features[0].direction_variance = kInf; }, "covariance"},
      {"size_variance", [](M& m) { m.features[0].size_variance = kNan; }, "covariance"},
      {"parent_beyond", [](M& m) { m.features[0].parent = 0x7ffffff0; }, "has the parent"},
      {"parent_below", [](M& m) { m.features[0].parent = -2; }, "has the parent"},
      {"type_unknown", [](M& m) { m.features[0].type = 200; }, "no known type"},
      {"side_unknown", [](M& m) { m.features[0].side = 9; }, "no known side"},
      {"error_nan", [](M& m) { m.error[0] = kNan; }, "a map error"},
      {"error_endless", [](M& m) { m.error[2] = kInf; }, "a map error"},
      {"error_negative", [](M& m) { m.error[3] = -1; }, "a map error"},
      {"cells_too_fine", [](M& m) { m.resolution = 1e-300; }, "cells of"},
      {"cells_nan", [](M& m) { m.resolution = kNan; }, "cells of"},
      {"cells_too_many", [](M& m) { m.width = m.height = 30000; }, "a raster of 30000 x 30000"},
      {"cells_overflow", [](M& m) { m.width = m.height = 0xFFFFFFFFU; }, "a raster of"},
      {"cells_missing", [](M& m) { m.width = m.height = 19000; }, "truncated"},
      {"cells_none", [](M& m) { m.width = 0; }, "a raster of 0"},
      {"cells_of_no_state", [](M& m) { m.state = 77; }, "no known state"},
      {"raster_nowhere", [](M& m) { m.x = kNan; }, "100000 m"},
      {"free_nan", [](M& m) { m.free_area = kNan; }, "free area"},
      {"free_of_others", [](M& m) { m.free_area = 1e6; }, "free area"},
      {"walls_of_others", [](M& m) { m.wall_cells = 5; }, "wall cells"},
      {"features_missing", [](M& m) { m.announced = 0xFFFFFFF0U; }, "feature 3 has"},
      {"text_of_four_gigabytes", [](M& m) { m.text_length = 0xFFFFFFF0U; }, "a text of"},
  };
}

/// Runs a program that may use 20 s of processor and 1 GB of address space, libraries included.
CommandResult runBounded(const TemporaryFolder& folder, const std::vector<std::string>& arguments)
{
  return runShell(folder,
                  "ulimit -t 20; ulimit -v 1000000; " + commandLine("sigloc-map", arguments));
}

TEST(HostileMap, TheSameBytesUnspoiltAreAMap)
{
  const TemporaryFolder folder;
  writePacked(folder / "good.sigmap", bodyOf({}));
  const auto result = runBounded(folder, {"info", "good.sigmap"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
}

TEST(HostileMap, IsRefusedInOneLineWithFileAndReason)
{
  const TemporaryFolder folder;
  for (const HostileMap& hostile : hostileMaps())
  {
    WrittenMap map;
    hostile.spoil(map);
    const std::string name = std::string(hostile.name) + ".sigmap";
    writePacked(folder / name, bodyOf(map));
    const auto before = listing(folder);
    const auto result = runBounded(folder, {"info", name});
    EXPECT_EQ(result.exit_code, 1) << name;
    EXPECT_EQ(countLines(result.errors), 1) << name << ": " << result.errors;
    EXPECT_NE(result.errors.find(name + ": "), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find(hostile.reason), std::string::npos) << result.errors;
    EXPECT_EQ(listing(folder), before) << name;
  }
}

TEST(HostileMap, WhatItTellsOfItsSourceStaysOnAShortLine)
{
  const TemporaryFolder folder;
  std::string source;
  put(source, std::uint32_t{60000});
  source += "\x1b[31m\nfeatures: 99\n\xff";
  source.resize(4 + 60000, 'x');
  std::string body = bodyOf({});
  constexpr std::size_t kHead = 12;
  body.replace(kHead, 4, source);
  writePacked(folder / "\xff.sigmap", body);
  const auto told = runBounded(folder, {"info", "\xff.sigmap"});
  EXPECT_EQ(told.exit_code, 0) << told.errors;
  EXPECT_EQ(told.output.find("features: 99\n"), std::string::npos);
  EXPECT_EQ(told.output.find('\x1b'), std::string::npos);
  EXPECT_NE(told.output.find("\nsource: "), std::string::npos);
  EXPECT_LT(told.output.size(), 2000U);
  const auto as_json = runBounded(folder, {"info", "--json", "\xff.sigmap"});
  EXPECT_EQ(as_json.exit_code, 0) << as_json.errors;
  EXPECT_EQ(nlohmann::json::parse(as_json.output)["features"], 3);
}

TEST(HostileMap, LandmarksInOnePlaceAreRefused)
{
  const TemporaryFolder folder;
  std::string rows;
  for (int i = 0; i < 1000; ++i) rows += "1,2\n";
  writeText(folder / "crowd.csv", "x,y\n" + rows + "6,2\n");
  const Arguments build = {"build", "-i", "crowd.csv", "-o", "m.sigmap"};
  EXPECT_EQ(runBounded(folder, build).exit_code, 0);
  writeText(folder / "crowd.csv", "x,y\n" + rows + "1.5,2.5\n");
  const auto result = runBounded(folder, build);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("crowd.csv: line 1002: a landmark that has more than 1000 others"),
            std::string::npos)
      << result.errors;
}

TEST(HostileMap, AMillionLandmarksAreHeldOnce)
{
  const TemporaryFolder folder;
  std::string rows = "x,y\n";
  for (int i = 0; i < 1000000; ++i)
    rows += std::to_string(i % 1000) + "," + std::to_string(i / 1000) + "\n";
  writeText(folder / "many.csv", rows);
  const auto result = runBounded(folder, {"build", "-i", "many.csv", "-o", "m.sigmap"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  rusage usage = {};
  getrusage(RUSAGE_CHILDREN, &usage);
  EXPECT_LT(usage.ru_maxrss, 300000) << "[kB]";
}

TEST(HostileMap, DecimalCommasAreNotTakenForColumns)
{
  const TemporaryFolder folder;
  writeText(folder / "commas.csv", "1,5;2,5\n");
  const auto result = runBounded(folder, {"build", "-i", "commas.csv", "-o", "m.sigmap"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("commas.csv: line 1"), std::string::npos) << result.errors;
}
}  // namespace
}  // namespace sigloc
