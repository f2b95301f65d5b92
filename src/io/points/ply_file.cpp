// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/points/number_fields.h"
#include "io/text_rows.h"

namespace sigloc::detail
{
namespace
{
struct PlyProperty
{
  std::string_view name;
  const NumberKind* kind;  // of a list: of its items
  const NumberKind* length;  // of a list's length; null: no list
};

struct PlyElement
{
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader
{
  std::string_view format;
  std::vector<PlyElement> elements;
};

/// Takes the header off a PLY file.
PlyHeader takePlyHeader(std::string_view& text, const std::filesystem::path& path)
{
  if (words(takeLine(text)) != std::vector<std::string_view>{"ply"}) fail(path, "not a PLY file");
  PlyHeader header;
  while (!text.empty())
  {
    const auto line = words(takeLine(text));
    if (line.empty() || line[0] == "comment" || line[0] == "obj_info") continue;
    if (line[0] == "end_header") return header;
    const bool property = line[0] == "property" && !header.elements.empty();
    if (line[0] == "format" && line.size() >= 2)
    {
      header.format = line[1];
    }
    else if (line[0] == "element" && line.size() == 3 && countIn(line[2]))
    {
      header.elements.push_back({line[1], *countIn(line[2]), {}});
    }
    else if (property && line.size() == 3 && kindOf(line[1]) != nullptr)
    {
      header.elements.back().properties.push_back({line[2], kindOf(line[1]), nullptr});
    }
    else if (property && line.size() == 5 && line[1] == "list" && kindOf(line[2]) != nullptr &&
             kindOf(line[3]) != nullptr)
    {
      header.elements.back().properties.push_back({line[4], kindOf(line[3]), kindOf(line[2])});
    }
    else
    {
      fail(path, "a line of its header is not known");
    }
  }
  fail(path, "its header is cut off");
}

Places placesIn(const PlyElement& vertices, const std::filesystem::path& path)
{
  Places places{};
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
  {
    const auto found = std::find_if(vertices.properties.begin(), vertices.properties.end(),
                                    [&](const PlyProperty& p) { return p.name == kAxes[axis]; });
    if (found == vertices.properties.end() || found->length != nullptr)
      fail(path, std::string("its vertices have no ") + kAxes[axis]);
    places[axis] = static_cast<std::size_t>(found - vertices.properties.begin());
  }
  return places;
}

/// Takes one element off binary data and puts its numbers, but those of lists, into `values`.
void takePlyElement(std::string_view& data, const PlyElement& element, bool swapped,
                    std::vector<double>& values, const std::filesystem::path& path)
{
  const auto take = [&](const NumberKind& kind)
  {
    if (data.size() < kind.bytes) fail(path, "is cut off");
    const double value = kind.read(data.data(), swapped);
    data.remove_prefix(kind.bytes);
    return value;
  };
  values.clear();
  for (const PlyProperty& property : element.properties)
  {
    if (property.length == nullptr)
    {
      values.push_back(take(*property.kind));
      continue;
    }
    const double length = take(*property.length);
    const double bytes = length * static_cast<double>(property.kind->bytes);
    if (!(length >= 0 && bytes <= static_cast<double>(data.size()))) fail(path, "is cut off");
    data.remove_prefix(static_cast<std::size_t>(bytes));
    values.push_back(kNoNumber);
  }
}

/// Judges by the header how much of the file must be read: up to the last vertex.
PointData dataOf(const PlyHeader& header)
{
  const bool text = header.format == "ascii";
  PointData data{0, kMostHead};
  for (const PlyElement& element : header.elements)
  {
    double least = 0;
    double most = text ? kLongestRow : 0;
    for (const PlyProperty& property : element.properties)
    {
      const NumberKind& kind = property.length == nullptr ? *property.kind : *property.length;
      least += text ? 2.0 : static_cast<double>(kind.bytes);  // a digit and what ends it
      if (!text)
        most += property.length == nullptr ? static_cast<double>(kind.bytes) : kUsualLimits.most;
    }
    data.least += static_cast<double>(element.count) * least;
    data.most += static_cast<double>(element.count) * most;
    if (element.name == "vertex") break;
  }
  return data;
}
}  // namespace

PointList readPly(const std::filesystem::path& path)
{
  GzipInput input(path);
  input.limitTo(kUsualLimits);
  std::string_view begin = input.peek(kMostHead).substr(0, kMostHead);
  const std::string bytes = bytesOfPoints(input, dataOf(takePlyHeader(begin, path)));
  std::string_view data = bytes;
  const PlyHeader header = takePlyHeader(data, path);
  const bool text = header.format == "ascii";
  const bool swapped = header.format == "binary_big_endian";
  if (!text && !swapped && header.format != "binary_little_endian")
    fail(path, "not a PLY file of a known format");
  PointList points;
  std::vector<double> values;
  for (const PlyElement& element : header.elements)
  {
    const bool vertices = element.name == "vertex";
    const Places places = vertices ? placesIn(element, path) : Places{};
    if (vertices && text) return textRows(data, element.count, places, path);
    // Elements without a property would take no bytes, and time for ever.
    if (element.properties.empty() && element.count > 0) fail(path, "its header is damaged");
    for (std::size_t i = 0; i < element.count; ++i)
    {
      if (data.empty()) fail(path, "is cut off");
      text ? static_cast<void>(takeLine(data))
           : takePlyElement(data, element, swapped, values, path);
      if (vertices) addPoint(points, values[places[0]], values[places[1]], values[places[2]]);
    }
    if (vertices) return points;
  }
  fail(path, "has no vertices");
}
}  // namespace sigloc::detail
