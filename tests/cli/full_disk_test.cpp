// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// When the output does not fit, a program writes one line and exits with 1. No half-written file is
// left.
#include <gtest/gtest.h>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using namespace sigloc::test;

/// Runs a program whose files must not grow beyond so many bytes.
CommandResult runLimited(const TemporaryFolder& folder, std::size_t bytes,
                         const std::string& program, const Arguments& arguments)
{
  constexpr std::size_t kBlock = 512;  // of POSIX's ulimit
  return runShell(folder, "ulimit -f " + std::to_string(bytes / kBlock) + "; " +
                              commandLine(program, arguments));
}

void expectOneLine(const CommandResult& result, const std::string& file)
{
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(file + ": cannot be written: File too large"), std::string::npos)
      << result.errors;
}

void writeOfficeConfig(const TemporaryFolder& folder)
{
  writeConfig(folder, kOffice.string(), (kSources / "rawlogs/office.rawlog").string(), kNoPictures);
}

TEST(FullDisk, aRunWritesAllOrNothing)
{
  const TemporaryFolder folder;
  writeOfficeConfig(folder);
  const Arguments arguments = {"run.ini", "--quiet", "--out", "out"};
  const std::size_t room = 163840;  // enough for all but the log with its poses
  const auto limited = [&] { return runLimited(folder, room, "sigloc-localize", arguments); };
  expectOneLine(limited(), "annotated.rawlog");
  EXPECT_EQ(listing(folder).size(), 1U) << "the ini";

  ASSERT_EQ(run(folder, "sigloc-localize", arguments).exit_code, 0);
  ASSERT_GT(fs::file_size(folder / "out/annotated.rawlog"), room);
  const auto before = listing(folder);
  const std::string steps = readBytes(folder / "out/steps.csv");
  expectOneLine(limited(), "annotated.rawlog");
  EXPECT_EQ(listing(folder), before);
  EXPECT_EQ(readBytes(folder / "out/steps.csv"), steps);
}

TEST(FullDisk, aRunReplacesWhatAKilledOneLeft)
{
  const TemporaryFolder folder;
  writeOfficeConfig(folder);
  fs::create_directories(folder / "out.partial/belief");
  writeText(folder / "out.partial/belief/step_00001.txt.part-77", "1");
  writeText(folder / "out.partial/annotated.rawlog.part-77", "1");
  const CommandResult result = run(folder, "sigloc-localize", {"run.ini", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_FALSE(fs::exists(folder / "out.partial"));
}

TEST(FullDisk, picturesAndMapsStayAsTheyWere)
{
  const TemporaryFolder folder;
  const Arguments build = {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"};
  ASSERT_EQ(run(folder, "sigloc-map", build).exit_code, 0);
  writeText(folder / "old.png", "old");
  const std::string map = readBytes(folder / "lab.sigmap");
  expectOneLine(runLimited(folder, 8192, "sigloc-map", build), "lab.sigmap");
  expectOneLine(runLimited(folder, 8192, "sigloc-map", {"draw", "lab.sigmap", "-o", "old.png"}),
                "old.png");
  EXPECT_EQ(readBytes(folder / "old.png"), "old");
  EXPECT_EQ(readBytes(folder / "lab.sigmap"), map);
  EXPECT_EQ(listing(folder).size(), 2U);
  expectOneLine(runLimited(folder, 8192, "sigloc-map", {"check", "lab.sigmap", "--out", "checked"}),
                "checked/check.png");
  EXPECT_FALSE(fs::exists(folder / "checked"));
  const CommandResult result =
      run(folder, "sigloc-map", {"draw", "lab.sigmap", "-o", "none/map.png"});
  EXPECT_NE(result.errors.find("none/map.png: there is no folder none"), std::string::npos)
      << result.errors;
}

TEST(FullDisk, aReportIsWholeOrNotThere)
{
  const TemporaryFolder folder;
  const Arguments arguments = {"relocate",
                               "--map",
                               (kSources / "maps/office.simplemap").string(),
                               "--rawlog",
                               (kSources / "rawlogs/office.rawlog").string(),
                               "--ground-truth",
                               (kSources / "rawlogs/office-truth.txt").string(),
                               "--max-queries",
                               "2",
                               "--method",
                               "signature",
                               "--quiet",
                               "--out",
                               "out"};
  expectOneLine(runLimited(folder, 8192, "sigloc-eval", arguments), "out/report.html");
  EXPECT_TRUE(listing(folder).empty());
  EXPECT_EQ(run(folder, "sigloc-eval", arguments).exit_code, 0);
}

TEST(FullDisk, lostOutputIsAnError)
{
  const TemporaryFolder folder;
  ASSERT_EQ(
      run(folder, "sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"}).exit_code,
      0);
  const std::vector<std::pair<std::string, Arguments>> commands = {
      {"sigloc-map", {"info", "lab.sigmap"}},
      {"sigloc-map", {"--help"}},
      {"sigloc-localize", {"--print-defaults"}},
      {"sigloc-eval", {"--help"}}};
  for (const auto& [program, arguments] : commands)
  {
    const CommandResult result = runShell(folder, commandLine(program, arguments) + " >/dev/full");
    EXPECT_EQ(result.exit_code, 1) << program;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("standard output: cannot be written: No space left on device"),
              std::string::npos)
        << result.errors;
  }
}

TEST(FullDisk, withoutStandardOutputNothingIsWritten)
{
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, Arguments>> commands = {
      {"sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"}},
      {"sigloc-localize",
       {"--map", kLabMap.string(), "--log", kLabLog.string(), "--out", "out", "--quiet"}}};
  for (const auto& [program, arguments] : commands)
  {
    const CommandResult result = runShell(folder, commandLine(program, arguments) + " >&-");
    EXPECT_EQ(result.exit_code, 1) << program;
    EXPECT_EQ(result.errors, program + ": standard output: is closed\n");
    EXPECT_TRUE(listing(folder).empty()) << program;
  }
}

TEST(FullDisk, withoutTheOtherStreamsResultsAreTheSame)
{
  const TemporaryFolder folder;
  const auto build = [&](const std::string& output, const std::string& closed)
  {
    const Arguments arguments = {"build", "-i", kLabMap.string(), "-o", output};
    const auto result = runShell(folder, commandLine("sigloc-map", arguments) + closed);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return readBytes(folder / output);
  };
  EXPECT_TRUE(build("a.sigmap", "") == build("b.sigmap", " <&- 2>&-"));
  // No file that is opened takes the number of a stream.
  const auto info = runShell(folder, commandLine("sigloc-map", {"info", "/dev/fd/0"}) + " <&-");
  EXPECT_EQ(info.errors, "sigloc-map: /dev/fd/0: is no regular file\n");
}

TEST(FullDisk, aFolderThatIsGoneIsToldInOneLine)
{
  const TemporaryFolder folder;
  const Arguments build = {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"};
  const auto result =
      runShell(folder, "mkdir gone; cd gone; rmdir ../gone; " + commandLine("sigloc-map", build));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(": No such file or directory"), std::string::npos) << result.errors;
}
}  // namespace
}  // namespace sigloc
