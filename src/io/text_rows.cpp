// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
namespace
{
constexpr std::string_view kSeparators = " \t,;\r";
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
}  // namespace

std::vector<std::string> readLines(const std::filesystem::path& path)
{
  std::string text = unpackedBytes(path);
  if (text.find('\0') != std::string::npos)
  {
    throw std::runtime_error(path.string() + ": not a text file");
  }
  // Some editors begin UTF-8 with a mark.
  if (text.compare(0, kUtf8Mark.size(), kUtf8Mark) == 0) text.erase(0, kUtf8Mark.size());
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::vector<std::string_view> words(std::string_view line)
{
  std::vector<std::string_view> found;
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos)
  {
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    found.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
  return found;
}

std::vector<std::string_view> columnsIn(std::string_view line, const std::filesystem::path& path,
                                        std::size_t index)
{
  constexpr std::size_t kMost = 100;
  std::vector<std::string_view> columns = words(line);
  if (columns.size() > kMost)
  {
    failAtLine(path, index, fmt::format("{} columns, more than {}", columns.size(), kMost));
  }
  return columns;
}

std::optional<double> toNumber(std::string_view word)
{
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

void failAtLine(const std::filesystem::path& path, std::size_t index, const std::string& reason)
{
  throw std::runtime_error(fmt::format("{}: line {}: {}", path.string(), index + 1, reason));
}
}  // namespace sigloc::detail
