// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "io/archive/file_fault.h"

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kLeastChunk = 4096;  // bytes
constexpr std::size_t kChunk = 256U * 1024U;
constexpr std::size_t kLongestLine = 8U * 1024U * 1024U;
constexpr std::string_view kSeparators = " \t,;\r";
}  // namespace

TextLines::TextLines(const std::filesystem::path& path, std::uint64_t most) : input_(path)
{
  input_.limitTo({most});
  refill();
  from_ = text_.size() - withoutUtf8Mark(text_).size();
}

std::string_view withoutUtf8Mark(std::string_view text)
{
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

bool TextLines::next()
{
  std::size_t end = text_.find('\n', from_);
  while (end == std::string::npos && more_)
  {
    const std::size_t looked = text_.size() - from_;
    if (looked > kLongestLine)
      failAtLine(input_.path(), index_ + 1, fmt::format("longer than {} MB", kLongestLine >> 20U));
    refill();
    end = text_.find('\n', from_ + looked);
  }
  ended_ = end != std::string::npos;
  end = std::min(end, text_.size());
  if (from_ >= text_.size()) return false;
  line_ = std::string_view(text_).substr(from_, end - from_);
  from_ = end + 1;
  ++index_;
  return true;
}

/// Reads on. Keeps what has not been handed out.
void TextLines::refill()
{
  text_.erase(0, from_);
  from_ = 0;
  const std::size_t size = text_.size();
  const auto chunk = static_cast<std::size_t>(
      std::clamp<std::uint64_t>(input_.getTotalBytesCount() + 1, kLeastChunk, kChunk));
  text_.resize(size + chunk);
  const std::size_t got = input_.Read(text_.data() + size, chunk);
  text_.resize(size + got);
  more_ = got == chunk;
  if (input_.damaged()) fail(input_.path(), "truncated or damaged");
  if (text_.find('\0', size) != std::string::npos) fail(input_.path(), "not a text file");
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

std::string quoted(std::string_view text)
{
  constexpr std::size_t kMost = 60;
  const bool whole = text.size() <= kMost;
  return fmt::format("'{}'{}", text.substr(0, kMost), whole ? "" : "...");
}

void failAtLine(const std::filesystem::path& path, std::size_t index, const std::string& reason)
{
  throw std::runtime_error(fmt::format("{}: line {}: {}", path.string(), index + 1, reason));
}
}  // namespace sigloc::detail
