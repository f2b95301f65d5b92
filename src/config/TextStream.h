// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace sigloc
{
/// A stream in memory that spells and reads numbers alike whatever locale the host program has set.
class TextStream : public std::stringstream
{
 public:
  explicit TextStream(const std::string& text = {})
      : std::stringstream(text, std::ios::in | std::ios::out | std::ios::ate)
  {
    imbue(std::locale::classic());
  }
};
}  // namespace sigloc
