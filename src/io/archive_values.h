// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>
#include <string>

namespace sigloc::detail
{
/// Content that was read as it was written, but that nothing can have written in good faith.
class BadContent : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a truth value as MRPT writes it. MRPT's own reader puts any byte into a bool, whose use is
/// undefined then. Throws BadContent for one but 0 and 1.
inline bool readFlag(mrpt::serialization::CArchive& in)
{
  std::uint8_t flag = 0;
  in >> flag;
  if (flag > 1) throw BadContent("a truth value of " + std::to_string(flag));
  return flag == 1;
}

/// Reads a string as MRPT writes it. MRPT's own reader allocates what the length says before it
/// reads. Throws BadContent for a string longer than `most`.
inline std::string readText(mrpt::serialization::CArchive& in, std::uint32_t most)
{
  std::uint32_t length = 0;
  in >> length;
  if (length > most) throw BadContent("a text of " + std::to_string(length) + " bytes");
  std::string text(length, '\0');
  if (length > 0 && in.ReadBuffer(text.data(), length) != length)
  {
    throw std::runtime_error("a text is cut off");
  }
  return text;
}
}  // namespace sigloc::detail
