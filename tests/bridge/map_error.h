// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "bridge/rawlog_files.h"
#include "sigloc/io/map_files.h"

namespace sigloc::test
{
/// Returns the message by which a file of a map is refused, or an empty text.
inline std::string mapErrorOf(const std::filesystem::path& path, const ReadingOptions& reading = {})
{
  return messageOf<std::runtime_error>([&] { readMapSource(path, reading); });
}
}  // namespace sigloc::test
