// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>

#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

namespace sigloc
{
/// One row of an options table: the key in the ini file, the member that it sets, the allowed range
/// (inclusive) and one line of documentation. That line starts with the unit in brackets.
///
/// An options struct `O` offers `template <class V> static void visitFields(V&& visit)` that calls
/// `visit(OptionField<O, T>{...})` once per member. That single table drives loading, saving,
/// checking and the test that the shipped ini files equal the defaults in the code.
template <class Options, class T>
struct OptionField
{
  const char* key;
  T Options::*member;
  T minimum;
  T maximum;
  const char* description;
};

template <class Options, class T>
OptionField(const char*, T Options::*, T, T, const char*) -> OptionField<Options, T>;

/// Returns "; did you mean '...'?" with the known word that differs from `word` by the fewest
/// slips: at most one in three letters, upper and lower case alike. Empty where none is so near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

namespace detail
{
/// Returns the value of a whole text. It is std::nullopt for "1.5 m" or "maybe", and for a number
/// that T cannot represent.
template <class T>
std::optional<T> parseValue(const std::string& text)
{
  if constexpr (std::is_same_v<T, bool>)
  {
    if (text == "true" || text == "yes" || text == "1") return true;
    if (text == "false" || text == "no" || text == "0") return false;
    return std::nullopt;
  }
  else
  {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
    return std::nullopt;
  }
}

/// Returns the shortest text that parseValue() turns back into exactly this value.
template <class T>
std::string formatValue(T value)
{
  if constexpr (std::is_same_v<T, bool>)
  {
    return value ? "true" : "false";
  }
  else
  {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
  }
}

/// Returns what a value from `least` to `most` is, for messages.
template <class T>
std::string wantedValue(T least, T most)
{
  if constexpr (std::is_same_v<T, bool>)
  {
    return "true or false";
  }
  else
  {
    return (std::is_integral_v<T> ? "a whole number from " : "a number from ") +
           formatValue(least) + " to " + formatValue(most);
  }
}
}  // namespace detail

/// Throws std::invalid_argument naming the key when a value lies outside its range or is NaN.
template <class Options>
void checkOptions(const Options& options)
{
  Options::visitFields(
      [&](const auto& field)
      {
        const auto value = options.*(field.member);
        const bool inside = value >= field.minimum && value <= field.maximum;
        if (!inside)
        {
          throw std::invalid_argument(std::string("option '") + field.key +
                                      "' = " + detail::formatValue(value) + " is outside [" +
                                      detail::formatValue(field.minimum) + ", " +
                                      detail::formatValue(field.maximum) + "]");
        }
      });
}

/// Returns the keys of an options struct, in table order.
template <class Options>
std::vector<std::string> optionKeys()
{
  std::vector<std::string> keys;
  Options::visitFields([&](const auto& field) { keys.emplace_back(field.key); });
  return keys;
}

/// Returns options read from one ini section; keys that are absent keep the value of `defaults`.
/// Throws std::invalid_argument for a key of the section that is not in the table, a value that is
/// not of the field's type, or one outside its range.
template <class Options>
Options loadOptions(const mrpt::config::CConfigFileBase& ini, const std::string& section,
                    const Options& defaults = {})
{
  std::vector<std::string> present;
  ini.getAllKeys(section, present);
  const std::vector<std::string> known = optionKeys<Options>();
  const std::set<std::string> known_set(known.begin(), known.end());
  for (const std::string& key : present)
  {
    if (known_set.count(key) == 0)
    {
      // Written without brackets: MRPT's programs take text before one for a source location.
      throw std::invalid_argument("section " + section + ": unknown key '" + key + "'" +
                                  didYouMean(key, known));
    }
  }
  Options options = defaults;
  Options::visitFields(
      [&](const auto& field)
      {
        using T = std::decay_t<decltype(options.*(field.member))>;
        if (!ini.keyExists(section, field.key)) return;
        const std::string text = ini.read_string(section, field.key, "");
        const std::optional<T> value = detail::parseValue<T>(text);
        if (!value)
        {
          throw std::invalid_argument("section " + section + ": bad value '" + text + "' for '" +
                                      field.key + "', not " +
                                      detail::wantedValue<T>(field.minimum, field.maximum));
        }
        options.*(field.member) = *value;
      });
  checkOptions(options);
  return options;
}

/// Writes every field with its description as the comment, so that a saved section can be edited.
template <class Options>
void saveOptions(const Options& options, mrpt::config::CConfigFileBase& ini,
                 const std::string& section)
{
  Options::visitFields(
      [&](const auto& field)
      {
        // MRPT itself writes a double with six decimals only.
        const std::string text = detail::formatValue(options.*(field.member));
        ini.write(section, field.key, text, -1, -1, field.description);
      });
}
}  // namespace sigloc
