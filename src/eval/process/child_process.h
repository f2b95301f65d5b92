// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sigloc::detail
{
/// Runs a program of the PATH with one argument, an empty standard input, and all its output in
/// `log`. Returns its status, 0 for success, or nullopt when there is no such program.
std::optional<int> runProgram(const std::string& program, const std::string& argument,
                              const std::filesystem::path& log);

/// Runs a program as runProgram() does. Returns what it printed, or nullopt when there is no such
/// program or it fails; its error messages are dropped.
std::optional<std::string> outputOf(const std::string& program, const std::string& argument);
}  // namespace sigloc::detail
