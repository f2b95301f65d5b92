// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// Exit code 1, one line on stderr with `name` in it, and no file that was not there before.
void expectRefused(const TemporaryFolder& folder, const std::set<std::string>& before,
                   const CommandResult& result, const std::string& name)
{
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(name), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(listing(folder), before);
}

class BadFile : public ::testing::TestWithParam<Damage>
{
};

TEST_P(BadFile, asMapSourceIsRefused)
{
  const TemporaryFolder folder;
  makeBadFile(GetParam(), kLabMap, folder / "bad.simplemap.gz");
  const auto before = listing(folder);
  const auto result =
      run(folder, "sigloc-map", {"build", "-i", "bad.simplemap.gz", "-o", "m.sigmap"});
  expectRefused(folder, before, result, "bad.simplemap.gz");
}

TEST_P(BadFile, asSigmapIsRefused)
{
  const TemporaryFolder folder;
  makeBadFile(GetParam(), kLabMap, folder / "bad.sigmap");
  const auto before = listing(folder);
  expectRefused(folder, before, run(folder, "sigloc-map", {"info", "bad.sigmap"}), "bad.sigmap");
  expectRefused(folder, before, run(folder, "sigloc-map", {"draw", "bad.sigmap", "-o", "a.png"}),
                "bad.sigmap");
}

TEST_P(BadFile, asMapOfARunIsRefused)
{
  const TemporaryFolder folder;
  makeBadFile(GetParam(), kLabMap, folder / "bad.simplemap.gz");
  writeConfig(folder, "bad.simplemap.gz", kLabLog.string());
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "bad.simplemap.gz");
}

TEST_P(BadFile, asRawlogIsRefused)
{
  if (GetParam() == Damage::truncated) return;  // the readable part is used: see below
  const TemporaryFolder folder;
  makeBadFile(GetParam(), kLabLog, folder / "bad.rawlog");
  writeConfig(folder, kLabMap.string(), "bad.rawlog");
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "bad.rawlog");
}

TEST_P(BadFile, asConfigurationIsRefused)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string());
  makeBadFile(GetParam(), folder / "run.ini", folder / "bad.ini");
  const auto before = listing(folder);
  const auto result = run(folder, "sigloc-localize", {"bad.ini", "--out", "new/out"});
  expectRefused(folder, before, result, "bad.ini");
}

INSTANTIATE_TEST_SUITE_P(All, BadFile,
                         ::testing::Values(Damage::missing, Damage::empty, Damage::truncated,
                                           Damage::foreign, Damage::random));

TEST(BadInput, rawlogWithoutScansIsRefused)
{
  const TemporaryFolder folder;
  writeObjects(folder / "bad.rawlog", {makeOdometry(1, {}), makeOdometry(2, {1, 0, 0})});
  writeConfig(folder, kLabMap.string(), "bad.rawlog");
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "bad.rawlog");
}

TEST(BadInput, mapWithoutFeaturesIsRefused)
{
  const TemporaryFolder folder;
  auto scan = makeScan(1);
  for (std::size_t i = 0; i < scan->getScanSize(); ++i) scan->setScanRangeValidity(i, false);
  mrpt::maps::CSimpleMap map;
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), makeFrame(scan));
  ASSERT_TRUE(map.saveToFile((folder / "bad.simplemap").string()));
  writeConfig(folder, "bad.simplemap", kLabLog.string());
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "bad.simplemap");
  expectRefused(folder, before,
                run(folder, "sigloc-map", {"build", "-i", "bad.simplemap", "-o", "m.sigmap"}),
                "bad.simplemap");
  expectRefused(folder, before,
                run(folder, "sigloc-eval",
                    {"relocate", "--map", "bad.simplemap", "--queries", kLabMap.string(),
                     "--foreign", "--quiet", "--out", "o"}),
                "bad.simplemap");
}

// Because of a loop of links the system can't determine whether a file exists. An unreadable folder
// has the same effect.
TEST(BadInput, whatCannotBeReachedSaysWhy)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  writeConfig(folder, kLabMap.string(), "loop/a.rawlog");
  const auto before = listing(folder);
  const auto result = localize(folder, "new/out");
  expectRefused(folder, before, result, "loop/a.rawlog: Too many levels");
  expectRefused(folder, before, run(folder, "sigloc-localize", {"loop/run.ini", "--quiet"}),
                "loop/run.ini: Too many levels");
}

