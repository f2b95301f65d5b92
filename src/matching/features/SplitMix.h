// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace sigloc
{
/// A small generator of random numbers (SplitMix64) for sampling within a query. It gives the same
/// numbers on every machine and is cheap to start.
class SplitMix
{
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next()
  {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// Returns a number that is uniform in {0, ..., count - 1}; `count` > 0.
  std::uint32_t index(std::uint32_t count)
  {
    return static_cast<std::uint32_t>(((next() >> 32) * count) >> 32);
  }
  template <class T>
  void shuffle(std::vector<T>& values)
  {
    for (std::size_t k = values.size(); k > 1; --k)
    {
      std::swap(values[k - 1], values[index(static_cast<std::uint32_t>(k))]);
    }
  }

 private:
  std::uint64_t state_;
};
}  // namespace sigloc
