// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// What three drives give, as it was when tests/golden/steps was last written. A change of method
// changes these numbers; then scripts/update_golden writes them anew, for the same commit.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "command_line.h"
#include "io/text_rows.h"
#include "support/golden.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

constexpr std::size_t kEvery = 10;  // steps of which one is kept
constexpr double kRounding = 1e-6;  // the last digit of the files

struct Drive
{
  const char* name;
  std::filesystem::path map, log;
};

std::vector<std::string> linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The cells of a row; a text in quotes is one.
std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells(1);
  bool in_text = false;
  for (const char c : line)
  {
    if (c == '"') in_text = !in_text;
    if (c == ',' && !in_text)
    {
      cells.emplace_back();
    }
    else
    {
      cells.back() += c;
    }
  }
  return cells;
}

/// The head and every tenth row of a run's steps.
std::string keptOf(const std::string& steps)
{
  const std::vector<std::string> lines = linesOf(steps);
  std::string kept;
  for (std::size_t row = 0; row < lines.size(); row += row == 0 ? 1 : kEvery)
  {
    kept += lines[row] + "\n";
  }
  return kept;
}

bool same(const std::string& a, const std::string& b)
{
  if (a == b) return true;
  const auto first = detail::toNumber(a);
  const auto second = detail::toNumber(b);
  return first && second && std::abs(*first - *second) <= 1.5 * kRounding;
}

/// Expects the same cells. Of a row that differs, both are shown.
void expectSame(const std::string& found, const std::string& golden)
{
  const auto rows = linesOf(found);
  const auto expected = linesOf(golden);
  EXPECT_EQ(rows.size(), expected.size());
  for (std::size_t row = 0; row < std::min(rows.size(), expected.size()); ++row)
  {
    const auto a = cellsOf(rows[row]);
    const auto b = cellsOf(expected[row]);
    bool equal = a.size() == b.size();
    for (std::size_t i = 0; equal && i < a.size(); ++i) equal = same(a[i], b[i]);
    EXPECT_TRUE(equal) << "was " << expected[row] << "\n is " << rows[row];
  }
}

class GoldenSteps : public ::testing::TestWithParam<Drive>
{
};

TEST_P(GoldenSteps, AreAsTheyWere)
{
  const TemporaryFolder folder;
  writeText(folder / "stats.ini", "[LocalizationExperiment]\nSAVE_STATS_ONLY = true\nmap_file = " +
                                      GetParam().map.string() +
                                      "\nrawlog_file = " + GetParam().log.string() + "\n");
  const auto result =
      run(folder, "sigloc-localize", {"stats.ini", "--quiet", "--seed", "1", "--out", "out"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string kept = keptOf(readBytes(folder / "out/steps.csv"));
  const auto golden = kSources / "tests/golden/steps" / (std::string(GetParam().name) + ".csv");
  if (test::writesGolden()) writeText(golden, kept);
  expectSame(kept, readBytes(golden));
}

INSTANTIATE_TEST_SUITE_P(
    Of, GoldenSteps,
    ::testing::Values(Drive{"lab", kLabMap, kLabLog},
                      Drive{"campus", kDatasets / "2006-MalagaCampus.gridmap.gz",
                            kDatasets / "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"},
                      Drive{"office", kSources / "maps/office.simplemap",
                            kSources / "rawlogs/office.rawlog"}),
    [](const auto& drive) { return std::string(drive.param.name); });
}  // namespace
}  // namespace sigloc
