// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/ros_map_yaml.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/text_rows.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostBytes = 1U << 16U;
constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text)
{
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

/// Returns a value without its quotes, or up to a comment.
std::string_view scalarOf(std::string_view text)
{
  text = trimmed(text);
  if (!text.empty() && (text.front() == '"' || text.front() == '\''))
  {
    const std::size_t end = text.find(text.front(), 1);
    if (end != std::string_view::npos) return text.substr(1, end - 1);
  }
  if (!text.empty() && text.front() == '#') return {};
  return trimmed(text.substr(0, text.find(" #")));
}

/// The value of a key: a scalar is one item.
struct Value
{
  std::vector<std::string_view> items;
  bool list = false;
};
using Values = std::map<std::string, Value, std::less<>>;

std::vector<std::string_view> listIn(std::string_view text)
{
  std::vector<std::string_view> items;
  text = text.substr(1, text.find(']') - 1);
  while (true)
  {
    const std::size_t comma = text.find(',');
    items.push_back(scalarOf(text.substr(0, comma)));
    if (comma == std::string_view::npos) return items;
    text.remove_prefix(comma + 1);
  }
}

/// Takes a line `key: value` without indentation. Returns the key, or nullopt for another line and
/// for a key that was there before.
std::optional<std::string> takeKey(std::string_view line, Values& values)
{
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  if (colon + 1 < line.size() && kBlanks.find(line[colon + 1]) == std::string_view::npos)
  {
    return std::nullopt;
  }
  const std::string key(scalarOf(line.substr(0, colon)));
  const std::string_view text = scalarOf(line.substr(colon + 1));
  Value value;
  value.list = !text.empty() && text.front() == '[';
  if (value.list && text.find(']') == std::string_view::npos) return std::nullopt;
  if (value.list)
  {
    value.items = listIn(text);
  }
  else if (!text.empty())
  {
    value.items = {text};
  }
  if (!values.emplace(key, std::move(value)).second) return std::nullopt;
  return key;
}

Values valuesIn(std::string_view text, const std::filesystem::path& path)
{
  Values values;
  std::optional<std::string> key;
  text = withoutUtf8Mark(text);
  for (std::size_t index = 0; !text.empty(); ++index)
  {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#' || content == "---") continue;
    if (content == "...") break;
    const bool item = content.front() == '-' && (content.size() == 1 || content[1] == ' ');
    if (key && item)
    {
      values[*key].list = true;
      values[*key].items.push_back(scalarOf(content.substr(1)));
    }
    else if (!key || kBlanks.find(line.front()) == std::string_view::npos)
    {
      key = takeKey(content, values);
      if (!key)
      {
        const std::string line_number = std::to_string(index + 1);
        fail(path,
             "not a ROS map: line " + line_number + " is no `key: value`, or gives a key again");
      }
    }
    // Other indented lines belong to a key that has no meaning here.
  }
  return values;
}

/// Asks for the values of a ROS map by key.
class Header
{
 public:
  Header(const Values& values, const std::filesystem::path& path) : values_(values), path_(path) {}

  std::string_view text(std::string_view key) const
  {
    const auto found = values_.find(key);
    const bool given =
        found != values_.end() && !found->second.list && found->second.items.size() == 1;
    if (!given) refuse(key);
    return found->second.items.front();
  }

  double number(std::string_view key) const
  {
    const auto value = toNumber(text(key));
    if (!value) refuse(key);
    return *value;
  }

  std::vector<double> numbers(std::string_view key, std::size_t count) const
  {
    std::vector<double> numbers;
    const auto found = values_.find(key);
    if (found == values_.end() || found->second.items.size() != count) refuse(key);
    for (const std::string_view word : found->second.items)
    {
      const auto value = toNumber(word);
      if (!value) refuse(key);
      numbers.push_back(*value);
    }
    return numbers;
  }

  bool flag(std::string_view key) const
  {
    if (values_.find(key) == values_.end()) return false;
    const std::string_view value = text(key);
    for (const std::string_view yes : {"1", "true", "True", "TRUE", "yes"})
    {
      if (value == yes) return true;
    }
    for (const std::string_view no : {"0", "false", "False", "FALSE", "no"})
    {
      if (value == no) return false;
    }
    refuse(key);
  }

  RosMapMode mode() const
  {
    if (values_.find("mode") == values_.end()) return RosMapMode::trinary;
    const std::string_view value = text("mode");
    if (value == "trinary") return RosMapMode::trinary;
    if (value == "scale") return RosMapMode::scale;
    if (value == "raw") return RosMapMode::raw;
    fail(path_, "its 'mode' is none of trinary, scale and raw");
  }

 private:
  [[noreturn]] void refuse(std::string_view key) const
  {
    fail(path_, "not a ROS map: '" + std::string(key) +
                    "' is missing or bad; 'image', 'resolution', 'origin: [x, y, yaw]', "
                    "'free_thresh' and 'occupied_thresh' are needed");
  }

  const Values& values_;
  const std::filesystem::path& path_;
};

void check(const RosMapHeader& header, const std::filesystem::path& path)
{
  if (const auto reason = unusableCells(header.resolution)) fail(path, *reason);
  if (const auto reason = beyondReach(header.origin.x, header.origin.y)) fail(path, *reason);
  constexpr double kMostTurn = 1e3;  // [rad]
  if (std::abs(header.origin.phi) > kMostTurn) fail(path, "its origin has no usable yaw");
  const bool ordered = header.free_threshold >= 0 && header.occupied_threshold <= 1 &&
                       header.free_threshold <= header.occupied_threshold;
  if (!ordered) fail(path, "needs 0 <= free_thresh <= occupied_thresh <= 1");
}
}  // namespace

RosMapHeader parseRosMapYaml(std::string_view text, const std::filesystem::path& path)
{
  if (text.size() > kMostBytes) fail(path, "not a ROS map: more than 64 kB of yaml");
  if (text.find('\0') != std::string_view::npos) fail(path, "not a text file");
  const Values values = valuesIn(text, path);
  const Header given(values, path);
  RosMapHeader header;
  header.image = std::string(given.text("image"));
  header.mode = given.mode();
  header.negate = given.flag("negate");
  header.resolution = given.number("resolution");
  const std::vector<double> origin = given.numbers("origin", 3);
  header.origin = {origin[0], origin[1], origin[2]};
  header.free_threshold = given.number("free_thresh");
  header.occupied_threshold = given.number("occupied_thresh");
  check(header, path);
  return header;
}

RosMapHeader readRosMapHeader(const std::filesystem::path& path)
{
  requireFile(path);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::string text(std::min<std::uintmax_t>(size, kMostBytes) + 1, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  RosMapHeader header = parseRosMapYaml(text, path);
  if (header.image.is_relative()) header.image = path.parent_path() / header.image;
  return header;
}
}  // namespace sigloc::detail
