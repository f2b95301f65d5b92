// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "map_check.h"
#include "reading_arguments.h"

namespace sigloc
{
enum class MapCommand
{
  build,
  info,
  draw,
  check,
};

/// What sigloc-map is asked for. Each command has its own of these.
struct MapArguments
{
  MapCommand command = MapCommand::build;
  std::filesystem::path input;
  std::filesystem::path output;  ///< file, of check: folder
  ReadingArguments reading;
  std::filesystem::path config;  ///< of build
  bool as_json = false;  ///< of info
  std::filesystem::path laser;  ///< of check
  std::filesystem::path at;  ///< of check
  CheckOptions options;  ///< of check
};
}  // namespace sigloc

/// Does it, and returns the exit code. Throws std::runtime_error.
extern "C" int siglocMap(const sigloc::MapArguments& arguments);
