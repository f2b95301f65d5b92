// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// sigloc-map check: whether a robot is found in a map, and where it is not.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "command_line.h"
#include "metres_text.h"
#include "picture_pixels.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

const Arguments kFew = {"--places", "60", "--scans", "3", "--drives", "4"};

CommandResult check(const TemporaryFolder& folder, const std::filesystem::path& map,
                    const std::string& out, const Arguments& more = {})
{
  Arguments arguments = {"check", map.string(), "--out", out};
  arguments.insert(arguments.end(), kFew.begin(), kFew.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run(folder, "sigloc-map", arguments);
}

/// The rows of a table without quotes, the first with the names left out.
std::vector<std::vector<double>> rowsOf(const std::string& csv)
{
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(field.empty() ? NAN : std::stod(field));
  }
  return rows;
}

/// A corridor of equal rooms as the simulator makes it, without furniture of its own in any.
void makeCorridor(const TemporaryFolder& folder)
{
  ASSERT_EQ(run(folder, "sigloc-simulate",
                {"--world", "corridor", "--seed", "5", "--metres", "5", "--out", "corridor"})
                .exit_code,
            0);
}

TEST(MapCheck, anOfficeIsToldToBeEasyInFilesThatAgree)
{
  const TemporaryFolder folder;
  const CommandResult result = check(folder, kOffice, "answer");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_NE(result.output.find("localized"), std::string::npos);
  const json summary = summaryOf(folder, "answer");
  EXPECT_GT(summary["recall_at_1"], 0.95);
  EXPECT_GT(summary["localized_share"], 0.7);
  const auto places = rowsOf(readBytes(folder / "answer/places.csv"));
  ASSERT_EQ(places.size(), summary["places"].get<std::size_t>());
  double localized = 0;
  double scans = 0;
  for (const auto& place : places)
  {
    scans += place[3];
    localized += place[5];
  }
  EXPECT_NEAR(localized / scans, summary["localized_share"].get<double>(), 1e-9);
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile((folder / "answer/check.png").string()));
  EXPECT_GT(pixelsLike(picture, mrpt::img::TColor(90, 186, 110)), 5000) << "always localized";
}

// A number stands where one scan is not enough.
TEST(MapCheck, noDriveIsOfZeroMetres)
{
  EXPECT_EQ(metresText(0), "<1");
  EXPECT_EQ(metresText(0.99), "<1");
  EXPECT_EQ(metresText(1), "1");
  EXPECT_EQ(metresText(2.6), "3");
  EXPECT_EQ(metresText(INFINITY), ">20");
}

TEST(MapCheck, asksAtAsManyPlacesAsItIsTold)
{
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, "sigloc-map",
                {"check", kOffice.string(), "--places", "150", "--scans", "1", "--drives", "0",
                 "-o", "answer"})
                .exit_code,
            0);
  EXPECT_EQ(summaryOf(folder, "answer")["places"], 150);
}

TEST(MapCheck, aMapWhoseNameIsNoUtf8IsCheckedAsOthers)
{
  const TemporaryFolder folder;
  std::filesystem::copy(kOffice, folder / "\xff.simplemap");
  const CommandResult result = check(folder, "\xff.simplemap", "answer");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(summaryOf(folder, "answer")["places"], 60);
}

TEST(MapCheck, equalSeedsGiveEqualLists)
{
  const TemporaryFolder folder;
  for (const char* const out : {"one", "two"}) ASSERT_EQ(check(folder, kOffice, out).exit_code, 0);
  ASSERT_EQ(check(folder, kOffice, "other", {"--seed", "2"}).exit_code, 0);
  for (const char* const name : {"places.csv", "twins.csv"})
  {
    const std::string bytes = readBytes(folder / (std::string("one/") + name));
    EXPECT_EQ(bytes, readBytes(folder / (std::string("two/") + name)));
    EXPECT_NE(bytes, readBytes(folder / (std::string("other/") + name)));
  }
}

TEST(MapCheck, roomsThatRepeatAreNamedAsTwins)
{
  const TemporaryFolder folder;
  makeCorridor(folder);
  ASSERT_EQ(check(folder, folder / "corridor/map.simplemap", "answer").exit_code, 0);
  const json corridor = summaryOf(folder, "answer");
  EXPECT_LT(corridor["localized_share"], 0.3);
  const auto twins = rowsOf(readBytes(folder / "answer/twins.csv"));
  ASSERT_GE(twins.size(), 10U);
  const auto places = rowsOf(readBytes(folder / "answer/places.csv"));
  for (const auto& pair : twins)
  {
    EXPECT_LE(pair[7], 3 * places.size()) << "more scans than were asked";
    EXPECT_GE(pair[8], 0);
    EXPECT_LE(pair[8], 1) << "a probability";
  }
  // Exact copies are apart along the corridor only, and look the same way.
  int copies = 0;
  for (std::size_t k = 0; k < 10; ++k)
  {
    const bool beside = std::abs(twins[k][2] - twins[k][5]) < 0.3;
    const bool same_heading = std::abs(std::remainder(twins[k][3] - twins[k][6], 360.0)) < 5;
    copies += beside && same_heading ? 1 : 0;
  }
  EXPECT_GE(copies, 8);
}

TEST(MapCheck, asksAtGivenPosesAndWithAGivenLaser)
{
  const TemporaryFolder folder;
  writeText(folder / "poses.txt", "# x y deg\n3 6 0\n10 6 180\n");
  const std::string sick = std::string(SIGLOC_SHARE_FOLDER) + "/check-sick.ini";
  const CommandResult result = check(folder, kSources / "maps/office.gridmap.gz", "answer",
                                     {"--at", "poses.txt", "--laser", sick});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto places = rowsOf(readBytes(folder / "answer/places.csv"));
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[1][0], 10);
  EXPECT_EQ(places[1][2], -180);
}

