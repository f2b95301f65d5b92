// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
constexpr std::uint64_t kMostText = std::uint64_t{1} << 28U;  // bytes

/// The lines of a text file, plain or compressed, front to back and without their line ends.
class TextLines
{
 public:
  /// It and next() throw std::runtime_error "path: reason" for a file that is missing, empty,
  /// truncated or binary, or holds more than `most` bytes or an endless line.
  explicit TextLines(const std::filesystem::path& path, std::uint64_t most = kMostText);

  /// Goes to the next line, at first to line 0. Returns false at the end.
  bool next();
  /// Valid until next().
  std::string_view line() const { return line_; }
  /// False for a last line without a line end.
  bool ended() const { return ended_; }
  /// Counts lines from 0.
  std::size_t index() const { return index_; }

 private:
  void refill();

  GzipInput input_;
  std::string text_;  // read from the file ...
  std::size_t from_ = 0;  // ... and handed out up to here
  bool more_ = true;
  std::string_view line_;
  bool ended_ = false;
  std::size_t index_ = static_cast<std::size_t>(-1);
};

/// Returns a text without the mark with which some editors begin UTF-8.
std::string_view withoutUtf8Mark(std::string_view text);

/// Returns the words of a line; blanks, tabs, commas and semicolons separate.
std::vector<std::string_view> words(std::string_view line);

/// Returns the words of a row of a table; `index` counts lines from 0. Throws std::runtime_error
/// "path: line N: reason" for more than 100: such rows have lost their line ends.
std::vector<std::string_view> columnsIn(std::string_view line, const std::filesystem::path& path,
                                        std::size_t index);

/// Returns the number a word spells, whatever the locale, or nullopt when it is not a finite
/// number.
std::optional<double> toNumber(std::string_view word);

/// Returns a text in quotes, for messages; of a long one the beginning.
std::string quoted(std::string_view text);

/// Throws std::runtime_error "path: line N: reason"; `index` counts lines from 0.
[[noreturn]] void failAtLine(const std::filesystem::path& path, std::size_t index,
                             const std::string& reason);
}  // namespace sigloc::detail
