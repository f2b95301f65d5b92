// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>
#include <vector>

#include "io/points/number_fields.h"
#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
struct PcdField
{
  std::string_view name;
  const NumberKind* kind = nullptr;
  std::size_t count = 1;
};

struct PcdHeader
{
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::string_view data;
};

/// Takes the header off a PCD file.
PcdHeader takePcdHeader(std::string_view& text, const std::filesystem::path& path)
{
  PcdHeader header;
  std::vector<std::string_view> sizes;
  std::vector<std::string_view> types;
  std::vector<std::string_view> counts;
  std::optional<std::size_t> points;
  while (header.data.empty())
  {
    if (text.empty()) fail(path, "not a PCD file, or its header is cut off");
    auto line = words(takeLine(text));
    if (line.empty() || line[0].front() == '#') continue;
    const std::string_view key = line[0];
    line.erase(line.begin());
    if (key == "FIELDS")
    {
      for (const std::string_view name : line) header.fields.push_back({name});
    }
    else if (key == "SIZE")
    {
      sizes = line;
    }
    else if (key == "TYPE")
    {
      types = line;
    }
    else if (key == "COUNT")
    {
      counts = line;
    }
    else if (key == "POINTS" && line.size() == 1)
    {
      points = countIn(line[0]);
    }
    else if (key == "DATA" && line.size() == 1)
    {
      header.data = line[0];
    }
    else if (key != "VERSION" && key != "WIDTH" && key != "HEIGHT" && key != "VIEWPOINT")
    {
      fail(path, "not a PCD file");
    }
  }
  const std::size_t n = header.fields.size();
  if (!points || sizes.size() != n || types.size() != n || (!counts.empty() && counts.size() != n))
    fail(path, "its header does not tell the fields of its points");
  header.points = *points;
  for (std::size_t i = 0; i < n; ++i)
  {
    constexpr std::size_t kMostOfOne = 10000;
    header.fields[i].kind = kindOf(std::string(types[i]) + std::string(sizes[i]));
    const auto count = counts.empty() ? std::optional<std::size_t>(1) : countIn(counts[i]);
    if (header.fields[i].kind == nullptr || !count || *count > kMostOfOne)
      fail(path, "a field of its points is of an unknown kind");
    header.fields[i].count = *count;
  }
  return header;
}

/// Unpacks by LZF: runs of bytes as they are, and copies of what came before.
std::string unpacked(std::string_view packed, std::size_t size, const std::filesystem::path& path)
{
  constexpr unsigned kLiteral = 32;
  constexpr unsigned kLongRun = 7;
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto next = [&]
  {
    if (at >= packed.size()) fail(path, "its packed data is cut off");
    return static_cast<unsigned>(static_cast<unsigned char>(packed[at++]));
  };
  while (at < packed.size())
  {
    const unsigned control = next();
    if (control < kLiteral)
    {
      const std::size_t length = control + 1;
      if (length > packed.size() - at) fail(path, "its packed data is cut off");
      out.append(packed.substr(at, length));
      at += length;
    }
    else
    {
      std::size_t length = control >> 5U;
      if (length == kLongRun) length += next();
      const std::size_t back = ((control & 31U) << 8U) + next() + 1;
      if (back > out.size()) fail(path, "its packed data is damaged");
      for (std::size_t i = 0; i < length + 2; ++i) out.push_back(out[out.size() - back]);
    }
    if (out.size() > size) fail(path, "its packed data is damaged");
  }
  if (out.size() != size) fail(path, "its packed data is damaged");
  return out;
}

/// Takes the data of a compressed file, which has two sizes before it.
std::string unpackedPcd(std::string_view data, std::size_t expected,
                        const std::filesystem::path& path)
{
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  // Packing by LZF makes nothing smaller than by this, so it is asked before memory is taken.
  constexpr std::size_t kBestPacking = 100;
  if (data.size() < kSizes) fail(path, "is cut off");
  const auto packed = static_cast<std::size_t>(kindOf("U4")->read(data.data(), false));
  const auto size = static_cast<std::size_t>(kindOf("U4")->read(data.data() + 4, false));
  data.remove_prefix(kSizes);
  if (packed > data.size()) fail(path, "is cut off");
  if (size != expected || size / kBestPacking > packed) fail(path, "its packed data is damaged");
  return unpacked(data.substr(0, packed), size, path);
}

Places placesIn(const PcdHeader& header, const std::filesystem::path& path)
{
  Places places{};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
  {
    std::size_t at = 0;
    const PcdField* found = nullptr;
    for (const PcdField& field : header.fields)
    {
      if (field.name == kAxes[axis] && field.count == 1) found = &field;
      if (found != nullptr) break;
      at += field.count;
    }
    if (found == nullptr) fail(path, std::string("its points have no ") + kAxes[axis]);
    places[axis] = at;
  }
  return places;
}

/// Where a field begins in the data of all points: of binary data point by point, of compressed
/// data field by field.
PointList binaryPoints(const PcdHeader& header, std::string_view data, bool by_field,
                       const std::filesystem::path& path)
{
  std::array<std::size_t, 3> first{};
  std::array<std::size_t, 3> step{};
  std::array<const NumberKind*, 3> kinds{};
  std::size_t bytes = 0;  // of the fields before, of one point
  for (const PcdField& field : header.fields)
  {
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
    {
      if (field.name != kAxes[axis] || field.count != 1 || kinds[axis] != nullptr) continue;
      kinds[axis] = field.kind;
      first[axis] = by_field ? bytes * header.points : bytes;
      step[axis] = field.kind->bytes;
    }
    bytes += field.kind->bytes * field.count;
  }
  if (!by_field) step.fill(bytes);
  if (bytes == 0 || data.size() / bytes < header.points) fail(path, "is cut off");
  const auto at = [&](std::size_t axis, std::size_t i)
  { return kinds[axis]->read(data.data() + first[axis] + i * step[axis], false); };
  PointList points;
  for (std::size_t i = 0; i < header.points; ++i) addPoint(points, at(0, i), at(1, i), at(2, i));
  return points;
}

std::size_t bytesOfPoint(const PcdHeader& header)
{
  std::size_t bytes = 0;
  for (const PcdField& field : header.fields) bytes += field.kind->bytes * field.count;
  return bytes;
}
/// Judges by the header how much of the file must be read: up to the last point.
PointData dataOf(const PcdHeader& header)
{
  const auto points = static_cast<double>(header.points);
  const auto fields = static_cast<double>(header.fields.size());
  const double bytes = points * static_cast<double>(bytesOfPoint(header));
  // A digit and what ends it.
  if (header.data == "ascii") return {2 * points * fields, kMostHead + points * kLongestRow};
  if (header.data == "binary") return {bytes, kMostHead + bytes};
  return {0, kUsualLimits.most};
}
}  // namespace

PointList readPcd(const std::filesystem::path& path)
{
  GzipInput input(path);
  input.limitTo(kUsualLimits);
  std::string_view begin = input.peek(kMostHead).substr(0, kMostHead);
  const std::string bytes = bytesOfPoints(input, dataOf(takePcdHeader(begin, path)));
  std::string_view data = bytes;
  const PcdHeader header = takePcdHeader(data, path);
  const Places places = placesIn(header, path);
  if (header.data == "ascii") return textRows(data, header.points, places, path);
  if (header.data == "binary") return binaryPoints(header, data, false, path);
  if (header.data != "binary_compressed") fail(path, "not a PCD file of a known format");
  const std::string all = unpackedPcd(data, header.points * bytesOfPoint(header), path);
  return binaryPoints(header, all, true, path);
}
}  // namespace sigloc::detail
