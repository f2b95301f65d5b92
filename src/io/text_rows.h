// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sigloc::detail
{
/// Returns the lines of a text file, plain or gz-compressed, without their line ends.
/// Throws std::runtime_error "path: reason" for a missing, empty, truncated or binary file.
std::vector<std::string> readLines(const std::filesystem::path& path);

/// Returns the words of a line; blanks, tabs, commas and semicolons separate.
std::vector<std::string_view> words(std::string_view line);

/// Returns the words of a row of a table; `index` counts lines from 0. Throws std::runtime_error
/// "path: line N: reason" for more than 100: such rows have lost their line ends.
std::vector<std::string_view> columnsIn(std::string_view line, const std::filesystem::path& path,
                                        std::size_t index);

/// Returns the number a word spells, whatever the locale, or nullopt when it is not a finite
/// number.
std::optional<double> toNumber(std::string_view word);

/// Throws std::runtime_error "path: line N: reason"; `index` counts lines from 0.
[[noreturn]] void failAtLine(const std::filesystem::path& path, std::size_t index,
                             const std::string& reason);
}  // namespace sigloc::detail
