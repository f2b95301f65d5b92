// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sigloc/config/option_fields.h"

namespace sigloc
{
/// A number in fixed notation, spelled alike in every locale; an empty string for NaN, so that a
/// cell of a table stays empty.
inline std::string fixedNumber(double value, int decimals)
{
  return std::isnan(value) ? "" : fmt::format("{:.{}f}", value, decimals);
}

/// Cells of a row, as text.
using Cells = std::vector<std::string>;

/// A value as files show it.
struct Written
{
  /// Keys and values of a JSON object; the keys are appended to the column's name.
  std::vector<std::pair<std::string, nlohmann::ordered_json>> json;
  Cells cells;  ///< of CSV and of tables
};

// How values are written and parsed. A type of its own brings overloads of written() and, to be
// read back, of parse().

template <class T>
constexpr bool kIsText = std::is_convertible_v<T, std::string>;
template <class T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T> || kIsText<T>;

/// One key, one cell: a switch is 0 or 1, a number that is NaN leaves its cell empty.
template <class T, std::enable_if_t<kIsPlain<T>, int> = 0>
Written written(const T& value, int decimals)
{
  if constexpr (kIsText<T>) return {{{"", value}}, {std::string(value)}};
  if constexpr (std::is_enum_v<T>) return written(toString(value), decimals);
  if constexpr (std::is_floating_point_v<T>) return {{{"", value}}, {fixedNumber(value, decimals)}};
  if constexpr (std::is_integral_v<T>) return {{{"", value}}, {std::to_string(value)}};
}

/// A reader may write its value itself.
inline Written written(const Written& value, int /*decimals*/)
{
  return value;
}

/// Three cells; the heading [rad] has a digit more.
inline Written written(const mrpt::math::TPose2D& pose, int decimals)
{
  return {{{"", {pose.x, pose.y, pose.phi}}},
          {fixedNumber(pose.x, decimals), fixedNumber(pose.y, decimals),
           fixedNumber(pose.phi, decimals + 1)}};
}

/// Null and empty cells where there is no value.
template <class T>
Written written(const std::optional<T>& value, int decimals)
{
  if (value) return written(*value, decimals);
  return {{{"", nullptr}}, Cells(written(T{}, decimals).cells.size())};
}

/// Sets `value` to what was written into these cells; false where they hold no such value.
template <class T, std::enable_if_t<kIsPlain<T>, int> = 0>
bool parse(const Cells& cells, T& value)
{
  const std::string& cell = cells.front();
  std::optional<T> parsed;
  if constexpr (kIsText<T>)
  {
    parsed = cell;
  }
  else if constexpr (std::is_enum_v<T>)
  {
    for (int i = 0; !parsed && toString(static_cast<T>(i)) != std::string("unknown"); ++i)
    {
      if (cell == toString(static_cast<T>(i))) parsed = static_cast<T>(i);
    }
  }
  else
  {
    const bool is_nan = std::is_floating_point_v<T> && cell.empty();
    parsed = is_nan ? std::numeric_limits<T>::quiet_NaN() : detail::parseValue<T>(cell);
  }
  value = parsed.value_or(T{});
  return parsed.has_value();
}

/// Of values that are never read back.
template <class T, std::enable_if_t<!kIsPlain<T>, int> = 0>
bool parse(const Cells& /*cells*/, T& /*value*/)
{
  return false;
}

inline bool parse(const Cells& cells, mrpt::math::TPose2D& pose)
{
  return parse({cells[0]}, pose.x) && parse({cells[1]}, pose.y) && parse({cells[2]}, pose.phi);
}

template <class T>
bool parse(const Cells& cells, std::optional<T>& value)
{
  value.reset();
  const bool is_none = std::all_of(cells.begin(), cells.end(), std::mem_fn(&std::string::empty));
  return is_none || parse(cells, value.emplace());
}

/// The files that have a field.
enum class Files : std::uint8_t
{
  both,
  json,
  csv
};

/// What a field is called, what it means and where it is shown.
struct ColumnName
{
  /// Key of JSON and head of CSV with the unit in it ("error_m"), of several cells with commas
  /// between; empty for a field of the table alone.
  std::string name;
  std::string meaning;  ///< for the legend, empty for what the name explains
  int decimals;  ///< of cells; JSON has all digits
  Cells heads;  ///< of the table, one for each of the first cells; none: not in the table
  int section;  ///< a table has its columns by section, then as listed
  Files files;
};

/// One field of a record, declared once. JSON, CSV, the Markdown table and the legend follow from a
/// list of these.
template <class Record>
struct Column : ColumnName
{
  /// `read` is a member of the record or a function of it.
  template <class Read>
  Column(const std::string& key, Read read, const std::string& explanation = {}, int digits = 3,
         const Cells& table_heads = {}, int table_section = 0, Files in = Files::both)
      : ColumnName{key, explanation, digits, table_heads, table_section, in},
        write([read](const Record& record, int places)
              { return written(std::invoke(read, record), places); })
  {
    using Value = std::invoke_result_t<Read, Record&>;
    if constexpr (std::is_lvalue_reference_v<Value> &&
                  !std::is_const_v<std::remove_reference_t<Value>>)
    {
      store = [read](Record& record, const Cells& cells)
      { return parse(cells, std::invoke(read, record)); };
    }
  }
  /// A column of what the record derives from.
  template <class Base>
  explicit Column(const Column<Base>& base)
      : ColumnName(static_cast<const ColumnName&>(base)), write(base.write)
  {
  }

