// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace sigloc
{
/// Returns a count with its noun: "1 step", "2 steps". `plural` is for nouns that take more than an
/// "s".
inline std::string counted(std::size_t count, const std::string& singular,
                           const std::string& plural = {})
{
  return std::to_string(count) + " " +
         (count == 1       ? singular
          : plural.empty() ? singular + "s"
                           : plural);
}
}  // namespace sigloc