// What has no end, or ends only once, is no file to read twice.
TEST(BadInput, devicesAreNoFiles)
{
  const TemporaryFolder folder;
  writeText(folder / "device.yaml",
            "image: /dev/zero\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.25\n");
  std::vector<std::string> maps = {"device.yaml"};
  for (const char* const kind :
       {"simplemap", "gridmap", "metricmap", "pgm", "ply", "pcd", "txt", "csv", "log", "sigmap"})
  {
    maps.push_back(std::string("zero.") + kind);
    std::filesystem::create_symlink("/dev/zero", folder / maps.back());
  }
  const auto before = listing(folder);
  for (const std::string& map : maps)
  {
    Arguments arguments = {"build", "-i", map, "-o", "a.sigmap"};
    if (map == "zero.pgm") arguments.insert(arguments.end(), {"--resolution", "0.05"});
    const CommandResult result = run(folder, "sigloc-map", arguments);
    EXPECT_EQ(result.exit_code, 1) << map;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("is no regular file"), std::string::npos) << result.errors;
    EXPECT_EQ(listing(folder), before);
  }
}

TEST(BadInput, unknownCommandIsNamed)
{
  const TemporaryFolder folder;
  expectRefused(folder, {}, run(folder, "sigloc-eval", {"nosuch"}), "no such command: nosuch");
  expectRefused(folder, {}, run(folder, "sigloc-eval", {"relocate"}), "required");
}

TEST(BadInput, unknownKeyIsNamed)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string(), "[sigloc.tracker]\nmax_hypothesis = 3\n");
  const auto before = listing(folder);
  const auto result = localize(folder, "new/out");
  expectRefused(folder, before, result, "run.ini");
  EXPECT_NE(result.errors.find("max_hypothesis"), std::string::npos) << result.errors;
}

TEST(BadInput, aWarningIsNotSaidBeforeAnError)
{
  const TemporaryFolder folder;
  const std::string twice = "logOutputdir = x\n[sigloc.map]\nmerge_gap = 1\nmerge_gap = 2\n";
  writeText(folder / "bad.rawlog", "no rawlog");
  writeConfig(folder, kLabMap.string(), (folder / "bad.rawlog").string(), twice);
  writeText(folder / "bad.simplemap", "no map");
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "bad.rawlog");
  const Arguments build = {"build", "-i", "bad.simplemap", "-o", "m.sigmap", "--config", "run.ini"};
  expectRefused(folder, before, run(folder, "sigloc-map", build), "bad.simplemap");
  // Of sound inputs they are said, and once, however many runs there are.
  writeConfig(folder, kLabMap.string(), kLabLog.string(),
              "experimentRepetitions = 2\nlogOutputdir = x\n");
  const auto sound = run(folder, "sigloc-localize", {"run.ini", "--quiet"});
  EXPECT_EQ(sound.exit_code, 0);
  EXPECT_EQ(countLines(sound.errors), 1) << sound.errors;
  EXPECT_NE(sound.errors.find("logOutputdir"), std::string::npos) << sound.errors;
}

TEST(BadInput, ofVeryManyWarningsTheFirstAreSaid)
{
  const TemporaryFolder folder;
  std::string keys;
  for (int i = 10; i < 99; ++i) keys += "rawlog_offset" + std::to_string(i) + " = 1\n";
  writeConfig(folder, kLabMap.string(), kLabLog.string(), keys);
  const auto result = run(folder, "sigloc-localize", {"run.ini", "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(countLines(result.errors), 21) << result.errors;
  EXPECT_NE(result.errors.find("run.ini: 69 more warnings"), std::string::npos) << result.errors;
}

TEST(BadInput, unknownSectionIsNamed)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string(), "[sigloc.trakcer]\nseed = 3\n");
  const auto before = listing(folder);
  const auto result = localize(folder, "new/out");
  expectRefused(folder, before, result, "run.ini");
  EXPECT_NE(result.errors.find("sigloc.trakcer"), std::string::npos) << result.errors;
}

TEST(BadInput, badValueIsNamed)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string(), "[sigloc.map]\nmerge_gap = wide\n");
  const auto before = listing(folder);
  const auto result = localize(folder, "new/out");
  expectRefused(folder, before, result, "run.ini");
  EXPECT_NE(result.errors.find("merge_gap"), std::string::npos) << result.errors;
}

TEST(BadInput, foreignOutputFolderIsLeftAlone)
{
  const TemporaryFolder folder;
  writeConfig(folder, kLabMap.string(), kLabLog.string());
  std::filesystem::create_directories(folder / "new/out");
  writeText(folder / "new/out/thesis.tex", "dear");
  const auto before = listing(folder);
  expectRefused(folder, before, localize(folder, "new/out"), "new/out");
}

TEST(BadInput, pictureOfAnotherKindIsRefused)
{
  const TemporaryFolder folder;
  expectRefused(folder, {}, run(folder, "sigloc-map", {"draw", "a.sigmap", "-o", "a.svg"}),
                "a.svg");
}

TEST(BadInput, unknownFlagIsRefused)
{
  const TemporaryFolder folder;
  for (const char* const program : {"sigloc-map", "sigloc-localize"})
  {
    expectRefused(folder, {}, run(folder, program, {"--no-such-flag"}), program);
  }
}
}  // namespace
}  // namespace sigloc
