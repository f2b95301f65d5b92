// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>

#include "sigloc/config/option_fields.h"

namespace sigloc::python
{
/// The options that keywords set. Raises TypeError for a keyword that is no option or a value of
/// another type.
template <class Options>
Options optionsOf(const pybind11::kwargs& keywords)
{
  Options options;
  pybind11::dict left(keywords.attr("copy")());
  Options::visitFields(
      [&](const auto& field)
      {
        if (!left.contains(field.key)) return;
        using T = std::decay_t<decltype(options.*(field.member))>;
        try
        {
          options.*(field.member) = left[field.key].template cast<T>();
        }
        catch (const pybind11::cast_error&)
        {
          throw pybind11::type_error(std::string("option '") + field.key + "' is of another type");
        }
        left.attr("pop")(field.key);
      });
  for (const auto& [key, value] : left)
  {
    const auto name = key.template cast<std::string>();
    throw pybind11::type_error("no such option: '" + name + "'" +
                               didYouMean(name, optionKeys<Options>()));
  }
  return options;
}

/// A line an option, for a docstring.
template <class Options>
std::string describeOptions(const char* before)
{
  std::string text = before;
  Options::visitFields(
      [&](const auto& field)
      {
        text += std::string("\n") + field.key + " = " +
                detail::formatValue(Options{}.*(field.member)) + ": " + field.description;
      });
  return text;
}
}  // namespace sigloc::python
