// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "manual.h"
#include "sigloc/config/option_fields.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
/// The commands of a program, or the options of the command that was given and of the program.
inline std::vector<std::string> knownWords(const CLI::App& app)
{
  std::vector<std::string> words;
  const auto add = [&words](const CLI::App& command)
  {
    for (const CLI::Option* option : command.get_options())
    {
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    }
  };
  add(app);
  for (const CLI::App* command : app.get_subcommands()) add(*command);
  for (const CLI::App* command : app.get_subcommands({})) words.push_back(command->get_name());
  return words;
}

/// What is wrong with the first word that the program does not know.
inline std::string unknownWord(const CLI::App& app)
{
  const std::vector<std::string> words = app.remaining(true);
  const std::string word = words.empty() ? "" : words.front();
  const bool option = word.rfind('-', 0) == 0;
  const bool command = app.get_require_subcommand_min() > 0 && app.get_subcommands().empty();
  const std::string what = option    ? "no such option: "
                           : command ? "no such command: "
                                     : "one argument too many: ";
  const std::string hint = didYouMean(word.substr(0, word.find('=')), knownWords(app));
  if (!hint.empty()) return what + word + hint;
  return what + word + (option || command ? "; see --help" : "; type: " + usage(app));
}

/// Prints what the build makes the man page and the completion from, where the only argument asks
/// for it. Nobody types that, so --help does not show it.
inline bool printManual(const CLI::App& app, int argc, char** argv)
{
  const std::string asked = argc == 2 ? argv[1] : "";
  if (asked == "--print-man-page") std::cout << manPage(app, "sigloc " SIGLOC_VERSION);
  if (asked == "--print-completion") std::cout << bashCompletion(app);
  return asked == "--print-man-page" || asked == "--print-completion";
}

/// What every program does: parses the command line, runs `work`, and reports an error in one line.
/// Lost output is an error, too. Returns the exit code: that of `work`, 0 after --help and
/// --version, else 1. Sets the process's handling of SIGXFSZ, and an environment variable of Mesa.
inline int runApp(CLI::App& app, int argc, char** argv, const std::function<int()>& work)
{
  // A file that grows over its limit is a failed write then, and told in one line.
  std::signal(SIGXFSZ, SIG_IGN);
  // Mesa would die by a signal where the disk of its cache is full.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  try
  {
    int code = 0;
    app.set_version_flag("--version", app.get_name() + " " + SIGLOC_VERSION);
    try
    {
      if (!printManual(app, argc, argv))
      {
        app.parse(argc, argv);
        code = work();
      }
    }
    catch (const CLI::Success& help)
    {
      code = app.exit(help);
    }
    catch (const CLI::ExtrasError&)
    {
      throw std::invalid_argument(unknownWord(app));
    }
    catch (const CLI::RequiredError&)
    {
      // CLI11 would call a word that is no command a missing one.
      if (app.remaining(true).empty()) throw;
      throw std::invalid_argument(unknownWord(app));
    }
    finishOutput(std::cout);
    return code;
  }
  catch (const std::exception& error)
  {
    std::cerr << app.get_name() << ": " << oneLine(error.what()) << '\n';
    return 1;
  }
}
}  // namespace sigloc
