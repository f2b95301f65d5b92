// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "map_check.h"
#include "reading_arguments.h"

namespace sigloc
{
/// The arguments of `sigloc-map check`.
struct CheckArguments
{
  std::filesystem::path map;
  std::filesystem::path laser;
  std::filesystem::path at;
  std::filesystem::path out;
  ReadingArguments reading;
  CheckOptions options;

  /// Declares them.
  void declare(CLI::App& command);
};

/// Checks the map, prints the table and writes the folder. Throws std::runtime_error.
void runCheck(const CheckArguments& arguments, const char* program);
}  // namespace sigloc
