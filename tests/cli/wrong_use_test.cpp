// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The command line without an ini, and the line that tells what to type instead.
#include <gtest/gtest.h>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// Expects one line that ends so, and nothing written.
void expectOneLine(const TemporaryFolder& folder, const std::string& program,
                   const Arguments& arguments, const std::string& ending)
{
  const auto before = listing(folder);
  const CommandResult result = run(folder, program, arguments);
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  EXPECT_NE(result.errors.find(ending + "\n"), std::string::npos)
      << result.errors << "does not end in " << ending;
  EXPECT_EQ(listing(folder), before);
}

TEST(CommandLine, aMapAndALogAreEnough)
{
  const TemporaryFolder folder;
  const CommandResult result =
      run(folder, "sigloc-localize",
          {"--map", kLabMap.string(), "--log", kLabLog.string(), "--out", "answer", "--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "");
  EXPECT_NE(result.output.find("\nat the end              localized ("), std::string::npos)
      << result.output;
  EXPECT_TRUE(std::filesystem::exists(folder / "answer/path.tum"));
}

TEST(CommandLine, aMapAndALogTakeThePlaceOfThoseOfTheIni)
{
  const TemporaryFolder folder;
  writeText(folder / "run.ini",
            "[LocalizationExperiment]\nmap_file = none.simplemap\nrawlog_file = none.rawlog\n");
  const Arguments both = {"run.ini", "--map", kLabMap.string(), "--log", kLabLog.string()};
  EXPECT_EQ(run(folder, "sigloc-localize", both).exit_code, 0);
  expectOneLine(folder, "sigloc-localize", {"run.ini", "--map", kLabMap.string()},
                "'rawlog_file' names none.rawlog, which does not exist");
}

TEST(CommandLine, aMapIsNamedAsOne)
{
  const TemporaryFolder folder;
  for (const std::string name : {"map.png", "map.yaml", "map"})
  {
    expectOneLine(folder, "sigloc-map", {"build", "-i", kLabMap.string(), "-o", name},
                  name + ": a map's name must end in .sigmap");
  }
}

TEST(CommandLine, aMapAndALogWithoutTheirKeysAreNoIni)
{
  const TemporaryFolder folder;
  writeText(folder / "map.yaml", "image: map.pgm\nresolution: 0.05\n");
  expectOneLine(folder, "sigloc-localize", {"map.yaml", kLabLog.string()},
                "no section [LocalizationExperiment]; for a map and a log: --map MAP --log LOG");
}

TEST(CommandLine, aLinkToAProgramWorks)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink(std::string(SIGLOC_BIN_FOLDER) + "/sigloc-localize",
                                  folder / "link");
  EXPECT_EQ(runShell(folder, "./link --print-defaults").exit_code, 0);
}

TEST(CommandLine, aProgramWithoutItsLibrariesSaysSo)
{
  const TemporaryFolder folder;
  for (const std::string program : {"sigloc-localize", "sigloc-map", "sigloc-align"})
  {
    const std::filesystem::path alone = folder / program;
    std::filesystem::copy_file(std::string(SIGLOC_BIN_FOLDER) + "/" + program, alone);
    const Arguments map = {program == "sigloc-map" ? "info" : kLabMap.string(), kLabMap.string()};
    std::string command = quoted(alone.string());
    for (const std::string& argument : map) command += " " + quoted(argument);
    const CommandResult result = runShell(folder, command);
    EXPECT_EQ(result.exit_code, 1) << program;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("sigloc/" + program + ".so: cannot open shared object"),
              std::string::npos)
        << result.errors;
    EXPECT_EQ(runShell(folder, quoted(alone.string()) + " --help").exit_code, 0);
  }
}

TEST(CommandLine, everyProgramTellsItsVersion)
{
  const TemporaryFolder folder;
  for (const std::string program :
       {"sigloc-localize", "sigloc-map", "sigloc-eval", "sigloc-simulate"})
  {
    const CommandResult result = run(folder, program, {"--version"});
    EXPECT_EQ(result.exit_code, 0) << program;
    EXPECT_EQ(result.output.rfind(program + " ", 0), 0U) << result.output;
    EXPECT_EQ(countLines(result.output), 1) << result.output;
  }
}

TEST(CommandLine, missingArgumentsAreTold)
{
  const TemporaryFolder folder;
  const std::string needed = "needs --map MAP --log LOG.rawlog, or CONFIG.ini; see --help";
  expectOneLine(folder, "sigloc-localize", {}, needed);
  expectOneLine(folder, "sigloc-localize", {"--map", kLabMap.string()}, needed);
}

