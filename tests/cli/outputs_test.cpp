// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// No program replaces its inputs, nor a file that no earlier run of it wrote.
#include <gtest/gtest.h>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using namespace sigloc::test;

/// Runs a program that must leave every file as it is and name `name` in its one line.
void expectUntouched(const TemporaryFolder& folder, const std::string& program,
                     const Arguments& arguments, const std::string& name)
{
  const auto contents = [&]
  {
    std::vector<std::string> all;
    for (const std::string& path : listing(folder))
    {
      all.push_back(path);
      if (fs::is_regular_file(path)) all.push_back(readBytes(path));
    }
    return all;
  };
  const auto before = contents();
  const CommandResult result = run(folder, program, arguments);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(name), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("not overwritten"), std::string::npos) << result.errors;
  EXPECT_TRUE(contents() == before) << program << " changed a file";
}

void copyLabMap(const TemporaryFolder& folder)
{
  fs::copy_file(kLabMap, folder / "lab.simplemap.gz");
}

TEST(Outputs, aMapNeverReplacesItsSource)
{
  const TemporaryFolder folder;
  copyLabMap(folder);
  fs::create_symlink("lab.simplemap.gz", folder / "link.sigmap");
  fs::create_directory(folder / "sub");
  for (const std::string output : {"lab.simplemap.gz", "./sub/../lab.simplemap.gz", "link.sigmap"})
  {
    expectUntouched(folder, "sigloc-map", {"build", "-i", "lab.simplemap.gz", "-o", output},
                    output + ": is the input lab.simplemap.gz");
  }
}

