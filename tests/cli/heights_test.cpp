// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// --heights chooses what counts as a wall, in every program that reads a log or a map.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "command_line.h"
#include "io/GroundTruth.h"
#include "support/cloud_log.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using mrpt::math::TPose2D;

constexpr std::size_t kCloudSteps = 40;
const std::string kMap = (kSources / "maps" / "office.simplemap").string();

/// The begin of the office's drive as clouds: its returns at 0.5 m, and nearer ones, as of things
/// that hang from the ceiling, at 1.2 m.
void writeClouds(const std::filesystem::path& path)
{
  const auto entries = solidEntries(kSources / "rawlogs" / "office.rawlog", kCloudSteps,
                                    [](const mrpt::obs::CObservation2DRangeScan& scan)
                                    {
                                      auto points = mrpt::maps::CSimplePointsMap::Create();
                                      addReturns(scan, 0.5F, 1, *points);
                                      addReturns(scan, 1.2F, 0.6F, *points);
                                      return cloudObservation(scan, points);
                                    });
  writeObjects(path, entries);
}

TEST(Heights, ofReferenceChooseWhatTheScansAre)
{
  const TemporaryFolder folder;
  writeClouds(folder / "drive.rawlog");
  std::vector<double> times;
  RawlogReader log(folder / "drive.rawlog");
  while (const auto step = log.next()) times.push_back(step->time);
  ASSERT_EQ(times.size(), kCloudSteps);
  const GroundTruth truth = GroundTruth::read(kSources / "rawlogs" / "office-truth.txt");
  const auto last = truth.at(kCloudSteps - 1, times.back());
  ASSERT_TRUE(last);
  Arguments reference = {"reference",
                         "--map",
                         kMap,
                         "--rawlog",
                         "drive.rawlog",
                         "--last",
                         std::to_string(last->x) + "," + std::to_string(last->y) + "," +
                             std::to_string(last->phi * 180 / M_PI),
                         "--out",
                         "truth.txt"};

  const auto before = listing(folder);
  const CommandResult usual = run(folder, "sigloc-eval", reference);
  EXPECT_EQ(usual.exit_code, 1) << "the nearest points are no walls of the map: " << usual.output;
  EXPECT_NE(usual.errors.find("drive.rawlog: only "), std::string::npos) << usual.errors;
  EXPECT_EQ(listing(folder), before);

  reference.insert(reference.end(), {"--heights", "0.2,0.9"});
  const CommandResult low = run(folder, "sigloc-eval", reference);
  ASSERT_EQ(low.exit_code, 0) << low.errors;
  const GroundTruth found = GroundTruth::read(folder / "truth.txt");
  for (std::size_t k = 0; k < kCloudSteps; ++k)
  {
    const auto expected = truth.at(k, times[k]);
    const auto pose = found.at(k, times[k]);
    ASSERT_TRUE(expected && pose) << k;
    EXPECT_LT(std::hypot(pose->x - expected->x, pose->y - expected->y), 0.1) << k;
  }
}

TEST(Heights, thatNoPointCanBeBetweenAreRefused)
{
  const TemporaryFolder folder;
  writeClouds(folder / "drive.rawlog");
  writeText(folder / "room.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n1 2 3\n");
  const auto before = listing(folder);
  for (const char* const heights : {"1.5,0.2", "1,1", "nan,1", "0,inf", "-1e9,0", "1", "a,b"})
  {
    for (const auto& [program, arguments] : std::vector<std::pair<std::string, Arguments>>{
             {"sigloc-map", {"build", "-i", "room.ply", "-o", "room.sigmap"}},
             {"sigloc-localize", {"--map", kMap, "--log", "drive.rawlog", "--out", "out"}},
             {"sigloc-eval",
              {"reference", "--map", kMap, "--rawlog", "drive.rawlog", "--last", "1,2,3", "--out",
               "truth.txt"}}})
    {
      Arguments all = arguments;
      all.insert(all.end(), {"--heights", heights});
      const CommandResult result = run(folder, program, all);
      EXPECT_EQ(result.exit_code, 1) << program << " " << heights;
      EXPECT_EQ(countLines(result.errors), 1) << result.errors;
      EXPECT_NE(result.errors.find("height"), std::string::npos) << result.errors;
      EXPECT_EQ(listing(folder), before) << program << " " << heights;
    }
  }
}
}  // namespace
}  // namespace sigloc