TEST(CommandLine, misspeltOptionsAndCommandsAreTold)
{
  const TemporaryFolder folder;
  expectOneLine(folder, "sigloc-localize", {"--mpa", "x", "--log", "y"},
                "no such option: --mpa; did you mean '--map'?");
  expectOneLine(folder, "sigloc-localize", {"--map", "x", "--log", "y", "--ouput=z"},
                "no such option: --ouput=z; did you mean '--out'?");
  expectOneLine(folder, "sigloc-localize", {"--map", "x", "--rawlog", "y"},
                "no such option: --rawlog; did you mean '--log'?");
  expectOneLine(folder, "sigloc-eval", {"track", "--map", "x", "--log", "y"},
                "no such option: --log; did you mean '--rawlog'?");
  expectOneLine(folder, "sigloc-localize", {"a.ini", "b.rawlog", "c"},
                "one argument too many: c; type: sigloc-localize [OPTIONS] [CONFIG.ini] "
                "[DATASET.rawlog]");
  expectOneLine(folder, "sigloc-map", {"info", "x.sigmap", "y.sigmap"},
                "one argument too many: y.sigmap; type: sigloc-map info [OPTIONS] file");
  expectOneLine(folder, "sigloc-map", {"build", "x.simplemap", "x.sigmap"},
                "one argument too many: x.simplemap; type: sigloc-map build -i INPUT -o OUTPUT "
                "[OPTIONS]");
  expectOneLine(folder, "sigloc-localize", {"--frobnicate"},
                "no such option: --frobnicate; see --help");
  expectOneLine(folder, "sigloc-map", {"buidl"}, "no such command: buidl; did you mean 'build'?");
  expectOneLine(folder, "sigloc-map", {"info", "x.sigmap", "--jsno"},
                "no such option: --jsno; did you mean '--json'?");
}

TEST(CommandLine, aRawlogIsNoMap)
{
  const TemporaryFolder folder;
  for (const char* const name : {"drive.rawlog", "drive.rawlog.gz"})
  {
    writeText(folder / name, "x");
    expectOneLine(folder, "sigloc-map", {"info", name},
                  std::string(name) +
                      ": a rawlog is the log of a drive, not a map; icp-slam makes a map of it");
  }
}

TEST(CommandLine, whatIsMissingOrTooManyIsToldByName)
{
  const TemporaryFolder folder;
  expectOneLine(folder, "sigloc-map", {}, "no command given: build, info, draw, check; see --help");
  expectOneLine(folder, "sigloc-align", {"A"}, "B is required; type: sigloc-align [OPTIONS] A B");
  expectOneLine(folder, "sigloc-map", {"build", "-i", "x"},
                "--out is required; see sigloc-map build --help");
  const auto refused = [&](Arguments more, const std::string& ending)
  {
    more.insert(more.begin(), {"--log", "y"});
    expectOneLine(folder, "sigloc-localize", more, ending);
  };
  const std::string heights =
      ": LOW,HIGH [m] above the robot's base, or the map's origin: which 3D "
      "points count as walls (default: 0.2,1.5)";
  refused({"--map", "x", "--heights", "2"}, "--heights needs 2 values, not 1" + heights);
  refused({"--map", "x", "--heights", "1,2,3"}, "--heights needs 2 values, not 3" + heights);
  refused({"--map", kLabMap.string(), "--heights", "2,1"},
          "--heights LOW,HIGH: LOW is not below HIGH");
  refused({"--map", "x", "--seed", "-1"}, "--seed: -1: not a number from 0 to 4294967295");
  refused({"--map", "x", "--map", "z"}, "--map is given 2 times; give one");
  refused({"--map", "x", "--quiet=loud"}, "--quiet takes no value");
  refused({"--map", "x", "extra"},
          "one argument too many: extra, which is no ini; --map and --log are enough");
  refused({"--map", "x", "--out"}, "--out needs a value; see --help");
  expectOneLine(folder, "sigloc-map", {"check", "x", "--places", "1.5"},
                "--places: bad value '1.5'");
}

TEST(CommandLine, aMapAndALogThatAreSwappedAreTold)
{
  const TemporaryFolder folder;
  std::filesystem::copy_file(kLabMap, folder / "m.simplemap.gz");
  std::filesystem::copy_file(kLabLog, folder / "d.rawlog");
  expectOneLine(folder, "sigloc-localize",
                {"--map", "d.rawlog", "--log", "m.simplemap.gz", "--out", "x"},
                "map and log look swapped; did you mean --map m.simplemap.gz --log d.rawlog?");
  writeText(folder / "run.ini",
            "[LocalizationExperiment]\nmap_file = d.rawlog\nrawlog_file = m.simplemap.gz\n");
  expectOneLine(folder, "sigloc-localize", {"run.ini"},
                "did you mean map_file = m.simplemap.gz and rawlog_file = d.rawlog?");
  // The name of a CARMEN log may be that of a map.
  expectOneLine(folder, "sigloc-localize", {"--map", "d.log", "--log", "m.yaml"},
                "map and log look swapped; did you mean --map m.yaml --log d.log?");
  expectOneLine(folder, "sigloc-localize", {"--map", "d.log", "--log", "e.log"},
                "e.log: no such file");
}

