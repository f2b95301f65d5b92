// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/points/number_fields.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
template <class T>
double readAs(const char* at, bool swapped)
{
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swapped) std::reverse(bytes.begin(), bytes.end());
  T value{};
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

constexpr std::array<NumberKind, 26> kNumberKinds = {{
    {"char", 1, readAs<std::int8_t>},
    {"int8", 1, readAs<std::int8_t>},
    {"uchar", 1, readAs<std::uint8_t>},
    {"uint8", 1, readAs<std::uint8_t>},
    {"short", 2, readAs<std::int16_t>},
    {"int16", 2, readAs<std::int16_t>},
    {"ushort", 2, readAs<std::uint16_t>},
    {"uint16", 2, readAs<std::uint16_t>},
    {"int", 4, readAs<std::int32_t>},
    {"int32", 4, readAs<std::int32_t>},
    {"uint", 4, readAs<std::uint32_t>},
    {"uint32", 4, readAs<std::uint32_t>},
    {"float", 4, readAs<float>},
    {"float32", 4, readAs<float>},
    {"double", 8, readAs<double>},
    {"float64", 8, readAs<double>},
    {"I1", 1, readAs<std::int8_t>},
    {"I2", 2, readAs<std::int16_t>},
    {"I4", 4, readAs<std::int32_t>},
    {"I8", 8, readAs<std::int64_t>},
    {"U1", 1, readAs<std::uint8_t>},
    {"U2", 2, readAs<std::uint16_t>},
    {"U4", 4, readAs<std::uint32_t>},
    {"U8", 8, readAs<std::uint64_t>},
    {"F4", 4, readAs<float>},
    {"F8", 8, readAs<double>},
}};

}  // namespace

const NumberKind* kindOf(std::string_view name)
{
  const auto* const found = std::find_if(kNumberKinds.begin(), kNumberKinds.end(),
                                         [&](const NumberKind& kind) { return kind.name == name; });
  return found == kNumberKinds.end() ? nullptr : found;
}

/// A count that a header announces, or nullopt for what is none.
std::optional<std::size_t> countIn(std::string_view word)
{
  constexpr double kMost = 4e9;
  const auto number = toNumber(word);
  if (!number || *number < 0 || *number > kMost || *number != std::floor(*number))
    return std::nullopt;
  return static_cast<std::size_t>(*number);
}

std::string bytesOfPoints(GzipInput& input, const PointData& data)
{
  if (!input.isPlain()) return restOf(input);  // its checksum is at its end
  const auto size = static_cast<double>(input.getTotalBytesCount());
  if (data.least > size) fail(input.path(), "is cut off");
  return restOf(input, static_cast<std::uint64_t>(std::min(data.most, size)) + 1);
}

std::string_view takeLine(std::string_view& text)
{
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

PointList textRows(std::string_view text, std::size_t count, const Places& places,
                   const std::filesystem::path& path)
{
  const std::size_t needed = *std::max_element(places.begin(), places.end());
  PointList points;
  for (std::size_t row = 0; row < count; ++row)
  {
    if (text.empty()) fail(path, "is cut off");
    const auto cells = words(takeLine(text));
    if (cells.size() <= needed) fail(path, "is cut off or damaged");
    addPoint(points, toNumber(cells[places[0]]).value_or(kNoNumber),
             toNumber(cells[places[1]]).value_or(kNoNumber),
             toNumber(cells[places[2]]).value_or(kNoNumber));
  }
  return points;
}

void addPoint(PointList& points, double x, double y, double z)
{
  if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
    points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
}
}  // namespace sigloc::detail
