// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sigloc::detail
{
/// A cell of a CSV file, in quotes where it needs them.
std::string csvCell(const std::string& text);

/// A results.csv: cells by row and name of the column.
class CsvTable
{
 public:
  /// Throws std::runtime_error ("path: reason") for a file that cannot be read, has no rows or has
  /// rows of another length than its head.
  explicit CsvTable(std::filesystem::path path);

  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& column) const;

  // These throw std::runtime_error ("path: line N: reason") for a missing column or a cell that is
  // no number.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// NaN for an empty cell.
  double number(std::size_t row, const std::string& column) const;

  [[noreturn]] void fail(std::size_t row, const std::string& reason) const;

 private:
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};
}  // namespace sigloc::detail
