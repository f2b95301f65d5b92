// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

#include "io/archive_values.h"
#include "sigloc/config/option_fields.h"

namespace sigloc::detail
{
// Options are stored by name, so that later versions may add and drop some.
template <class Options>
void writeOptions(const Options& options, mrpt::serialization::CArchive& out)
{
  out << static_cast<std::uint32_t>(optionKeys<Options>().size());
  Options::visitFields(
      [&](const auto& field)
      { out << std::string(field.key) << static_cast<double>(options.*(field.member)); });
}

template <class Options>
Options readOptions(mrpt::serialization::CArchive& in)
{
  constexpr std::uint32_t kMostOptions = 1000;
  constexpr std::uint32_t kLongestKey = 200;
  std::uint32_t count = 0;
  in >> count;
  if (count > kMostOptions) throw BadContent(std::to_string(count) + " options");
  std::map<std::string, double> stored;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::string key = readText(in, kLongestKey);
    double value = 0;
    in >> value;
    stored[key] = value;
  }
  Options options;
  Options::visitFields(
      [&](const auto& field)
      {
        using T = std::decay_t<decltype(options.*(field.member))>;
        const auto entry = stored.find(field.key);
        if (entry == stored.end()) return;
        // Asked before the cast, which is undefined for a number that the type cannot hold.
        const double value = entry->second;
        if (!(value >= static_cast<double>(field.minimum) &&
              value <= static_cast<double>(field.maximum)))
        {
          throw BadContent(std::string("the option ") + field.key + " is out of range");
        }
        options.*(field.member) = static_cast<T>(value);
      });
  checkOptions(options);
  return options;
}
}  // namespace sigloc::detail
