// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "reading_arguments.h"

namespace sigloc
{
/// What sigloc-localize is asked for.
struct LocalizeArguments
{
  std::filesystem::path config;
  std::filesystem::path rawlog;
  std::filesystem::path map;
  ReadingArguments reading;
  std::optional<std::filesystem::path> output;
  std::optional<std::uint32_t> seed;
  bool quiet = false;
  bool print_defaults = false;
};
}  // namespace sigloc

/// Does it, and returns the exit code. Throws std::runtime_error.
extern "C" int siglocLocalize(const sigloc::LocalizeArguments& arguments);
