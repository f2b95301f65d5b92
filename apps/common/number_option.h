// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "sigloc/config/option_fields.h"

namespace sigloc
{
/// Returns the check of an option that must be a number from `low` to `high`. Unlike CLI11's own
/// check it refuses "nan", and a negative count that wraps around.
template <class T = double>
CLI::Validator numberFrom(std::common_type_t<T> low, std::common_type_t<T> high)
{
  const std::string range = "from " + detail::formatValue(low) + " to " + detail::formatValue(high);
  const auto check = [low, high, range](const std::string& given)
  {
    const std::optional<T> value = detail::parseValue<T>(given);
    return value && *value >= low && *value <= high ? "" : given + ": not a number " + range;
  };
  return {check, range};
}

/// Adds an option that must be a number from `low` to `high`; the help tells its default.
template <class T>
CLI::Option* addNumber(CLI::App& command, const std::string& name, T& value,
                       const std::string& description, double low, double high)
{
  return command.add_option(name, value, description)
      ->check(numberFrom(low, high))
      ->capture_default_str();
}
}  // namespace sigloc
