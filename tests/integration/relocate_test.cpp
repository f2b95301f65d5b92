// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/relocate.h"
#include "support/office_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace sigloc
{
namespace
{
class RelocateTest : public ::testing::Test
{
 protected:
  RelocateTest()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "relocate-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~RelocateTest() override { std::filesystem::remove_all(folder_); }

  static RelocateOptions officeOptions()
  {
    RelocateOptions options;
    options.methods.clear();
    options.sources.map = test::kOfficeMap;
    options.sources.interleave = 4;
    options.sources.max_queries = 12;
    for (const std::string& name : relocationMethodNames())
    {
      // In an office's walls the tree takes until its budget.
      if (name != "interpretation-tree") options.methods.push_back(name);
    }
    options.command = "test";
    return options;
  }

  // The rows without their last column, which is the time.
  std::string resultsWithoutTimes(const RelocateReport& report, const std::string& name) const
  {
    writeRelocateReport(report, folder_ / name);
    std::ifstream file(folder_ / name / "results.csv");
    std::ostringstream out;
    for (std::string line; std::getline(file, line);)
      out << line.substr(0, line.rfind(',')) << '\n';
    return out.str();
  }

  std::filesystem::path folder_;
};

TEST_F(RelocateTest, GivesTheSameResultsOnOneAndTwoThreads)
{
  RelocateOptions options = officeOptions();
  options.sources.max_queries = 4;  // `signature-plain` takes a second for each
  const std::string one = resultsWithoutTimes(runRelocate(options), "one");
  options.threads = 2;
  const std::string two = resultsWithoutTimes(runRelocate(options), "two");
  EXPECT_EQ(one, two);
  EXPECT_GT(one.size(), 1000U);
}

TEST_F(RelocateTest, WritesTheSummaryThatOtherToolsRelyOn)
{
  RelocateOptions options = officeOptions();
  options.methods = {"exhaustive", "signature"};
  const RelocateReport report = runRelocate(options);
  writeRelocateReport(report, folder_ / "out");
  const auto json = nlohmann::json::parse(std::ifstream(folder_ / "out" / "summary.json"));
  for (const char* name : {"exhaustive", "signature"})
  {
    const auto& method = json.at("methods").at(name);
    EXPECT_EQ(method.at("queries"), 12);
    for (const char* key : {"saw_nothing", "confident", "confident_right", "confidently_wrong",
                            "inaccurate", "recall_at_1", "recall_at_1_tight", "recall_at_10",
                            "proposed", "median_error_m", "median_error_deg", "peak_rss_mb"})
    {
      EXPECT_TRUE(method.contains(key)) << key;
    }
    EXPECT_GT(method.at("time_ms").at("median").get<double>(), 0);
    EXPECT_GE(method.at("time_ms").at("p95"), method.at("time_ms").at("median"));
    EXPECT_TRUE(method.at("poses_scored").contains("p95"));
  }
  EXPECT_GE(json.at("methods").at("exhaustive").at("recall_at_1").get<double>(), 0.9);
  for (const char* key : {"features", "build_s", "bytes"})
    EXPECT_TRUE(json.at("map").contains(key));
  EXPECT_EQ(json.at("provenance").at("data").size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "report.md"));
}

// All refine poses of one lattice; who refines fewer finds no better one, and looks at less.
TEST_F(RelocateTest, PrunedSearchesRefineTheBestOfWhatThePlainOneDoes)
{
  RelocateOptions options = officeOptions();
  options.methods = {"exhaustive", "branch-and-bound", "branch-and-bound-1"};
  const RelocateReport report = runRelocate(options);
  const auto& plain = report.methods[0].records;
  const auto& ten = report.methods[1].records;
  const auto& one = report.methods[2].records;
  ASSERT_TRUE(plain.size() == ten.size() && plain.size() == one.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    ASSERT_TRUE(plain[i].first && ten[i].first && one[i].first);
    EXPECT_GE(plain[i].first_score, ten[i].first_score);
    EXPECT_GE(ten[i].first_score, one[i].first_score);
    EXPECT_GT(plain[i].poses_scored, ten[i].poses_scored);
    EXPECT_GE(ten[i].poses_scored, one[i].poses_scored);
  }
}

TEST_F(RelocateTest, NamesWhatIsWrongBeforeItRuns)
{
  RelocateOptions options = officeOptions();
  options.methods = {"signature", "no-such-method"};
  EXPECT_THROW(runRelocate(options), std::invalid_argument);
  options = officeOptions();
  options.sources.queries = test::kOfficeMap;
  EXPECT_THROW(runRelocate(options), std::invalid_argument) << "two kinds of queries";
  options = officeOptions();
  options.sources.map = folder_ / "missing.simplemap";
  EXPECT_THROW(runRelocate(options), std::runtime_error);
}

TEST_F(RelocateTest, FindsScansThatAreSimulatedInTheMapItself)
{
  RelocateOptions options;
  options.sources.map = test::kOfficeMap;
  options.methods = {"signature"};
  options.scans_in_map.count = 40;
  options.scans_in_map.view_deg = 270;
  options.scans_in_map.seed = 28;
  options.gates = simulationGates();
  const RelocateReport report = runRelocate(options);
  const auto& records = report.methods.front().records;
  ASSERT_EQ(records.size(), 40U);
  const auto right = std::count_if(records.begin(), records.end(),
                                   [](const auto& record) { return record.rank_of_right == 1; });
  EXPECT_GE(right, 36);
}

TEST(ScansInMap, ComeFromClearPlacesAndFollowTheirSeed)
{
  const EvaluationMap map = readEvaluationMap(test::kOfficeMap);
  const OccupancyRaster raster = rasterOf(*map.features->field());
  MapScanOptions options;
  options.count = 20;
  const auto queries = scansInMap(map, options);
  ASSERT_EQ(queries.size(), 20U);
  for (const EvaluationQuery& query : queries)
  {
    const auto place =
        (mrpt::math::TPoint2D(query.truth->x, query.truth->y) - raster.frame.origin) *
        (1 / raster.frame.resolution);
    const auto cell =
        static_cast<std::size_t>(place.y) * raster.frame.width + static_cast<std::size_t>(place.x);
    EXPECT_EQ(raster.cells.at(cell), CellState::free);
    EXPECT_EQ(query.scans.front().ranges.size(), 360U);
  }
  EXPECT_EQ(scansInMap(map, options).front().scans.front().ranges,
            queries.front().scans.front().ranges);
  options.seed = 2;
  EXPECT_NE(scansInMap(map, options).front().truth, queries.front().truth);
}

TEST(ScansInMap, RefuseALaserOutOfRange)
{
  const EvaluationMap map = readEvaluationMap(test::kOfficeMap);
  MapScanOptions options;
  options.count = 1;
  options.range_sigma = -1;
  EXPECT_THROW(scansInMap(map, options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
