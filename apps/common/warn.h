// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iostream>
#include <string>

#include "sigloc/io/file_output.h"

namespace sigloc
{
/// Prints one line about a file on stderr, unless the line is empty.
inline void warn(const char* program, const std::filesystem::path& file, const std::string& message)
{
  if (message.empty()) return;
  std::cerr << program << ": " << oneLine(file.string() + ": " + message) << '\n';
}
}  // namespace sigloc
