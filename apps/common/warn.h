// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "sigloc/config/plural.h"
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

  /// Prints them, once; of very many the first.
  void print(const char* program)
  {
    constexpr std::size_t kMost = 20;
    const std::vector<std::string> messages = std::exchange(messages_, {});
    for (std::size_t i = 0; i < std::min(kMost, messages.size()); ++i)
      warn(program, file_, messages[i]);
    if (messages.size() > kMost)
      warn(program, file_, counted(messages.size() - kMost, "more warning"));
  }

 private:
  std::filesystem::path file_;
  std::vector<std::string> messages_;
};
}  // namespace sigloc
