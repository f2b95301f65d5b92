// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sigloc::detail
{
/// Why an observation cannot be used, in words for a user.
struct Unusable : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Reads what an object of MRPT is stored as, front to back. Every count is compared with the bytes
/// that are there before memory is taken for it. Throws Unusable.
class ContentReader
{
 public:
  explicit ContentReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T value()
  {
    T value{};
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  bool flag() { return value<std::uint8_t>() != 0; }

  /// Returns the next `count` items of `bytes` each, as they are.
  std::string_view items(std::size_t count, std::size_t bytes = 1)
  {
    if (count > left_.size() / bytes) throw Unusable("damaged");
    return take(count * bytes);
  }

  std::string_view text() { return items(value<std::uint32_t>()); }

  /// Takes the head of an object. Returns its version. Throws where it is of another class than
  /// `name`, which is without a namespace.
  int object(std::string_view name);
  /// The same for an object of any class; its name without namespace is put into `name`.
  int anyObject(std::string& name);
  /// Takes the end of an object.
  void end();

  mrpt::poses::CPose3D pose();

 private:
  std::string_view take(std::size_t bytes)
  {
    if (bytes > left_.size()) throw Unusable("damaged");
    const std::string_view taken = left_.substr(0, bytes);
    left_.remove_prefix(bytes);
    return taken;
  }

  std::string_view left_;
};

/// Returns item `i` of some that ContentReader::items() returned.
template <class T>
T itemOf(std::string_view items, std::size_t i)
{
  T value{};
  std::memcpy(&value, items.data() + i * sizeof(T), sizeof(T));
  return value;
}
}  // namespace sigloc::detail
