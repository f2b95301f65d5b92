// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "io/maps/ros_map_yaml.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
const std::string kThresholds = "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

std::string yamlWith(const std::string& more, const std::string& origin = "[1.0, -2.0, 0.0]",
                     const std::string& thresholds = kThresholds)
{
  return "image: m.pgm\nresolution: 0.1\norigin: " + origin + "\n" + thresholds + more;
}

std::string pgm(const std::string& size, const std::vector<int>& pixels)
{
  std::string image = "P5\n# made by hand\n" + size + "\n255\n";
  for (const int pixel : pixels) image.push_back(static_cast<char>(pixel));
  return image;
}

std::vector<CellState> rowOf(const TemporaryFolder& folder, const std::vector<int>& pixels,
                             const std::string& yaml)
{
  writeText(folder / "m.pgm", pgm(std::to_string(pixels.size()) + " 1", pixels));
  writeText(folder / "m.yaml", yaml);
  return std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells;
}

constexpr CellState kFree = CellState::free;
constexpr CellState kWall = CellState::wall;
constexpr CellState kSolid = CellState::solid_wall;
constexpr CellState kUnknown = CellState::unknown;
}  // namespace

TEST(RosMap, ReadsEachModeByTheMapServersRules)
{
  using Cells = std::vector<CellState>;
  const TemporaryFolder folder;
  EXPECT_EQ(rowOf(folder, {0, 80, 120, 205, 254}, yamlWith("negate: 0\n")),
            (Cells{kSolid, kSolid, kUnknown, kUnknown, kFree}));
  EXPECT_EQ(rowOf(folder, {0, 135, 205, 254}, yamlWith("negate: 1\n")),
            (Cells{kFree, kUnknown, kSolid, kSolid}));
  // Between the thresholds: 54 %, 42 % and 9 % occupied.
  EXPECT_EQ(rowOf(folder, {0, 142, 156, 194, 254}, yamlWith("mode: scale\nnegate: false\n")),
            (Cells{kSolid, kUnknown, kUnknown, kFree, kFree}));
  EXPECT_EQ(rowOf(folder, {100, 60, 50, 10, 0, 101, 255}, yamlWith("mode: raw\n")),
            (Cells{kSolid, kWall, kUnknown, kFree, kFree, kUnknown, kUnknown}));
}

TEST(RosMap, RowsThatAreAsTheFirstAreInTheMap)
{
  const TemporaryFolder folder;
  writeText(folder / "m.yaml", yamlWith(""));
  const std::vector<CellState> stripes = {kSolid, kFree, kUnknown};
  const auto cells_of = [&](int rows, const std::vector<int>& pixels)
  {
    writeText(folder / "m.pgm", pgm("3 " + std::to_string(rows), pixels));
    return std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells;
  };
  const auto repeated = [](const std::vector<CellState>& row, int times)
  {
    std::vector<CellState> cells;
    for (; times > 0; --times) cells.insert(cells.end(), row.begin(), row.end());
    return cells;
  };
  EXPECT_EQ(cells_of(3, {0, 254, 205, 0, 254, 205, 0, 254, 205}), repeated(stripes, 3));
  // The last row of the image is the lowest.
  std::vector<CellState> two_kinds = {kFree, kFree, kFree};
  for (const CellState state : repeated(stripes, 2)) two_kinds.push_back(state);
  EXPECT_EQ(cells_of(3, {0, 254, 205, 0, 254, 205, 254, 254, 254}), two_kinds);
}

TEST(RosMap, NeverSeenStaysUnknownAndIsToldOf)
{
  const TemporaryFolder folder;
  const std::string loose = "occupied_thresh: 0.65\nfree_thresh: 0.25\n";
  const auto cells = rowOf(folder, {0, 205, 204, 254}, yamlWith("", "[0, 0, 0]", loose));
  EXPECT_EQ(cells[1], kUnknown);
  EXPECT_EQ(cells[2], kFree);
  EXPECT_NE(warningOfMapSource(folder / "m.yaml").find("205"), std::string::npos);
  rowOf(folder, {0, 205, 254}, yamlWith(""));
  EXPECT_EQ(warningOfMapSource(folder / "m.yaml"), "");
}

