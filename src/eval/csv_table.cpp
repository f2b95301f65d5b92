// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "csv_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sigloc::detail
{
namespace
{
std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells(1);
  for (const char c : line)
  {
    if (c == ',') cells.emplace_back();
    if (c != ',' && c != '\r') cells.back() += c;
  }
  return cells;
}
}  // namespace

CsvTable::CsvTable(std::filesystem::path path) : path_(std::move(path))
{
  std::ifstream file(path_, std::ios::binary);
  if (!file) throw std::runtime_error(path_.string() + ": cannot be opened");
  std::string line;
  std::getline(file, line);
  columns_ = cellsOf(line);
  while (std::getline(file, line))
  {
    rows_.push_back(cellsOf(line));
    if (rows_.back().size() == columns_.size()) continue;
    fail(rows_.size() - 1, std::to_string(rows_.back().size()) + " cells instead of " +
                               std::to_string(columns_.size()));
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
    fail(row, column + ": '" + cell + "' is no number");
  }
  return value;
}

std::size_t CsvTable::count(std::size_t row, const std::string& column) const
{
  const std::string& cell = text(row, column);
  std::size_t value = 0;
  const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (read.ec != std::errc() || read.ptr != cell.data() + cell.size())
  {
    fail(row, column + ": '" + cell + "' is no count");
  }
  return value;
}

void CsvTable::fail(std::size_t row, const std::string& reason) const
{
  throw std::runtime_error(path_.string() + ": line " + std::to_string(row + 2) + ": " + reason);
}
}  // namespace sigloc::detail
