// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace sigloc::detail
{
/// Throws std::runtime_error with the one line that a user reads: the file and the reason.
[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& reason)
{
  throw std::runtime_error(path.string() + ": " + reason);
}
}  // namespace sigloc::detail