TEST(RosMap, NeverSeenStaysUnknownInInvertedColoursToo)
{
  const TemporaryFolder folder;
  const std::string loose = "occupied_thresh: 0.65\nfree_thresh: 0.25\n";
  const std::string negate = "negate: 1\n";
  const auto cells = rowOf(folder, {255, 50, 51, 1, 205}, yamlWith(negate, "[0, 0, 0]", loose));
  EXPECT_EQ(cells, (std::vector<CellState>{kSolid, kUnknown, kFree, kFree, kSolid}));
  EXPECT_NE(warningOfMapSource(folder / "m.yaml").find("free_thresh would make free"),
            std::string::npos);
  EXPECT_NE(warningOfMapSource(folder / "m.yaml").find("shade 50"), std::string::npos);
  // Here the map server finds by itself that it is unknown.
  EXPECT_EQ(rowOf(folder, {255, 50, 1}, yamlWith(negate))[1], kUnknown);
  EXPECT_EQ(warningOfMapSource(folder / "m.yaml"), "");
  // Here there is nothing of that shade.
  rowOf(folder, {255, 51, 1, 205}, yamlWith(negate, "[0, 0, 0]", loose));
  EXPECT_EQ(warningOfMapSource(folder / "m.yaml"), "");
}

TEST(RosMap, NeverSeenStaysUnknownInScaleWhateverTheThresholds)
{
  const TemporaryFolder folder;
  for (const std::string threshold : {"0.1", "0.196", "0.25"})
  {
    const std::string thresholds = "occupied_thresh: 0.65\nfree_thresh: " + threshold + "\n";
    for (const int unknown : {205, 50})
    {
      const std::string more =
          "mode: scale\nnegate: " + std::to_string(unknown == 50 ? 1 : 0) + "\n";
      const auto cells = rowOf(folder, {0, unknown, 255}, yamlWith(more, "[0, 0, 0]", thresholds));
      EXPECT_EQ(cells[1], kUnknown) << threshold << ' ' << unknown;
      EXPECT_NE(warningOfMapSource(folder / "m.yaml").find(std::to_string(unknown)),
                std::string::npos);
    }
  }
}

TEST(RosMap, ATurnedOriginTurnsTheCells)
{
  const TemporaryFolder folder;
  constexpr std::uint32_t kWidth = 60;
  constexpr std::uint32_t kHeight = 40;
  std::vector<int> pixels(kWidth * kHeight, 254);
  // A wall from the left border, 3 cells thick, and a post.
  for (std::uint32_t y = 18; y <= 20; ++y)
  {
    for (std::uint32_t x = 0; x < 30; ++x) pixels[y * kWidth + x] = 0;
  }
  for (std::uint32_t y = 5; y <= 8; ++y)
  {
    for (std::uint32_t x = 50; x <= 53; ++x) pixels[y * kWidth + x] = 0;
  }
  writeText(folder / "m.pgm", pgm("60 40", pixels));
  for (const double yaw : {0.4, -2.0, M_PI / 2, M_PI})
  {
    writeText(folder / "m.yaml", yamlWith("", "[1.0, -2.0, " + std::to_string(yaw) + "]"));
    const auto raster = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
    const mrpt::math::TPose2D map_from_image(1.0, -2.0, yaw);
    const auto stateAt = [&](double column, double row_from_top)
    {
      const auto at = map_from_image.composePoint({0.1 * column, 0.1 * (kHeight - row_from_top)});
      const auto x = static_cast<std::size_t>((at.x - raster.frame.origin.x) / 0.1);
      const auto y = static_cast<std::size_t>((at.y - raster.frame.origin.y) / 0.1);
      return raster.cells.at(y * raster.frame.width + x);
    };
    EXPECT_EQ(stateAt(15, 19.5), kSolid) << yaw;
    EXPECT_EQ(stateAt(52, 7), kSolid) << yaw;
    EXPECT_EQ(stateAt(45, 30), kFree) << yaw;
    EXPECT_EQ(stateAt(15, 25), kFree) << yaw;
    EXPECT_EQ(stateAt(15, 12), kFree) << yaw;
  }
}

TEST(RosMap, ReadsPngWithColoursAndAlpha)
{
  const TemporaryFolder folder;
  const auto write = [&](const char* name, unsigned format, const std::vector<png_byte>& pixels)
  {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = 3;
    image.height = 1;
    image.format = format;
    ASSERT_NE(
        png_image_write_to_file(&image, (folder / name).c_str(), 0, pixels.data(), 0, nullptr), 0);
  };
  write("gray.png", PNG_FORMAT_GRAY, {0, 205, 254});
  write("rgba.png", PNG_FORMAT_RGBA, {0, 0, 0, 255, 205, 205, 205, 255, 254, 254, 254, 255});
  for (const std::string name : {"gray.png", "rgba.png"})
  {
    std::string yaml = yamlWith("");
    yaml.replace(yaml.find("m.pgm"), 5, name);
    writeText(folder / "m.yaml", yaml);
    const auto raster = std::get<OccupancyRaster>(readMapSource(folder / "m.yaml"));
    EXPECT_EQ(raster.cells, (std::vector<CellState>{kSolid, kUnknown, kFree})) << name;
    // With an alpha the map server finds the shade of "never seen" lighter, and free.
    EXPECT_EQ(warningOfMapSource(folder / "m.yaml").empty(), name == "gray.png");
  }
}

