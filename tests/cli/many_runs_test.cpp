// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
const std::string kEval = std::string(SIGLOC_BIN_FOLDER) + "/sigloc-eval";

int shell(const TemporaryFolder& folder, const std::string& command)
{
  const std::string line = "cd " + quoted(folder.path().string()) + " && " + command +
                           " </dev/null >parallel.out 2>parallel.err";
  return std::system(line.c_str());
}

// The commands of docs/many-logs.md, with one machine in place of two. Its `ssh HOST -- COMMAND`
// runs the command here, with the SHELL that a login sets. Parallel's worker runs jobs in that
// shell; an automatic build may have none.
TEST(ManyRuns, GnuParallelSpreadsThemAndMergePoolsThem)
{
  const TemporaryFolder folder;
  writeText(
      folder / "ssh",
      "#!/bin/sh\nshift\n[ \"$1\" = -- ] && shift\nexport SHELL=/bin/sh\nexec sh -c \"$*\"\n");
  std::filesystem::permissions(folder / "ssh", std::filesystem::perms::owner_all);
  const int status =
      shell(folder, "parallel --will-cite --ssh ./ssh --sshlogin 1/one,1/two --workdir . " +
                        quoted(kEval) +
                        " sweep --over noise --values 0.02,0.05 --world corridor --worlds-per-kind "
                        "1 --queries 3 --method signature --seed {} --quiet --out runs/{} ::: 1 2");
  ASSERT_EQ(status, 0) << readBytes(folder / "parallel.err");

  const auto merged = run(folder, "sigloc-eval", {"merge", "runs/1", "runs/2", "--out", "all"});
  ASSERT_EQ(merged.exit_code, 0) << merged.errors;
  const auto summary = summaryOf(folder, "all");
  const auto& method = summary.at("methods").at("signature");
  EXPECT_EQ(method.at("queries"), 12);
  ASSERT_EQ(method.at("rows").size(), 2U);
  EXPECT_EQ(method.at("rows").at(0).at("recall_at_1_counts").at(1), 6);
  EXPECT_EQ(summary.at("provenance").at("data").size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(folder / "all" / "recall.png"));
}

TEST(ManyRuns, WhatCannotBePooledIsRefused)
{
  const TemporaryFolder folder;
  const auto before = listing(folder);
  const auto result = run(folder, "sigloc-eval", {"merge", "no", "such", "--out", "all"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find("no/summary.json"), std::string::npos) << result.errors;
  EXPECT_EQ(listing(folder), before);
}

/// The one line on stderr of a call that must fail and write nothing.
std::string refusal(const TemporaryFolder& folder, const std::vector<std::string>& arguments)
{
  const auto before = listing(folder);
  const auto result = run(folder, "sigloc-eval", arguments);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_EQ(listing(folder), before);
  return result.errors;
}

TEST(ManyRuns, MergingOverAnInputIsRefused)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a");
  std::filesystem::create_directory(folder / "b");
  writeText(folder / "b/summary.json", R"({"provenance": {"command": "sigloc-eval sweep"}})");
  const std::string errors = refusal(folder, {"merge", "a", "b", "--out", "./b"});
  EXPECT_NE(errors.find("is the input b/summary.json"), std::string::npos) << errors;
}

TEST(Reference, ALogWithoutItsEndAndAPoseThatIsNoneAreRefused)
{
  const TemporaryFolder folder;
  writeText(folder / "cut.rawlog", readBytes(kLabLog).substr(0, 10000));
  const auto reference = [&](const std::string& rawlog, const std::string& last)
  {
    return refusal(folder, {"reference", "--map", kLabMap.string(), "--rawlog", rawlog, "--last",
                            last, "--out", "truth.txt"});
  };
  const std::string cut = reference("cut.rawlog", "15.9,-10.01,4.9");
  EXPECT_NE(cut.find("cut.rawlog: truncated"), std::string::npos) << cut;
  const std::string nan = reference(kLabLog.string(), "nan,-10.01,4.9");
  EXPECT_NE(nan.find("--last: nan: not a number"), std::string::npos) << nan;
}
}  // namespace
}  // namespace sigloc
