// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "bridge/rawlog_files.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;

/// Runs sigloc-simulate; its output goes to `folder`/out and `folder`/err.
int simulate(const test::TemporaryFolder& folder, const std::string& arguments,
             const std::string& before = {})
{
  const std::string command = before + std::string(SIGLOC_SIMULATE) + " " + arguments +
                              " </dev/null >" + (folder / "out").string() + " 2>" +
                              (folder / "err").string();
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(SimulateApp, WritesEveryWorldTheSameTwice)
{
  for (const char* world : {"office", "corridor", "hall", "park", "points", "round"})
  {
    const test::TemporaryFolder folder;
    const bool scanned = std::string(world) != "points";
    const std::string arguments =
        std::string("--metres 5 ") + (scanned ? "--map-spacing 6 " : "") + "--world " + world;
    ASSERT_EQ(simulate(folder, arguments + " --out " + (folder / "a").string()), 0) << world;
    ASSERT_EQ(simulate(folder, arguments + " --out " + (folder / "b").string()), 0) << world;
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder / "a"))
    {
      const fs::path twin = folder / "b" / entry.path().filename();
      EXPECT_GT(fs::file_size(entry.path()), 0U) << entry.path();
      EXPECT_EQ(test::readBytes(entry.path()), test::readBytes(twin)) << entry.path();
      ++files;
    }
    EXPECT_EQ(files, std::string(world) == "points" ? 4U : 5U) << world;
  }
}

TEST(SimulateApp, ManyBuildingsAndQueriesAreTheSameTwice)
{
  const test::TemporaryFolder folder;
  for (const char* name : {"a", "b"})
  {
    ASSERT_EQ(simulate(folder, "--metres 5 --map-spacing 6 --buildings 3 --queries 4 --out " +
                                   (folder / name).string()),
              0);
  }
  for (const char* file : {"map.simplemap", "map.gridmap.gz", "queries.simplemap"})
  {
    EXPECT_EQ(test::readBytes(folder / "a" / file), test::readBytes(folder / "b" / file)) << file;
  }
}

TEST(SimulateApp, NamesTheFlagThatIsBad)
{
  for (const auto& [arguments, flag] :
       {std::pair{"--seed -1", "--seed"}, std::pair{"--drive-seed -1", "--drive-seed"},
        std::pair{"--noise -1", "--noise"}, std::pair{"--range nan", "--range"},
        std::pair{"--odometry-a1 1e9", "--odometry-a1"}})
  {
    const test::TemporaryFolder folder;
    EXPECT_NE(simulate(folder, std::string(arguments) + " --out " + (folder / "new").string()), 0);
    const std::string error = test::readBytes(folder / "err");
    EXPECT_NE(error.find(flag), std::string::npos) << error;
    EXPECT_FALSE(fs::exists(folder / "new"));
  }
}

TEST(SimulateApp, BadArgumentsGiveOneLineAndNothingElse)
{
  for (const char* arguments : {"--world moon --out DIR",
                                "--seed x --out DIR",
                                "--clutter 2 --out DIR",
                                "--metres nan --out DIR",
                                "--width 3 --out DIR",
                                "--clearance 5 --out DIR",
                                "--world office --copies 3 --out DIR",
                                "--world hall --door-width 1 --out DIR",
                                "--world points --fov 180 --out DIR",
                                "--world park --landmark-range 9 --out DIR",
                                "--world points --map-spacing 2 --out DIR",
                                "--world corridor --points 9 --out DIR",
                                "--world park --moved-share 0.5 --out DIR",
                                "--world points --width 40 --out DIR",
                                "--world park --buildings 2 --out DIR",
                                "--world points --buildings 2 --out DIR",
                                "--buildings 0 --out DIR",
                                "--world points --queries 3 --out DIR",
                                "--world points --identical --out DIR",
                                "--no-such-flag --out DIR",
                                "--out /proc/none",
                                "",
                                "--out DIR/err/below"})
  {
    const test::TemporaryFolder folder;
    std::string text = arguments;
    if (const auto at = text.find("DIR"); at != std::string::npos)
    {
      text.replace(at, 3,
                   text.find("DIR/") == at ? folder.path().string() : (folder / "x").string());
    }
    EXPECT_EQ(simulate(folder, text), 1) << arguments;
    const std::string errors = test::readBytes(folder / "err");
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
    EXPECT_TRUE(test::readBytes(folder / "out").empty()) << arguments;
    EXPECT_FALSE(fs::exists(folder / "x")) << arguments;
  }
}

TEST(SimulateApp, ReplacesOnlySimulations)
{
  const test::TemporaryFolder folder;
  const fs::path mine = folder / "mine";
  fs::create_directory(mine);
  const std::string arguments = "--world points --metres 5 --out " + mine.string();
  for (const char* name : {"README.md", "drive.rawlog", "truth.txt"})
  {
    test::writeText(mine / name, "mine");
    EXPECT_EQ(simulate(folder, arguments), 1) << name;
    const std::string errors = test::readBytes(folder / "err");
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
    EXPECT_NE(errors.find(mine.string() + ": holds " + name), std::string::npos) << errors;
    EXPECT_EQ(test::readBytes(mine / name), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(mine), {}), 1) << name;
    fs::remove(mine / name);
  }
  test::writeText(mine / "notes.txt", "mine");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(simulate(folder, arguments), 0) << "an earlier one is";
  EXPECT_EQ(test::readBytes(mine / "notes.txt"), "mine");
}

TEST(SimulateApp, WhatDoesNotFitGivesOneLineAndNothingElse)
{
  const test::TemporaryFolder folder;
  const std::string out = (folder / "x").string();
  EXPECT_EQ(simulate(folder, "--metres 5 --out " + out, "ulimit -f 80; "), 1);
  EXPECT_EQ(test::readBytes(folder / "err"), "sigloc-simulate: " + out +
                                                 "/map.simplemap: cannot be written: File too "
                                                 "large\n");
  EXPECT_FALSE(fs::exists(out));
}

TEST(SimulateApp, HelpEndsWell)
{
  const test::TemporaryFolder folder;
  EXPECT_EQ(simulate(folder, "--help"), 0);
  EXPECT_NE(test::readBytes(folder / "out").find("--world"), std::string::npos);
}
}  // namespace
}  // namespace sigloc