// Its rows come in seven passes.
TEST(RosMap, ReadsInterlacedPng)
{
  const TemporaryFolder folder;
  writeText(
      folder / "i.png",
      std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\3\0\0\0\2\x08\0\0\0\1", 29) +
          std::string("\317\030\011\120\000\000\000\025\111\104\101\124\170\001\001\012\000\365"
                      "\377\000\000\000\376\000\315\000\376\376\000\017\363\003\310\245\040\311"
                      "\022\000\000\000\000\111\105\116\104\256\102\140\202",
                      49));
  std::string yaml = yamlWith("");
  yaml.replace(yaml.find("m.pgm"), 5, "i.png");
  writeText(folder / "m.yaml", yaml);
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells,
            (std::vector<CellState>{kFree, kFree, kSolid, kSolid, kUnknown, kFree}));
}

TEST(RosMap, ReadsTheFormsOfYamlThatToolsWrite)
{
  const auto header = detail::parseRosMapYaml(
      "%YAML: 1.2\n---\n# a comment\nimage: \"maps/a b.pgm\"   # here\r\nmode: scale\n"
      "resolution: 5.0e-2\norigin:\n  - -1.5\n- 2\n  - 0.25\nnegate: 0\n"
      "cells:\n  colour: red\noccupied_thresh: 0.65\nfree_thresh: .196\n...\nrubbish\n",
      "m.yaml");
  EXPECT_EQ(header.image, "maps/a b.pgm");
  EXPECT_EQ(header.mode, detail::RosMapMode::scale);
  EXPECT_EQ(header.resolution, 0.05);
  EXPECT_EQ(header.origin.x, -1.5);
  EXPECT_EQ(header.origin.phi, 0.25);
  EXPECT_EQ(header.free_threshold, 0.196);
}

TEST(RosMap, TakesAMarkOfUtf8AndATextThatEndsWithItsLastPixel)
{
  const TemporaryFolder folder;
  writeText(folder / "m.pgm", "P2\n3 1\n255\n0 0 254");
  writeText(folder / "m.yaml", "\xEF\xBB\xBF" + yamlWith("negate: 0\n"));
  EXPECT_EQ(std::get<OccupancyRaster>(readMapSource(folder / "m.yaml")).cells,
            (std::vector<CellState>{kSolid, kSolid, kFree}));
}

