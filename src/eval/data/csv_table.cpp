// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/csv_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/archive/gzip_input.h"
#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
/// The cells of the next row. A quoted cell may span several lines.
std::vector<std::string> readRow(std::istream& file)
{
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (int c = file.get(); c != EOF && (quoted || c != '\n'); c = file.get())
  {
    if (c == '"' && quoted && file.peek() == '"')
    {
      cells.back() += static_cast<char>(file.get());  // two within quotes stand for one
    }
    else if (c == '"')
    {
      quoted = !quoted;
    }
    else if (c == ',' && !quoted)
    {
      cells.emplace_back();
    }
    else if (c != '\r' || quoted)
    {
      cells.back() += static_cast<char>(c);
    }
  }
  return cells;
}
}  // namespace

std::string csvCell(const std::string& text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string(2, c) : std::string(1, c);
  return cell + "\"";
}

CsvTable::CsvTable(std::filesystem::path path) : path_(std::move(path))
{
  detail::requireFile(path_);
  std::ifstream file(path_, std::ios::binary);
  columns_ = readRow(file);
  while (file.peek() != EOF)
  {
    rows_.push_back(readRow(file));
    if (rows_.back().size() == columns_.size()) continue;
    fail(rows_.size() - 1,
         fmt::format("{} cells instead of {}", rows_.back().size(), columns_.size()));
  }
  if (rows_.empty()) throw std::runtime_error(path_.string() + ": holds no rows");
}

bool CsvTable::has(const std::string& column) const
{
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const
{
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) fail(row, "no column '" + column + "'");
  return rows_.at(row)[static_cast<std::size_t>(found - columns_.begin())];
}

double CsvTable::number(std::size_t row, const std::string& column) const
{
  const std::string& cell = text(row, column);
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (read.ec != std::errc() || read.ptr != cell.data() + cell.size())
  {
    fail(row, column + ": " + detail::quoted(cell) + " is no number");
  }
  return value;
}

void CsvTable::fail(std::size_t row, const std::string& reason) const
{
  throw std::runtime_error(fmt::format("{}: line {}: {}", path_.string(), row + 2, reason));
}
}  // namespace sigloc::detail
