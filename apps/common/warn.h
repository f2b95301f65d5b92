// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "sigloc/io/file_output.h"

namespace sigloc
{
/// Prints one line about a file on stderr, unless the line is empty.
inline void warn(const char* program, const std::filesystem::path& file, const std::string& message)
{
  if (message.empty()) return;
  std::cerr << program << ": " << oneLine(file.string() + ": " + message) << '\n';
}

/// Warnings that wait until all inputs are known to be sound: where one is not, its error is the
/// only line.
class HeldWarnings
{
 public:
  HeldWarnings(std::filesystem::path file, std::vector<std::string> messages)
      : file_(std::move(file)), messages_(std::move(messages))
  {
  }

  /// Prints them, once.
  void print(const char* program)
  {
    for (const std::string& message : std::exchange(messages_, {})) warn(program, file_, message);
  }

 private:
  std::filesystem::path file_;
  std::vector<std::string> messages_;
};
}  // namespace sigloc