TEST(Outputs, aMapReplacesNeitherTheImageOfARosMapNorItsOptions)
{
  const TemporaryFolder folder;
  writeText(folder / "map.yaml",
            "image: map.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  writeText(folder / "map.pgm", "P5 2 2 255\nabcd");
  writeText(folder / "options.ini", "[sigloc.map]\nmerge_gap = 0.4\n");
  for (const std::string output : {"map.yaml", "map.pgm", "options.ini"})
  {
    expectUntouched(folder, "sigloc-map",
                    {"build", "-i", "map.yaml", "-o", output, "--config", "options.ini"}, output);
  }
}

TEST(Outputs, aMapReplacesOnlyMaps)
{
  const TemporaryFolder folder;
  copyLabMap(folder);
  writeText(folder / "thesis.tex", "dear");
  expectUntouched(folder, "sigloc-map", {"build", "-i", "lab.simplemap.gz", "-o", "thesis.tex"},
                  "thesis.tex");
  writeText(folder / "old.sigmap", "whatever");
  EXPECT_EQ(
      run(folder, "sigloc-map", {"build", "-i", "lab.simplemap.gz", "-o", "old.sigmap"}).exit_code,
      0);
}

TEST(Outputs, aPictureNeverReplacesTheMapsSource)
{
  const TemporaryFolder folder;
  copyLabMap(folder);
  ASSERT_EQ(
      run(folder, "sigloc-map", {"build", "-i", "lab.simplemap.gz", "-o", "lab.sigmap"}).exit_code,
      0);
  fs::create_symlink("lab.sigmap", folder / "map.png");
  fs::create_symlink("lab.simplemap.gz", folder / "source.png");
  for (const std::string output : {"map.png", "source.png"})
  {
    expectUntouched(folder, "sigloc-map", {"draw", "lab.sigmap", "-o", output}, output);
  }
}

void writeConfigWithoutPictures(const TemporaryFolder& folder, const std::string& rawlog,
                                const std::string& more = "")
{
  writeConfig(folder, kLabMap.string(), rawlog, more + kNoPictures);
}

TEST(Outputs, leaveOutTheBeliefOfEachStepWhereTheIniSaysSo)
{
  const TemporaryFolder folder;
  writeConfigWithoutPictures(folder, kLabLog.string());
  ASSERT_EQ(localize(folder, "all").exit_code, 0);
  EXPECT_FALSE(fs::is_empty(folder / "all/belief"));
  std::ofstream(folder / "run.ini", std::ios::app) << "beliefs = false\n";
  ASSERT_EQ(localize(folder, "less").exit_code, 0);
  EXPECT_TRUE(fs::is_empty(folder / "less/belief"));
  EXPECT_EQ(readBytes(folder / "less/steps.csv"), readBytes(folder / "all/steps.csv"));
}

TEST(Outputs, aRunNeverReplacesTheLogItReads)
{
  const TemporaryFolder folder;
  writeConfigWithoutPictures(folder, kLabLog.string());
  ASSERT_EQ(localize(folder).exit_code, 0);
  writeConfigWithoutPictures(folder, "out/annotated.rawlog");
  expectUntouched(folder, "sigloc-localize", {"run.ini", "--out", "out"}, "annotated.rawlog");
  // If one of several runs would replace a file, none starts.
  fs::rename(folder / "out", folder / "more_001");
  writeConfigWithoutPictures(folder, "more_001/annotated.rawlog", "experimentRepetitions = 2\n");
  expectUntouched(folder, "sigloc-localize", {"run.ini", "--out", "more"}, "annotated.rawlog");
}

TEST(Outputs, aRunFillsAFolderThatSomethingIsMountedOn)
{
  const TemporaryFolder folder;
  fs::create_directory(folder / "out");
  if (runShell(folder, "mount -t tmpfs none out").exit_code != 0) GTEST_SKIP() << "cannot mount";
  writeConfigWithoutPictures(folder, kLabLog.string());
  for (const char* const which : {"an empty one", "one with an earlier run"})
  {
    EXPECT_EQ(localize(folder).exit_code, 0) << which;
    EXPECT_TRUE(fs::exists(folder / "out/summary.json")) << which;
    EXPECT_FALSE(fs::exists(folder / "out/.partial")) << which;
  }
  EXPECT_EQ(runShell(folder, "umount out").exit_code, 0);
}

TEST(Outputs, aFolderWithFilesNamedLikeARunsIsNoRun)
{
  const TemporaryFolder folder;
  writeConfigWithoutPictures(folder, kLabLog.string());
  fs::create_directory(folder / "out");
  writeText(folder / "out/steps.csv", "1,2,3\n");
  expectUntouched(folder, "sigloc-localize", {"run.ini", "--out", "out"}, "/out: ");
  for (const char* const text : {R"({"total": 3})", "[]", "no JSON"})
  {
    writeText(folder / "out/summary.json", text);
    expectUntouched(folder, "sigloc-localize", {"run.ini", "--out", "out"}, "/out: ");
  }
  fs::rename(folder / "out", folder / "new.partial");
  expectUntouched(folder, "sigloc-localize", {"run.ini", "--out", "new"}, "new.partial: ");
}

/// A quick report, and the truth that it is made from.
Arguments relocate(const std::string& truth, const std::string& out)
{
  return {"relocate",
          "--map",
          (kSources / "maps/office.simplemap").string(),
          "--rawlog",
          (kSources / "rawlogs/office.rawlog").string(),
          "--ground-truth",
          truth,
          "--max-queries",
          "2",
          "--method",
          "signature",
          "--quiet",
          "--out",
          out};
}

TEST(Outputs, aReportNeverReplacesItsTruth)
{
  const TemporaryFolder folder;
  const fs::path truth = kSources / "rawlogs/office-truth.txt";
  ASSERT_EQ(run(folder, "sigloc-eval", relocate(truth.string(), "out")).exit_code, 0);
  fs::copy_file(truth, folder / "out/results.csv", fs::copy_options::overwrite_existing);
  expectUntouched(folder, "sigloc-eval", relocate("out/results.csv", "./out"),
                  "results.csv: is the input");
  fs::create_symlink("out/results.csv", folder / "truth.txt");
  expectUntouched(folder, "sigloc-eval", relocate("truth.txt", "out"), "the input truth.txt");
}

TEST(Outputs, aReportReplacesOnlyReports)
{
  const TemporaryFolder folder;
  const std::string truth = (kSources / "rawlogs/office-truth.txt").string();
  for (const std::string name :
       {"results.csv", "summary.json", "report.md", "report.html", "figure.png"})
  {
    const TemporaryFolder other;
    fs::create_directory(other / "out");
    writeText(other / "out" / name, R"({"provenance": {"command": "make"}})");
    expectUntouched(other, "sigloc-eval", relocate(truth, "out"), "out: holds " + name);
  }
  // Files with names that no report uses may stay. An earlier report is replaced.
  fs::create_directory(folder / "out");
  writeText(folder / "out/notes.txt", "mine");
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(run(folder, "sigloc-eval", relocate(truth, "out")).exit_code, 0);
    EXPECT_EQ(readBytes(folder / "out/notes.txt"), "mine");
  }
}

TEST(Outputs, mergedRunsAndReferencesReplaceNothingTheyRead)
{
  const TemporaryFolder folder;
  const std::string truth = (kSources / "rawlogs/office-truth.txt").string();
  ASSERT_EQ(run(folder, "sigloc-eval", relocate(truth, "a")).exit_code, 0);
  expectUntouched(folder, "sigloc-eval", {"merge", "a", "b", "--out", "./a"}, "is the input");

  copyLabMap(folder);
  expectUntouched(folder, "sigloc-eval",
                  {"reference", "--map", "lab.simplemap.gz", "--rawlog", kLabLog.string(), "--last",
                   "15.9,-10.01,4.9", "--out", "lab.simplemap.gz"},
                  "is the input lab.simplemap.gz");
  fs::copy_file(truth, folder / "truth.txt");
  expectUntouched(folder, "sigloc-eval",
                  {"reference", "--map", "lab.simplemap.gz", "--rawlog", kLabLog.string(), "--last",
                   "15.9,-10.01,4.9", "--out", "truth.txt"},
                  "truth.txt: exists");
}
}  // namespace
}  // namespace sigloc
