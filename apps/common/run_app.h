// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "manual.h"
#include "sigloc/io/file_output.h"
#include "wrong_use.h"

namespace sigloc
{
/// Prints what the build makes the man page and the completion from, where the only argument asks
/// for it. Nobody types that, so --help does not show it.
inline bool printManual(const CLI::App& app, int argc, char** argv)
{
  const std::string asked = argc == 2 ? argv[1] : "";
  if (asked == "--print-man-page") std::cout << manPage(app, "sigloc " SIGLOC_VERSION);
  if (asked == "--print-completion") std::cout << bashCompletion(app);
  return asked == "--print-man-page" || asked == "--print-completion";
}

/// A file that is opened takes the number of a standard stream that is closed, and would get what
/// the program writes to that. Throws std::runtime_error for a closed standard output: results
/// would be lost.
inline void replaceClosedStreams()
{
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
  {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    const bool replaced = open("/dev/null", O_RDWR) == stream;
    if (stream == STDOUT_FILENO) throw std::runtime_error("standard output: is closed");
    if (!replaced) throw std::runtime_error("/dev/null: cannot be opened for a closed stream");
  }
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
    replaceClosedStreams();
    app.set_version_flag("--version", app.get_name() + " " + SIGLOC_VERSION);
    const auto help = std::make_shared<HelpFormatter>();
    app.formatter(help);
    for (CLI::App* command : app.get_subcommands({})) command->formatter(help);
    try
    {
      if (!printManual(app, argc, argv))
      {
        app.parse(argc, argv);
        code = work();
      }
    }
    catch (const CLI::Success& asked)
    {
      code = app.exit(asked);
    }
    catch (const CLI::ParseError& error)
    {
      throw std::invalid_argument(wrongUse(app, error));
    }
    finishOutput(std::cout);
    return code;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << app.get_name() << ": not enough memory\n";
    return 1;
  }
  catch (const std::filesystem::filesystem_error& error)
  {
    const std::string reason = error.path1().string() + ": " + error.code().message();
    std::cerr << app.get_name() << ": " << oneLine(reason) << '\n';
    return 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << app.get_name() << ": " << oneLine(error.what()) << '\n';
    return 1;
  }
}
}  // namespace sigloc
