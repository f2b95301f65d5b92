// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "bridge/rawlog_files.h"

namespace sigloc::test
{
using Arguments = std::vector<std::string>;

inline const std::filesystem::path kSources =
    std::filesystem::path(SIGLOC_SHARE_FOLDER) / ".." / "..";
inline const std::filesystem::path kOffice = kSources / "maps/office.simplemap";

struct CommandResult
{
  int exit_code = -1;
  std::string output;
  std::string errors;
};

inline std::string quoted(const std::string& text)
{
  return "'" + text + "'";
}

/// A program of the project with its arguments, as a shell takes them.
inline std::string commandLine(const std::string& program,
                               const std::vector<std::string>& arguments)
{
  std::string command = quoted(std::string(SIGLOC_BIN_FOLDER) + "/" + program);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  return command;
}

/// Where the programs keep the maps that they have built: a cache for each folder of a test.
inline std::filesystem::path cacheFor(const TemporaryFolder& folder)
{
  static const TemporaryFolder kCaches;
  return kCaches / folder.path().filename().string();
}

/// Runs a shell's commands with an empty standard input, in `folder`.
inline CommandResult runShell(const TemporaryFolder& folder, const std::string& commands)
{
  const TemporaryFolder streams;
  const std::string command = "export XDG_CACHE_HOME=" + quoted(cacheFor(folder).string()) +
                              "; cd " + quoted(folder.path().string()) + " && { " + commands +
                              "; } </dev/null >" + quoted((streams / "out").string()) + " 2>" +
                              quoted((streams / "err").string());
  const int status = std::system(command.c_str());
  CommandResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  result.output = readBytes(streams / "out");
  result.errors = readBytes(streams / "err");
  return result;
}

/// Runs one of the project's programs with an empty standard input, in `folder`.
inline CommandResult run(const TemporaryFolder& folder, const std::string& program,
                         const std::vector<std::string>& arguments)
{
  return runShell(folder, commandLine(program, arguments));
}

/// All files and folders below a folder.
inline std::set<std::string> listing(const std::filesystem::path& folder)
{
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.insert(entry.path().string());
  return names;
}

inline std::set<std::string> listing(const TemporaryFolder& folder)
{
  return listing(folder.path());
}

inline std::ptrdiff_t countLines(const std::string& text)
{
  return std::count(text.begin(), text.end(), '\n');
}

/// What tests write into files in place of a number.
inline constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN();

/// The ways in which a file can be bad.
enum class Damage
{
  missing,
  empty,
  truncated,
  foreign,
  random,
};

/// Makes `path` a bad version of the sound file `model`.
inline void makeBadFile(Damage damage, const std::filesystem::path& model,
                        const std::filesystem::path& path)
{
  std::string bytes;
  switch (damage)
  {
    case Damage::missing:
      return;
    case Damage::empty:
      break;
    case Damage::truncated:
      bytes = readBytes(model);
      bytes.resize(bytes.size() / 2);
      break;
    case Damage::foreign:
      bytes = "%PDF-1.4\nnothing that MRPT would read\n";
      break;
    case Damage::random:
    {
      std::mt19937 generator(7);
      for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(generator() & 0xFFU);
      break;
    }
  }
  writeText(path, bytes);
}
}  // namespace sigloc::test
