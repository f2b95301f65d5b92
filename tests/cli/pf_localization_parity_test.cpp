// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The behaviour that users of pf-localization expect of sigloc-localize.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// Runs in `folder` on the lab's log with more keys in [LocalizationExperiment].
CommandResult localizeWithKeys(const TemporaryFolder& folder, const std::string& keys,
                               const std::string& out = "out")
{
  writeConfig(folder, kLabMap.string(), kLabLog.string(), keys + "\n" + kNoPictures);
  return localize(folder, out);
}

std::vector<std::vector<double>> numbersIn(const std::filesystem::path& path)
{
  std::vector<std::vector<double>> rows;
  std::istringstream lines(readBytes(path));
  for (std::string line; std::getline(lines, line);)
  {
    if (line.empty() || line.front() == '%') continue;
    rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; words >> word;) rows.back().push_back(std::stod(word));
  }
  return rows;
}

TEST(PfLocalizationParity, writesTheFilesOfItsLogFolder)
{
  const TemporaryFolder folder;
  writeText(folder / "gt.txt", "36 15.90 -10.01 0.0855\n");
  ASSERT_EQ(localizeWithKeys(folder,
                             "ground_truth_path_file = gt.txt\n3DSceneFrequency = 10\n"
                             "initial_odo_x = 5\ninitial_odo_y = 1\n")
                .exit_code,
            0);
  for (const char* const name : {"cov_est.txt", "odo_est.txt", "GT_error.txt", "ODO_error.txt",
                                 "exec_times.txt", "PF_stats.txt"})
  {
    EXPECT_EQ(countLines(readBytes(folder / ("out/" + std::string(name)))), kLabSteps) << name;
  }
  const auto odometry = numbersIn(folder / "out/odo_est.txt");
  EXPECT_EQ(odometry.front(), (std::vector<double>{5, 1, 0}));
  const auto errors = numbersIn(folder / "out/GT_error.txt");
  EXPECT_TRUE(std::isnan(errors[0][0])) << "truth is known at step 36 alone";
  EXPECT_LT(errors[36][0], 0.5);
  const auto dead_reckoning = numbersIn(folder / "out/ODO_error.txt");
  EXPECT_NEAR(dead_reckoning[36][0], std::hypot(odometry[36][0] - 15.90, odometry[36][1] + 10.01),
              1e-3);
  EXPECT_EQ(numbersIn(folder / "out/PF_stats.txt")[36].size(), 5U);
  EXPECT_EQ(countLines(readBytes(folder / "out/particles/particles_00031.txt")), 501)
      << "a header too";

  const auto summary = numbersIn(folder / "out/_SUMMARY.txt");
  ASSERT_EQ(summary.size(), 1U);
  ASSERT_EQ(summary[0].size(), 6U);
  EXPECT_TRUE(std::isnan(summary[0][0])) << "convergence was not tested";
  EXPECT_NEAR(summary[0][3], errors[36][0], 1e-5);
}

TEST(PfLocalizationParity, writesNoErrorsWithoutATruth)
{
  const TemporaryFolder folder;
  ASSERT_EQ(localizeWithKeys(folder, "").exit_code, 0);
  for (const char* const name : {"GT_error.txt", "ODO_error.txt"})
  {
    const auto file = folder / ("out/" + std::string(name));
    EXPECT_TRUE(std::filesystem::exists(file)) << name << ": pf-localization has it, too";
    EXPECT_EQ(readBytes(file), "") << name;
  }
}

TEST(PfLocalizationParity, testsConvergenceWhereItIsTold)
{
  const TemporaryFolder folder;
  writeText(folder / "gt.txt", "36 15.90 -10.01 0.0855\n");
  const std::string keys = "ground_truth_path_file = gt.txt\nexperimentTestConvergenceAtStep = ";
  ASSERT_EQ(localizeWithKeys(folder, keys + "36\n").exit_code, 0);
  EXPECT_EQ(summaryOf(folder)["converged"], true);
  EXPECT_EQ(numbersIn(folder / "out/_SUMMARY.txt")[0][0], 1.0);

  writeText(folder / "gt.txt", "20 0 0 0\n");  // not where it is
  ASSERT_EQ(localizeWithKeys(folder, keys + "20\nrawlog_offset = 5\n").exit_code, 0);
  EXPECT_EQ(summaryOf(folder)["converged"], false);
  EXPECT_EQ(summaryOf(folder)["steps"], 16) << "steps 5 to 20 of the log";
}