  std::function<Written(const Record&, int decimals)> write;
  /// Sets the field from its cells; false for bad ones. Empty for what is computed.
  std::function<bool(Record&, const Cells&)> store;
};

template <class Record>
using Columns = std::vector<Column<Record>>;

/// Sets the keys of a value in an object.
template <class T>
void addJson(nlohmann::ordered_json& object, const std::string& name, const T& value)
{
  for (const auto& [suffix, part] : written(value, 0).json) object[name + suffix] = part;
}

template <class Record>
nlohmann::ordered_json toJson(const Columns<Record>& columns, const Record& record)
{
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& column : columns)
  {
    if (column.name.empty() || column.files == Files::csv) continue;
    for (const auto& [suffix, part] : column.write(record, 0).json)
      object[column.name + suffix] = part;
  }
  return object;
}

/// Names of the columns, comma-separated.
template <class Record>
std::string csvHead(const Columns<Record>& columns)
{
  std::string head;
  for (const auto& column : columns)
    if (!column.name.empty() && column.files != Files::json) head += column.name + ",";
  return head.substr(0, head.size() - 1);
}

/// One line, without its end.
template <class Record>
std::string csvRow(const Columns<Record>& columns, const Record& record)
{
  std::string row;
  for (const auto& column : columns)
  {
    if (column.name.empty() || column.files == Files::json) continue;
    for (const std::string& cell : column.write(record, column.decimals).cells) row += cell + ",";
  }
  return row.substr(0, row.size() - 1);
}

/// Head and rows.
template <class Record>
std::string csvFile(const Columns<Record>& columns, const std::vector<Record>& records)
{
  std::string csv = csvHead(columns) + "\n";
  for (const Record& record : records) csv += csvRow(columns, record) + "\n";
  return csv;
}

/// A row of the table; its head where there is no record.
template <class Record>
Cells tableRow(Columns<Record> columns, const Record* record)
{
  std::stable_sort(columns.begin(), columns.end(),
                   [](const auto& a, const auto& b) { return a.section < b.section; });
  Cells row;
  for (const auto& column : columns)
  {
    if (column.heads.empty()) continue;
    const Cells cells = record ? column.write(*record, column.decimals).cells : column.heads;
    const auto count = static_cast<std::ptrdiff_t>(column.heads.size());
    row.insert(row.end(), cells.begin(), cells.begin() + count);
  }
  return row;
}

template <class Record>
Cells tableHead(const Columns<Record>& columns)
{
  return tableRow<Record>(columns, nullptr);
}

template <class Record>
Cells tableRow(const Columns<Record>& columns, const Record& record)
{
  return tableRow(columns, &record);
}

/// Head and rows.
template <class Record>
std::vector<Cells> table(const Columns<Record>& columns, const std::vector<Record>& records)
{
  std::vector<Cells> rows = {tableHead(columns)};
  for (const Record& record : records) rows.push_back(tableRow(columns, record));
  return rows;
}

/// What the columns mean, as a section of Markdown: **heads** of the table, `names` in files.
template <class Record>
std::string legend(const std::string& title, const Columns<Record>& columns)
{
  std::string text = "\n## " + title + "\n\n";
  for (const auto& column : columns)
  {
    if (column.meaning.empty()) continue;
    std::string names;
    for (const std::string& head : column.heads) names += ", **" + head + "**";
    if (!column.name.empty()) names += ", `" + column.name + "`";
    text += "* " + names.substr(2) + ": " + column.meaning + "\n";
  }
  return text;
}
}  // namespace sigloc
