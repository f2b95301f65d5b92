// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The man page and the completion of every program know the options and commands of its --help, and
// no others.
#include <gtest/gtest.h>

#include <sstream>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using Words = std::set<std::string>;

/// All programs: the last are built where Python and ROS 1 are.
std::vector<std::string> programs()
{
  std::vector<std::string> names = {"sigloc-align", "sigloc-eval", "sigloc-localize", "sigloc-map",
                                    "sigloc-simulate"};
  std::istringstream more(SIGLOC_MORE_PROGRAMS);
  for (std::string name; more >> name;) names.push_back(name);
  return names;
}

/// What a program prints. No master of ROS runs, and it must not wait for one.
std::string printed(const std::string& program, const Arguments& arguments)
{
  const TemporaryFolder folder;
  const CommandResult result =
      runShell(folder, "unset ROS_MASTER_URI; timeout 60 " + commandLine(program, arguments));
  EXPECT_EQ(result.exit_code, 0) << program << result.errors;
  return result.output;
}

/// Adds the long options of an entry, "-o,--output" or "--no-odometry{false}".
void addLongNames(const std::string& entry, Words& options)
{
  std::istringstream names(entry);
  for (std::string name; std::getline(names, name, ',');)
  {
    if (name.rfind("--", 0) == 0) options.insert(name.substr(0, name.find('{')));
  }
}

/// What a help lists, in lines that begin with two blanks and a name.
struct Help
{
  Words options;
  Words commands;
};

Help helpOf(const std::string& program, const Arguments& command)
{
  Arguments arguments = command;
  arguments.emplace_back("--help");
  std::istringstream lines(printed(program, arguments));
  Help help;
  bool in_commands = false;
  for (std::string line; std::getline(lines, line);)
  {
    if (line == "Subcommands:") in_commands = true;
    if (line.rfind("  ", 0) != 0 || line[2] == ' ') continue;
    const std::string entry = line.substr(2, line.find(' ', 2) - 2);
    in_commands ? void(help.commands.insert(entry)) : addLongNames(entry, help.options);
  }
  return help;
}

/// What a completion offers for the last of these words.
Words offers(const std::string& completion, const Arguments& words)
{
  const TemporaryFolder folder;
  writeText(folder / "completion", completion);
  std::string typed = "program";
  for (const std::string& word : words) typed += " " + quoted(word);
  writeText(folder / "ask", "complete() { function=$4; }\n. ./completion\nCOMP_WORDS=(" + typed +
                                ")\nCOMP_CWORD=" + std::to_string(words.size()) +
                                "\n\"$function\"\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const CommandResult result = runShell(folder, "bash -u ask");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  std::istringstream lines(result.output);
  Words offered;
  for (std::string line; std::getline(lines, line);) offered.insert(line);
  return offered;
}

/// The long options that a part of a man page describes.
Words optionsIn(const std::string& page)
{
  Words options;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);)
  {
    const std::string bold = "\\fB";
    if (line.rfind(bold, 0) != 0) continue;
    std::string entry = line.substr(bold.size(), line.find("\\fR") - bold.size());
    entry.erase(std::remove(entry.begin(), entry.end(), '\\'), entry.end());
    addLongNames(entry, options);
  }
  return options;
}

/// The part of a man page from one mark to the next that begins alike, or to the end.
std::string partOf(const std::string& page, const std::string& mark)
{
  const std::size_t begin = page.find(mark);
  if (begin == std::string::npos) return "";
  const std::size_t end = page.find("\n.S", begin + mark.size());
  return page.substr(begin, end == std::string::npos ? end : end - begin);
}

TEST(Manual, everyProgramIsDescribedAlikeInAllThree)
{
  std::size_t options = 0;
  for (const std::string& program : programs())
  {
    const std::string page = printed(program, {"--print-man-page"});
    const std::string completion = printed(program, {"--print-completion"});
    const Help help = helpOf(program, {});
    ASSERT_GE(help.options.size(), 2U) << program << " has at least --help and --version";
    EXPECT_EQ(optionsIn(partOf(page, ".SH OPTIONS")), help.options) << program;
    EXPECT_EQ(offers(completion, {"--"}), help.options) << program;
    EXPECT_EQ(offers(completion, {""}), help.commands.empty() ? Words{""} : help.commands);
    for (const std::string& command : help.commands)
    {
      const Help of_command = helpOf(program, {command});
      std::string heading = ".SS " + program + " " + command + " ";
      for (std::size_t at = 0; (at = heading.find('-', at)) != std::string::npos; at += 2)
      {
        heading.insert(at, 1, '\\');
      }
      EXPECT_EQ(optionsIn(partOf(page, heading)), of_command.options) << program << ' ' << command;
      EXPECT_EQ(offers(completion, {command, "--"}), of_command.options)
          << program << ' ' << command;
      options += of_command.options.size();
    }
    options += help.options.size();
  }
  EXPECT_GT(options, 100U);
}

TEST(Manual, everyProgramTellsItsVersion)
{
  for (const std::string& program : programs())
    EXPECT_EQ(printed(program, {"--version"}).rfind(program + " 0.", 0), 0U) << program;
}

TEST(Manual, itsPagesAreSoundRoff)
{
  const TemporaryFolder folder;
  for (const std::string& program : programs())
  {
    writeText(folder / "page.1", printed(program, {"--print-man-page"}));
    const CommandResult result = runShell(folder, "groff -man -Tutf8 -P-cbou -ww page.1");
    EXPECT_EQ(result.exit_code, 0) << program;
    EXPECT_EQ(result.errors, "") << program;
    EXPECT_NE(result.output.find("SYNOPSIS"), std::string::npos) << program;
  }
}

// Where nothing is offered bash completes the names of files.
TEST(Manual, aWordThatIsNoCommandGivesNone)
{
  const std::string completion = printed("sigloc-map", {"--print-completion"});
  EXPECT_EQ(offers(completion, {"b"}), Words{"build"});
  EXPECT_EQ(offers(completion, {"build", "-i", "a"}), Words{""});
}
}  // namespace
}  // namespace sigloc
