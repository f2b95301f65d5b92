// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/merge.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "eval/protocols/relocate.h"
#include "eval/protocols/sweep.h"
#include "eval/reports/report_files.h"
#include "eval/scoring/statistics.h"

namespace sigloc
{
namespace
{
using test::readBytes;
using test::TemporaryFolder;
using test::writeText;

/// A run of `relocate` in which `right` of `queries` robots are found, in half of the cases surely.
void writeRelocations(const std::filesystem::path& folder, std::size_t right, std::size_t queries,
                      const std::string& method = "signature", std::uint64_t seed = 1)
{
  RelocateReport report;
  report.provenance.seed = seed;
  report.methods.emplace_back();
  report.methods.back().name = method;
  for (std::size_t i = 0; i < queries; ++i)
  {
    RelocationRecord record;
    record.query = std::to_string(i);
    record.truth = mrpt::math::TPose2D(1, 2, 0.5);
    record.first = mrpt::math::TPose2D(1.25, 2, 0.5);
    record.error = {0.25, 0};
    record.valid_beams = i == 0 ? 3 : 181;  // the first one saw nothing
    record.rank_of_right = i < right ? 1 : 0;
    record.proposed = true;
    record.claim = i % 2 == 0 ? Claim::none : (i < right ? Claim::right : Claim::wrong);
    record.time_ms = static_cast<double>(queries);
    report.methods.back().records.push_back(record);
  }
  writeRelocateReport(report, folder);
}

TEST(Merge, EveryQueryOfAllRunsWeighsTheSame)
{
  const TemporaryFolder folder;
  writeRelocations(folder / "small", 2, 11);
  writeRelocations(folder / "large", 90, 101, "signature", 2);
  const MergedRuns merged = mergeRuns({folder / "small", folder / "large"}, "test");
  const auto& method = merged.report.summary.at("methods").at("signature");
  EXPECT_EQ(method.at("queries"), 112);
  EXPECT_EQ(method.at("saw_nothing"), 2);
  EXPECT_EQ(method.at("confident"), 55);
  EXPECT_EQ(method.at("confident_right"), 46);
  EXPECT_EQ(method.at("confidently_wrong"), 9);
  const Proportion recall{90, 110};
  EXPECT_DOUBLE_EQ(method.at("recall_at_1").get<double>(), recall.value());
  EXPECT_DOUBLE_EQ(method.at("recall_at_1_interval").at(0).get<double>(), recall.low());
  EXPECT_DOUBLE_EQ(method.at("recall_at_1_interval").at(1).get<double>(), recall.high());
  EXPECT_DOUBLE_EQ(method.at("median_error_m").get<double>(), 0.25);
  // Quantiles are of all queries, not means of the runs' own.
  EXPECT_DOUBLE_EQ(method.at("time_ms").at("median").get<double>(), 101);
  EXPECT_TRUE(merged.complete);
}

/// A CSV text, no cell of which is quoted, without its column `name`.
std::string withoutColumn(const std::string& csv, const std::string& name)
{
  std::istringstream lines(csv);
  std::string out;
  std::ptrdiff_t column = -1;
  for (std::string line; std::getline(lines, line);)
  {
    std::vector<std::string> cells{""};
    for (const char c : line)
    {
      if (c == ',') cells.emplace_back();
      if (c != ',') cells.back() += c;
    }
    if (column < 0) column = std::find(cells.begin(), cells.end(), name) - cells.begin();
    EXPECT_LT(column, static_cast<std::ptrdiff_t>(cells.size())) << name;
    if (column >= static_cast<std::ptrdiff_t>(cells.size())) return csv;
    cells.erase(cells.begin() + column);
    for (std::size_t k = 0; k < cells.size(); ++k) out += (k > 0 ? "," : "") + cells[k];
    out += "\n";
  }
  return out;
}

TEST(Merge, TakesRunsOfEarlierVersionsWithoutTheLatestColumns)
{
  const TemporaryFolder folder;
  writeRelocations(folder / "old", 2, 11);
  writeRelocations(folder / "new", 3, 12, "signature", 2);
  const std::filesystem::path results = folder / "old" / "results.csv";
  for (const std::string later : {"cut_short", "settled_by_pairs"})
  {
    writeText(results, withoutColumn(readBytes(results), later));
  }
  const MergedRuns merged = mergeRuns({folder / "old", folder / "new"}, "test");
  EXPECT_EQ(merged.report.summary.at("methods").at("signature").at("queries"), 23);
  writeText(results, withoutColumn(readBytes(results), "claim"));
  EXPECT_THROW(mergeRuns({folder / "old", folder / "new"}, "test"), std::runtime_error);
}

TEST(Merge, FoldersMayHaveAnyName)
{
  const TemporaryFolder folder;
  const std::filesystem::path odd = folder / "a,\"b\"";
  writeRelocations(odd, 2, 11);
  writeRelocations(folder / "plain", 3, 12, "signature", 2);
  writeRelocations(folder / "more", 4, 13, "signature", 3);
  writeRunReport(mergeRuns({odd, folder / "plain"}, "test").report, folder / "merged");
  const MergedRuns again = mergeRuns({folder / "merged", folder / "more"}, "test");
  EXPECT_EQ(again.report.summary.at("methods").at("signature").at("queries"), 36);
}

TEST(Merge, OfTwoSweepsIsTheSweepOverBothSeeds)
{
  const TemporaryFolder folder;
  SweepOptions options;
  options.over = "clutter";
  options.values = {0, 0.4};
  options.worlds = {WorldKind::corridor};
  options.worlds_per_kind = 1;
  options.queries_per_world = 4;
  options.methods = {"signature"};
  std::vector<std::size_t> right(2, 0);
  for (const std::uint32_t seed : {1U, 2U})
  {
    options.seed = seed;
    const SweepReport report = runSweep(options);
    for (std::size_t i = 0; i < report.rows.size(); ++i)
    {
      for (const SweepRecord& record : report.rows[i].records)
      {
        right[i] += record.answer.rank_of_right == 1 ? 1 : 0;
      }
    }
    writeSweepReport(report, folder / std::to_string(seed));
  }
  const MergedRuns merged = mergeRuns({folder / "2", folder / "1"}, "test");
  const auto& rows = merged.report.summary.at("methods").at("signature").at("rows");
  ASSERT_EQ(rows.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(rows.at(i).at("value"), options.values[i]);
    EXPECT_EQ(rows.at(i).at("recall_at_1_counts").at(0), right[i]);
    EXPECT_EQ(rows.at(i).at("recall_at_1_counts").at(1), 8);
  }
  EXPECT_EQ(merged.report.plots.size(), 4U);
  // Merged runs can be merged again. Runs with the same queries can't.
  writeRunReport(merged.report, folder / "both");
  EXPECT_THROW(mergeRuns({folder / "both", folder / "1"}, "test"), std::runtime_error);
}

TEST(Merge, SumsTheCountsOfDrives)
{
  const TemporaryFolder folder;
  for (const std::string run : {"a", "b"})
  {
    RunReport report;
    auto& method = report.summary["methods"]["signature"];
    method["queries"] = 20U;
    method["steps"] = 1U;
    report.provenance.seed = run == "a" ? 1 : 2;
    method["confidently_wrong"] = run == "a" ? 1U : 2U;
    addJson(method, "right_at_end", Proportion{run == "a" ? 19U : 10U, 20});
    report.results = "method,start,step,travelled_m,kidnapped\nsignature,0,0,0,0\n";
    report.summary["complete"] = run == "a";
    writeRunReport(report, folder / run);
  }
  const MergedRuns merged = mergeRuns({folder / "a", folder / "b"}, "test");
  const auto& method = merged.report.summary.at("methods").at("signature");
  EXPECT_EQ(method.at("queries"), 40);
  EXPECT_EQ(method.at("confidently_wrong"), 3);
  EXPECT_DOUBLE_EQ(method.at("right_at_end").get<double>(), 29.0 / 40);
  EXPECT_FALSE(merged.complete);
  EXPECT_NE(merged.report.text.find("0.725"), std::string::npos) << merged.report.text;
}

/// The message with which `mergeRuns` refuses the runs.
std::string complaint(const std::vector<std::filesystem::path>& runs)
{
  try
  {
    mergeRuns(runs, "test");
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

TEST(Merge, RefusesToCountTheSameQuestionsTwice)
{
  const TemporaryFolder folder;
  writeRelocations(folder / "a", 2, 5);
  writeRelocations(folder / "again", 2, 3);
  EXPECT_NE(
      complaint({folder / "a", folder / "again"}).find("again: an earlier run asked the same"),
      std::string::npos);
  for (const std::string run : {"drive", "same"})
  {
    RunReport report;
    report.summary["methods"]["signature"] = {{"queries", 1U}, {"steps", 1U}};
    report.results = "method,start,step,travelled_m,kidnapped\nsignature,7,0,0,0\n";
    writeRunReport(report, folder / run);
  }
  EXPECT_NE(complaint({folder / "drive", folder / "same"}).find("same: an earlier run"),
            std::string::npos);
}

// The queries of a log do not depend on the seed: another seed gives the same ones.
TEST(Merge, RefusesTheSameLogUnderAnotherSeed)
{
  const TemporaryFolder folder;
  writeText(folder / "log", "a log");
  for (const std::uint64_t seed : {1U, 2U})
  {
    RunReport report;
    report.summary["methods"]["signature"] = {{"queries", 1U}};
    report.results = "method,query\nsignature,7\n";
    report.provenance.seed = seed;
    report.provenance.data_files = {folder / "log"};
    writeRunReport(report, folder / std::to_string(seed));
  }
  EXPECT_NE(complaint({folder / "1", folder / "2"}).find("2: an earlier run asked the same"),
            std::string::npos);
}

TEST(Merge, RefusesWhatCannotBePooled)
{
  const TemporaryFolder folder;
  writeRelocations(folder / "a", 2, 5);
  writeRelocations(folder / "other", 2, 5, "lattice");
  writeRelocations(folder / "broken", 2, 5);
  const std::string csv = readBytes(folder / "broken" / "results.csv");
  EXPECT_THROW(mergeRuns({folder / "a"}, "test"), std::invalid_argument);
  EXPECT_NE(complaint({folder / "a", folder / "." / "a"}).find("given twice"), std::string::npos);
  EXPECT_NE(complaint({folder / "a", folder / "other"}).find("other: has other methods"),
            std::string::npos);
  EXPECT_NE(complaint({folder / "a", folder / "none"}).find("summary.json: no such file"),
            std::string::npos);
  std::filesystem::create_directory(folder / "pipe");
  ASSERT_EQ(mkfifo((folder / "pipe" / "summary.json").c_str(), 0600), 0);
  EXPECT_NE(complaint({folder / "a", folder / "pipe"}).find("summary.json: is no regular file"),
            std::string::npos);
  writeText(folder / "broken" / "results.csv", csv.substr(0, csv.size() - 9));
  EXPECT_NE(complaint({folder / "a", folder / "broken"}).find("results.csv: line 6"),
            std::string::npos);
  writeText(folder / "broken" / "results.csv", csv + "signature,x\n");
  EXPECT_NE(complaint({folder / "a", folder / "broken"}).find("results.csv: line 7"),
            std::string::npos);
  const std::size_t last_line = csv.rfind('\n', csv.size() - 2) + 1;
  writeText(folder / "broken" / "results.csv", csv.substr(0, last_line));
  EXPECT_NE(
      complaint({folder / "a", folder / "broken"}).find("holds 4 rows of signature, not the 5"),
      std::string::npos);
  writeText(folder / "broken" / "results.csv", "");
  EXPECT_NE(complaint({folder / "a", folder / "broken"}).find("results.csv: is empty"),
            std::string::npos);
}
}  // namespace
}  // namespace sigloc