TEST(CommandLine, aFolderGivenAsAMapIsToldWithAMapInIt)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "maps");
  expectOneLine(folder, "sigloc-map", {"info", "maps"},
                "maps: is a folder, not a file; no map is in it");
  for (const char* const name : {"floor.png", "floor.yaml", "notes.md"})
    writeText(folder / (std::string("maps/") + name), "x");
  const std::string told = "maps: is a folder, not a file; did you mean 'maps/floor.yaml'?";
  expectOneLine(folder, "sigloc-map", {"info", "maps"}, told);
  expectOneLine(folder, "sigloc-map", {"check", "maps", "--out", "x"}, told);
  expectOneLine(folder, "sigloc-localize",
                {"--map", "maps", "--log", kLabLog.string(), "--out", "x"}, told);
}

TEST(CommandLine, twoLogsAreTold)
{
  const TemporaryFolder folder;
  expectOneLine(folder, "sigloc-localize", {"--map", "m", "--log", "a", "b.ini", "c"},
                "two logs: --log a and the argument c; give one");
}

TEST(CommandLine, aMapAndALogAsArgumentsAreNoIni)
{
  const TemporaryFolder folder;
  expectOneLine(folder, "sigloc-localize", {kOffice.string(), kLabLog.string()},
                "not an ini file; for a map and a log: --map MAP --log LOG");
}

TEST(CommandLine, everyProgramTakesOut)
{
  const TemporaryFolder folder;
  for (const auto& [program, command] :
       std::vector<std::pair<std::string, std::string>>{{"sigloc-localize", ""},
                                                        {"sigloc-map", "build"},
                                                        {"sigloc-map", "draw"},
                                                        {"sigloc-map", "check"},
                                                        {"sigloc-align", ""},
                                                        {"sigloc-simulate", ""},
                                                        {"sigloc-eval", "relocate"},
                                                        {"sigloc-eval", "reference"},
                                                        {"sigloc-eval", "merge"},
                                                        {"sigloc-bag2rawlog", ""}})
  {
    Arguments arguments = {"--help"};
    if (!command.empty()) arguments.insert(arguments.begin(), command);
    const CommandResult result = run(folder, program, arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.output.find("-o,--out"), std::string::npos) << program << " " << command;
  }
  for (const char* const name : {"-o", "--out", "--output"})
  {
    EXPECT_EQ(
        run(folder, "sigloc-map", {"build", "-i", kLabMap.string(), name, "m.sigmap"}).exit_code, 0)
        << name;
    std::filesystem::remove(folder / "m.sigmap");
  }
}

TEST(CommandLine, aLineBreakInANameHidesNoReason)
{
  const TemporaryFolder folder;
  const std::string shown = ": a?b";
  const std::string lab = kLabMap.string();
  expectOneLine(folder, "sigloc-map", {"build", "-i", "a\nb.simplemap", "-o", "m.sigmap"},
                shown + ".simplemap: no such file");
  for (const std::string name : {"a\nb.simplemap", "a\nb.sigmap", "a\nb.yaml", "a\nb.rawlog",
                                 "a\nb.csv", "a\nb.ini", "a\x1B[2Jb"})
  {
    writeText(folder / name, "spoilt\n");
    for (const auto& [program, arguments] : std::vector<std::pair<std::string, Arguments>>{
             {"sigloc-map", {"build", "-i", name, "-o", "m.sigmap"}},
             {"sigloc-map", {"info", name}},
             {"sigloc-map", {"build", "-i", lab, "-o", "none\n/m.sigmap"}},
             {"sigloc-align", {lab, name}},
             {"sigloc-localize", {name}},
             {"sigloc-localize", {"--map", lab, "--log", name}},
             {"sigloc-localize", {"--map", name, "--log", kLabLog.string()}},
             {"sigloc-localize", {"--map", lab, "--log", kLabLog.string(), "--out", name}}})
    {
      SCOPED_TRACE(program + " " + arguments.front());
      const CommandResult result = run(folder, program, arguments);
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_EQ(countLines(result.errors), 1) << result.errors;
      const std::size_t at = result.errors.find(": ", result.errors.find('?'));
      ASSERT_NE(at, std::string::npos) << result.errors;
      EXPECT_GT(result.errors.size(), at + 8) << result.errors << "names no reason";
    }
  }
}

TEST(CommandLine, misspeltFilesAndKeysAreTold)
{
  const TemporaryFolder folder;
  std::filesystem::copy_file(kLabLog, folder / "drive.rawlog");
  expectOneLine(folder, "sigloc-localize", {"--map", kLabMap.string(), "--log", "dirve.rawlog"},
                "dirve.rawlog: no such file; did you mean 'drive.rawlog'?");
  writeText(folder / "run.ini", "[LocalizationExperiment]\nmap_file = " + kLabMap.string() +
                                    "\nrawlog_file = drive.ralwog\n");
  expectOneLine(folder, "sigloc-localize", {"run.ini"},
                "'rawlog_file' names drive.ralwog, which does not exist; did you mean "
                "'drive.rawlog'?");
  writeText(folder / "run.ini", "[LocalizationExperiment]\nmap_file = " + kLabMap.string() +
                                    "\nrawlog_file = drive.rawlog\n[sigloc.matcher]\nsede = 3\n");
  expectOneLine(folder, "sigloc-localize", {"run.ini"}, "unknown key 'sede'; did you mean 'seed'?");
}
}  // namespace
}  // namespace sigloc