TEST(RosMap, RefusesHostileFilesInOneLine)
{
  const TemporaryFolder folder;
  writeText(folder / "m.pgm", pgm("3 1", {0, 205, 254}));
  const std::string sound = yamlWith("");
  const auto with = [&](const std::string& text, const std::string& instead)
  {
    std::string yaml = sound;
    return yaml.replace(yaml.find(text), text.size(), instead);
  };
  std::string items;
  for (int i = 0; i < 10000; ++i) items += "- ";
  const std::vector<std::string> hostile = {
      "a: 1\n%\xff\n",
      std::string(20000, '['),
      items,
      std::string(1U << 20U, 'a') + ": 1\n",
      sound + "more: " + std::string(70000, 'x'),
      with("m.pgm", "/dev/zero"),
      with("m.pgm", "."),
      with("m.pgm", "m.yaml"),
      with("m.pgm", "&a [*a, *a]"),
      with("0.1", "1e999"),
      with("[1.0, -2.0, 0.0]", "[1.0, -2.0]"),
      with("[1.0, -2.0, 0.0]", "[1.0, -2.0, 1e300]"),
      with("[1.0, -2.0, 0.0]", "{x: 1}"),
      with("free_thresh: 0.196", "free_thresh: {}"),
      sound + "negate: maybe\n",
      sound + "resolution: 0.5\n",
      with("resolution: 0.1", "resolution: [0.1]"),
      with("m.pgm", "[m.pgm]"),
      sound + "mode: [raw]x\n",
      std::string("image: m.pgm\n\0", 14) + sound,
      "\x1f\x8b\x08 no yaml at all",
  };
  for (const std::string& yaml : hostile)
  {
    writeText(folder / "m.yaml", yaml);
    const std::string message = mapErrorOf(folder / "m.yaml");
    EXPECT_EQ(message.rfind((folder / "m.yaml").string() + ": ", 0), 0U)
        << yaml.substr(0, 60) << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

// It fits when it lies along the axes; turned, its box has 2.4e9 cells.
TEST(RosMap, AThinImageThatIsTurnedIsJudgedBeforeItsBoxIsFilled)
{
  const TemporaryFolder folder;
  std::string image = "P5\n70000 4\n255\n" + std::string(280000, '\xfe');
  image.replace(image.size() - 100, 50, 50, '\0');
  writeText(folder / "m.pgm", image);
  writeText(folder / "m.yaml", yamlWith("", "[0, 0, 0.785]"));
  EXPECT_EQ(mapErrorOf(folder / "m.yaml"), (folder / "m.yaml").string() +
                                               ": a raster of 49521 x 49481 cells, not of 1 to "
                                               "4e+08");
}

TEST(RosMap, RefusesHostilePictures)
{
  const TemporaryFolder folder;
  writeText(folder / "m.yaml", yamlWith(""));
  const std::string png_head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20\x08\6\0\0\0",
                             29);
  for (const std::string& picture :
       {std::string("P5\n4 3\n255\n\x01"), std::string("P5\n20000 20000\n255\n\x01"),
        std::string("P5\n99999999 99999999\n255\n\x01"), std::string("P5\n-4 3\n255\n"),
        std::string("P2\n2 1\n255\n1 300\n"), std::string("P5\n4 3\n0\n"), std::string("P5 #"),
        std::string("P6\n1 1\n255\nabc"), std::string("\x89PNG"), png_head, std::string("BM")})
  {
    writeText(folder / "m.pgm", picture);
    const std::string message = mapErrorOf(folder / "m.yaml");
    const std::string image = (folder / "m.pgm").string();
    EXPECT_EQ(message.rfind((folder / "m.yaml").string() + ": its image " + image + ": ", 0), 0U)
        << message;
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1000000) << "[kB]: nothing was allocated for what was announced";
}

TEST(RosMap, AMissingImageIsToldWithTheMapThatNamesIt)
{
  const TemporaryFolder folder;
  writeText(folder / "m.yaml", yamlWith(""));
  const std::string expected = (folder / "m.yaml").string() + ": its image " +
                               (folder / "m.pgm").string() + ": no such file";
  const auto path = folder / "m.yaml";
  const std::string hint = "; put it there, or name another in the line 'image:'";
  EXPECT_EQ(mapErrorOf(path), expected + hint);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { buildMapFromFile(path, {}, {}); }),
            expected + hint);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { filesOfMapSource(path); }), expected + hint);
  writeText(folder / "floor_2.png", "renamed");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { filesOfMapSource(path); }),
            expected + "; did you mean 'floor_2.png'?");
  writeText(folder / "m.pgn", pgm("3 1", {0, 205, 254}));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { filesOfMapSource(path); }),
            expected + "; did you mean 'm.pgn'?");
}

TEST(RosMap, LoadingLeavesTheHostsOutputAlone)
{
  const TemporaryFolder folder;
  writeText(folder / "m.pgm", pgm("3 1", {0, 205, 254}));
  writeText(folder / "m.yaml", yamlWith(""));
  writeText(folder / "bad.yaml", "hello: [1, 2\n");
  struct stat before[2] = {};
  for (const int k : {0, 1}) ASSERT_EQ(fstat(STDOUT_FILENO + k, &before[k]), 0);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  struct stat captured = {};
  fstat(STDOUT_FILENO, &captured);
  std::vector<std::thread> threads;
  std::vector<int> swapped(4, 0);
  for (std::size_t t = 0; t < swapped.size(); ++t)
  {
    threads.emplace_back(
        [&, t]
        {
          for (int k = 0; k < 50; ++k)
          {
            mapErrorOf(folder / (k % 2 == 0 ? "m.yaml" : "bad.yaml"));
            struct stat now = {};
            fstat(STDOUT_FILENO, &now);
            if (now.st_ino != captured.st_ino) ++swapped[t];
          }
        });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(swapped, std::vector<int>(4, 0));
  for (const int k : {0, 1})
  {
    struct stat after = {};
    ASSERT_EQ(fstat(STDOUT_FILENO + k, &after), 0);
    EXPECT_EQ(after.st_ino, before[k].st_ino);
  }
}