TEST(PfLocalizationParity, repetitionsAreIndependentAndComplete)
{
  const TemporaryFolder folder;
  ASSERT_EQ(
      localizeWithKeys(folder,
                       "experimentRepetitions = 2\ntracker = particles\nparticles_count = 100 150\n"
                       "rawlog_offset = 2\n")
          .exit_code,
      0);
  for (const char* const name :
       {"out_000_0000100", "out_001_0000100", "out_000_0000150", "out_001_0000150"})
  {
    EXPECT_EQ(countLines(readBytes((folder / name) / "odo_est.txt")), kLabSteps - 2) << name;
  }
  EXPECT_NE(readBytes(folder / "out_000_0000100/path.tum"),
            readBytes(folder / "out_001_0000100/path.tum"));
  const auto summary = numbersIn(folder / "out_SUMMARY.txt");
  ASSERT_EQ(summary.size(), 2U);
  EXPECT_EQ(summary[0][1], 100);
  EXPECT_EQ(summary[1][1], 150);
}

TEST(PfLocalizationParity, neverReplacesAForeignSummary)
{
  const TemporaryFolder folder;
  writeText(folder / "out_SUMMARY.txt", "mine\n");
  const CommandResult result = localizeWithKeys(folder, "experimentRepetitions = 2\n");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("not overwritten"), std::string::npos) << result.errors;
  EXPECT_EQ(readBytes(folder / "out_SUMMARY.txt"), "mine\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out_000"));
}

// With so long a name no work folder can be made beside it. A read-only parent folder has the same
// effect.
TEST(PfLocalizationParity, writesIntoAFolderWithNothingBesideIt)
{
  const TemporaryFolder folder;
  const std::string name(250, 'o');
  EXPECT_EQ(localizeWithKeys(folder, "", name).exit_code, 1) << "the folder would have to be made";
  std::filesystem::create_directory(folder / name);
  for (int i = 0; i < 2; ++i)  // the second replaces the first
  {
    const CommandResult result = localizeWithKeys(folder, "", name);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(countLines(readBytes((folder / name) / "odo_est.txt")), kLabSteps);
    EXPECT_TRUE(std::filesystem::exists((folder / name) / "_SUMMARY.txt"));
    EXPECT_FALSE(std::filesystem::exists((folder / name) / ".partial"));
  }
}

TEST(PfLocalizationParity, everythingThatARunWritesLiesInItsFolder)
{
  const TemporaryFolder folder;
  ASSERT_EQ(localizeWithKeys(folder, "").exit_code, 0);
  for (const std::string& path : listing(folder))
  {
    const std::string name = std::filesystem::relative(path, folder.path()).begin()->string();
    EXPECT_TRUE(name == "out" || name == "run.ini") << path;
  }
  std::size_t maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(cacheFor(folder) / "sigloc"))
  {
    EXPECT_EQ(entry.path().extension(), ".sigmap");
    ++maps;
  }
  EXPECT_EQ(maps, 1U);
}

// A cache only saves time: without one the run is the same.
TEST(PfLocalizationParity, aRunNeedsNoCache)
{
  const TemporaryFolder folder;
  writeText(cacheFor(folder), "a file where the folder would be");
  const CommandResult result = localizeWithKeys(folder, "");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(summaryOf(folder)["map_reused"], false);
}

TEST(PfLocalizationParity, refusesAnEmptyOutputFolder)
{
  const TemporaryFolder folder;
  const CommandResult result = localizeWithKeys(folder, "", "");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.errors, "sigloc-localize: --out is empty\n");
}
}  // namespace
}  // namespace sigloc
