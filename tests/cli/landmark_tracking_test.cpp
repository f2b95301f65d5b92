// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

TEST(Localize, followsARobotThatSeesLandmarksOnly)
{
  const TemporaryFolder folder;
  const CommandResult made = run(
      folder, "sigloc-simulate",
      {"--world", "points", "--points", "400", "--seed", "12", "--metres", "20", "--out", "sim"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  writeConfig(folder, "sim/map.txt", "sim/drive.rawlog",
              std::string("ground_truth_path_file = sim/truth.txt\n") + kNoPictures);
  const CommandResult result = localize(folder);
  ASSERT_EQ(result.exit_code, 0) << result.errors;

  const json summary = summaryOf(folder);
  EXPECT_EQ(summary["map_features"], 400);
  EXPECT_GT(summary["steps"], 70);
  EXPECT_EQ(summary["final_verdict"], "localized");
  EXPECT_LT(summary["final_error_m"], 0.5);
  EXPECT_LT(summary["final_error_deg"], 5);
  EXPECT_EQ(summary["confidently_wrong_steps"], 0);
  EXPECT_LT(summary["localized_after_m"], 5);

  const std::ptrdiff_t steps = summary["steps"];
  EXPECT_EQ(countLines(readBytes(folder / "out/steps.csv")), steps + 1);
  EXPECT_EQ(countLines(readBytes(folder / "out/cov_est.txt")), steps);
  EXPECT_GT(countLines(readBytes(folder / "out/path.tum")), steps / 2);
  const std::ptrdiff_t beliefs =
      std::distance(std::filesystem::directory_iterator(folder / "out/belief"), {});
  EXPECT_GE(beliefs, steps);
}

TEST(Localize, tellsWhyALogOfLandmarksAndAMapOfWallsHaveNothingInCommon)
{
  const TemporaryFolder folder;
  for (const char* const world : {"points", "office"})
  {
    const CommandResult made =
        run(folder, "sigloc-simulate", {"--world", world, "--metres", "3", "--out", world});
    ASSERT_EQ(made.exit_code, 0) << made.errors;
  }
  const auto errorsOf = [&](const char* map, const char* log)
  {
    const CommandResult result =
        run(folder, "sigloc-localize", {"--map", map, "--log", log, "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return result.errors;
  };
  EXPECT_EQ(
      errorsOf("office/map.simplemap", "points/drive.rawlog"),
      "sigloc-localize: points/drive.rawlog: no laser scan in it; a map of walls takes nothing "
      "else\n");
  EXPECT_EQ(
      errorsOf("points/map.txt", "office/drive.rawlog"),
      "sigloc-localize: office/drive.rawlog: it shows no feature of a type that the map has\n");
  EXPECT_EQ(errorsOf("points/map.txt", "points/drive.rawlog"), "");
}
}  // namespace
}  // namespace sigloc
