// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "command_line.h"
#include "runs.h"
#include "support/landmark_log.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

/// A small run of a sub-command; "LANDMARKS" stands for the folder of a small landmark log.
struct SmallRun
{
  const char* name;
  Arguments arguments;
};

class EvalSummary : public testing::TestWithParam<SmallRun>
{
};

json summaryOfEval(const TemporaryFolder& folder, Arguments arguments)
{
  writeTwoRounds(folder.path());
  for (std::string& argument : arguments)
  {
    if (argument == "LANDMARKS") argument = ".";
  }
  for (const char* more : {"--quiet", "--out", "out"}) arguments.emplace_back(more);
  const auto done = run(folder, "sigloc-eval", arguments);
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  return summaryOf(folder);
}

void expectKeys(const json& object, const std::vector<const char*>& keys)
{
  for (const char* key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

TEST_P(EvalSummary, HoldsWhatOtherProgramsRelyOn)
{
  const TemporaryFolder folder;
  const json summary = summaryOfEval(folder, GetParam().arguments);
  ASSERT_FALSE(summary.at("methods").empty());
  for (const auto& [name, method] : summary.at("methods").items())
  {
    SCOPED_TRACE(name);
    for (const char* count : {"queries", "saw_nothing", "confident", "confident_right",
                              "confidently_wrong", "inaccurate", "cut_short"})
    {
      EXPECT_TRUE(method.at(count).is_number_unsigned()) << count;
    }
    EXPECT_GT(method.at("queries"), 0);
    EXPECT_GE(method.at("confident"), method.at("confident_right"));
    expectKeys(method, {"recall_at_1", "recall_at_1_tight", "recall_at_10", "proposed",
                        "median_error_m", "median_error_deg"});
    expectKeys(method.at("poses_scored"), {"median", "p95"});
    expectKeys(method.at("time_ms"), {"median", "p95", "mean"});
    EXPECT_GT(method.at("time_ms").at("median"), 0.0);
    EXPECT_GT(method.at("peak_rss_mb"), 1.0);
  }
  const json& map = summary.at("map");
  EXPECT_GT(map.at("features"), 0);
  EXPECT_GT(map.at("bytes"), 0);
  EXPECT_GE(map.at("build_s"), 0.0);
  EXPECT_GE(map.at("maps"), 1);
  expectKeys(summary.at("provenance"), {"version", "commit", "command", "seed", "data"});
}

TEST(EvalSummaryOfTrack, HoldsWhatDrivesAreJudgedBy)
{
  const TemporaryFolder folder;
  const json summary =
      summaryOfEval(folder, {"track", "--map", kOffice.string(), "--rawlog",
                             (kSources / "rawlogs" / "office.rawlog").string(), "--ground-truth",
                             (kSources / "rawlogs" / "office-truth.txt").string(), "--starts", "2",
                             "--travel", "4", "--kidnap", "--method", "signature"});
  const json& method = summary.at("methods").at("signature");
  EXPECT_EQ(method.at("queries"), 2);
  expectKeys(method, {"right_at_end", "settled", "noticed", "confidently_wrong_steps",
                      "confidently_wrong_episodes"});
  for (const char* quantity : {"distance_to_settled_m", "time_to_settled_s", "cpu_s_to_settled",
                               "step_ms", "noticed_after_m", "noticed_after_s"})
  {
    expectKeys(method.at(quantity), {"median", "p95"});
  }
  EXPECT_TRUE(method.at("noticed_after_s").at("median").is_number()) << "the log tells its times";
  const std::string report = readBytes(folder / "out" / "report.md");
  EXPECT_NE(report.find("| after the kidnapping | noticed"), std::string::npos);
}

TEST(EvalSummaryOfLandmarks, DrawsErrorsAndTimes)
{
  const TemporaryFolder folder;
  summaryOfEval(folder, {"landmarks", "--dataset", "dlr", "LANDMARKS", "--local-map-steps", "5,10",
                         "--max-queries", "3"});
  const std::string report = readBytes(folder / "out" / "report.md");
  for (const char* const plot : {"errors.png", "times.png"})
  {
    EXPECT_EQ(readBytes(folder / "out" / plot).substr(1, 3), "PNG") << plot;
    EXPECT_NE(report.find("](" + std::string(plot) + ")"), std::string::npos) << plot;
  }
}

TEST(EvalSummaryOfScale, TellsTimesRelativeToAThousandFeatures)
{
  const TemporaryFolder folder;
  const json summary =
      summaryOfEval(folder, {"scale", "--map-features", "500,1000", "--poses", "2"});
  for (const auto& [name, method] : summary.at("methods").items())
  {
    EXPECT_EQ(method.at("rows").at(1).at("time_ratio"), 1.0) << name;
    const json& rows = method.at("rows");
    EXPECT_DOUBLE_EQ(rows.at(0).at("time_ratio").get<double>(),
                     rows.at(0).at("time_ms").at("median").get<double>() /
                         rows.at(1).at("time_ms").at("median").get<double>());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, EvalSummary,
    testing::Values(
        SmallRun{"Relocate",
                 {"relocate", "--map", kOffice.string(), "--interleave", "4", "--max-queries", "4",
                  "--method", "signature,exhaustive,jcbb,mcl"}},
        SmallRun{"Track",
                 {"track", "--simulate", "2", "--worlds", "office", "--travel", "2", "--method",
                  "signature,signature-mcl"}},
        SmallRun{"Scale",
                 {"scale", "--map-features", "300", "--poses", "3", "--method", "signature,jcbb"}},
        SmallRun{"ScaleOnALog",
                 {"scale", "--dlr", "LANDMARKS", "--poses", "3", "--method", "jcbb"}},
        SmallRun{"Landmarks",
                 {"landmarks", "--dataset", "dlr", "LANDMARKS", "--local-map-steps", "10",
                  "--max-queries", "3", "--method", "signature,jcbb"}},
        SmallRun{"Sweep",
                 {"sweep", "--over", "noise", "--values", "0.02", "--world", "corridor",
                  "--worlds-per-kind", "1", "--queries", "3", "--method", "signature"}}),
    [](const auto& small) { return std::string(small.param.name); });

// Pictures of what failed, by every sub-command.

/// Moves the truth of the second round 5 m aside: no answer is right there.
void misplaceSecondRound(const std::filesystem::path& poses)
{
  std::istringstream rows(readBytes(poses));
  std::string moved;
  for (std::string row; std::getline(rows, row);)
  {
    std::istringstream cells(row);
    int step = 0;
    char comma = 0;
    double x = 0;
    std::string rest;
    cells >> step >> comma >> x >> rest;
    moved +=
        std::to_string(step) + "," + std::to_string(step > kStepsARound ? x + 5 : x) + rest + "\n";
  }
  writeText(poses, moved);
}

TEST(EvalPictures, AreDrawnByEverySubCommandThatCanFail)
{
  const TemporaryFolder folder;
  const std::string log = (kSources / "rawlogs" / "office.rawlog").string();
  const Arguments all[] = {
      // In a map that is declared foreign every claim is wrong.
      {"track", "--map", kOffice.string(), "--rawlog", log, "--foreign", "--starts", "2",
       "--travel", "4", "--method", "signature"},
      {"track", "--simulate", "1", "--worlds", "corridor", "--mapped-share", "0.3", "--travel", "6",
       "--seed", "3", "--method", "mcl", "--particles", "50"},
      // Two features do not fix a pose.
      {"scale", "--map-features", "300", "--observed", "2", "--poses", "3", "--method",
       "signature"},
      {"landmarks", "--dataset", "dlr", ".", "--local-map-steps", "1", "--max-queries", "10",
       "--visited-share", "0", "--visited-distance", "20", "--method", "jcbb"}};
  writeTwoRounds(folder.path());
  misplaceSecondRound(folder / "dlr_ls_poses.csv");
  for (Arguments arguments : all)
  {
    SCOPED_TRACE(arguments.front());
    for (const char* more : {"--draw-failures", "1", "--quiet", "--out", "out"})
    {
      arguments.emplace_back(more);
    }
    const auto done = run(folder, "sigloc-eval", arguments);
    ASSERT_EQ(done.exit_code, 0) << done.errors;
    std::size_t pictures = 0;
    if (std::filesystem::exists(folder / "out" / "failures"))
    {
      for (const auto& entry :
           std::filesystem::recursive_directory_iterator(folder / "out" / "failures"))
      {
        pictures += entry.path().extension() == ".png";
      }
    }
    EXPECT_GE(pictures, 1U);
    std::filesystem::remove_all(folder / "out");
  }
}
}  // namespace
}  // namespace sigloc
