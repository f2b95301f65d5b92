// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sigloc/io/file_output.h"

namespace sigloc
{
/// Prints one line about a file on stderr, unless the line is empty.
inline void warn(const char* program, const std::filesystem::path& file, const std::string& message)
{
  if (!message.empty()) std::cerr << program << ": " << file.string() << ": " << message << '\n';
}

/// What every program does: parses the command line, runs `work`, and reports an error in one line.
/// Lost output is an error, too. Returns the exit code: that of `work`, 0 after --help, else 1.
inline int runApp(CLI::App& app, int argc, char** argv, const std::function<int()>& work)
{
  try
  {
    int code = 0;
    try
    {
      app.parse(argc, argv);
      code = work();
    }
    catch (const CLI::Success& help)
    {
      code = app.exit(help);
    }
    catch (const CLI::RequiredError&)
    {
      // CLI11 would call a word that is no command a missing one.
      const std::vector<std::string> unknown = app.remaining();
      if (app.get_require_subcommand_min() == 0 || unknown.empty()) throw;
      throw std::invalid_argument("no such command: " + unknown.front());
    }
    finishOutput(std::cout);
    return code;
  }
  catch (const std::exception& error)
  {
    std::cerr << app.get_name() << ": " << firstLine(error.what()) << '\n';
    return 1;
  }
}
}  // namespace sigloc