/// Writes the map of a room of 10 m x 8 m that a robot has crossed. In every second scan the robot
/// sees each wall `off` [m] farther away, and a passer-by in `passer` of its 181 beams.
void writeRoom(const std::filesystem::path& file, double off, std::size_t passer)
{
  mrpt::maps::CSimpleMap map;
  for (std::size_t k = 0; k < 40; ++k)
  {
    const mrpt::math::TPose2D pose(1.5 + 0.15 * static_cast<double>(k), 4, 0);
    const auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->aperture = static_cast<float>(M_PI);
    scan->maxRange = 30;
    scan->resizeScan(181);
    for (std::size_t i = 0; i < 181; ++i)
    {
      const double angle = -M_PI / 2 + static_cast<double>(i) * M_PI / 180;
      const double side = 4 / std::max(1e-9, std::abs(std::sin(angle)));
      double range = std::min((10 - pose.x) / std::max(1e-9, std::cos(angle)), side);
      if (k % 2 == 1) range = i < passer ? 1.0 : range + off;
      scan->setScanRange(i, static_cast<float>(range));
      scan->setScanRangeValidity(i, true);
    }
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scan);
    map.insert(
        mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(mrpt::math::TPose3D(pose))),
        frame);
  }
  ASSERT_TRUE(map.saveToFile(file.string()));
}

TEST(MapCheck, aMapsOwnScansTellItsErrors)
{
  const TemporaryFolder folder;
  writeRoom(folder / "exact.simplemap", 0, 0);
  writeRoom(folder / "blurred.simplemap", 0.1, 0);
  writeRoom(folder / "visited.simplemap", 0, 18);
  const auto errorsIn = [&](const std::string& name)
  {
    EXPECT_EQ(check(folder, folder / (name + ".simplemap"), name).exit_code, 0);
    return summaryOf(folder, name)["laser"];
  };
  const json exact = errorsIn("exact");
  EXPECT_LT(exact["map_sigma_m"], 0.03);
  EXPECT_EQ(exact["clutter_share"], 0);
  EXPECT_GT(errorsIn("blurred")["map_sigma_m"], 0.05);
  // A tenth of the beams, four times; at most 0.4.
  EXPECT_NEAR(errorsIn("visited")["clutter_share"].get<double>(), 0.4, 0.05);
}

TEST(MapCheck, anOldMapIsHarder)
{
  const TemporaryFolder folder;
  const std::string old = std::string(SIGLOC_SHARE_FOLDER) + "/check-old-map.ini";
  ASSERT_EQ(check(folder, kOffice, "new").exit_code, 0);
  ASSERT_EQ(check(folder, kOffice, "old", {"--laser", old}).exit_code, 0);
  EXPECT_LT(summaryOf(folder, "old")["localized_share"].get<double>(),
            summaryOf(folder, "new")["localized_share"].get<double>() - 0.2);
}

TEST(MapCheck, badInputIsRefusedInOneLine)
{
  const TemporaryFolder folder;
  std::string marks;
  for (int i = 0; i < 12; ++i) marks += std::to_string(i) + " " + std::to_string(i * i) + "\n";
  writeText(folder / "marks.csv", marks);
  writeText(folder / "bad.ini", "[laser]\nbeems = 3\n");
  writeText(folder / "none.ini", "[lidar]\n");
  writeText(folder / "poses.txt", "1 2\n");
  std::filesystem::create_directory(folder / "mine");
  writeText(folder / "mine/places.csv", "my own\n");
  const auto refused = [&](const Arguments& more, const std::string& why)
  {
    Arguments arguments = {"check"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run(folder, "sigloc-map", arguments);
    EXPECT_EQ(result.exit_code, 1) << why;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find(why), std::string::npos) << result.errors;
  };
  const std::string office = kOffice.string();
  refused({(folder / "marks.csv").string()}, "landmarks alone");
  refused({office, "--laser", "bad.ini"}, "did you mean 'beams'");
  refused({office, "--laser", "none.ini"}, "no section [laser]");
  refused({office, "--laser", "missing.ini"}, "missing.ini");
  refused({office, "--laser", "mine"}, "mine: is a folder");
  std::filesystem::resize_file(folder / "bad.ini", std::uintmax_t{1} << 32U);  // a hole
  refused({office, "--laser", "bad.ini"}, "more than 1 MB");
  refused({office, "--at", "poses.txt"}, "row 1");
  refused({office, "--out", "mine"}, "places.csv");
  EXPECT_EQ(readBytes(folder / "mine/places.csv"), "my own\n");
  writeText(folder / "mine/summary.json", "{\"program\": 5}");
  refused({office, "--out", "mine"},
          "mine: holds summary.json, but is no folder of an earlier run");
  refused({office, "--out", "none.ini"}, "none.ini: is no folder; not overwritten");
  EXPECT_EQ(readBytes(folder / "none.ini"), "[lidar]\n");
  refused({office, "--out", "/proc/none", "--places", "1", "--scans", "1", "--drives", "0"},
          "sigloc-map: /proc/none: ");
}

TEST(MapCheck, posesThatAreNoneAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  writeText(folder / "words", "# x y deg\n1 1 0\n1 one 0\n");
  writeText(folder / "far", "3 6 0\n3000 6 0\n");
  for (const auto& [name, why] :
       {std::pair("pipe", "is no regular file"), std::pair("words", "row 3 is not `x y deg`"),
        std::pair("far", "row 2 is off the map")})
  {
    const CommandResult result = check(folder, kOffice, "out", {"--at", name});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find(why), std::string::npos) << result.errors;
  }
}
}  // namespace
}  // namespace sigloc
