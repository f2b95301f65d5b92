// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "map_alignment.h"
#include "reading_arguments.h"

namespace sigloc
{
/// What sigloc-align is asked for.
struct AlignArguments
{
  std::filesystem::path a;
  std::filesystem::path b;
  std::filesystem::path output;  ///< folder; empty: none
  std::filesystem::path poses;
  std::filesystem::path picture;
  ReadingArguments reading;
  AlignmentOptions options;
};
}  // namespace sigloc

/// Does it, and returns the exit code. Throws std::runtime_error.
extern "C" int siglocAlign(const sigloc::AlignArguments& arguments);
