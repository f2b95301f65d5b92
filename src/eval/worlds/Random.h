// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace sigloc
{
/// Random numbers for simulations: the same on every machine for the same seed, because the
/// distributions are implemented here. Those of the standard library differ between
/// implementations.
///
/// Streams with the same seed and different numbers are independent, so that adding a draw to one
/// part of a simulation leaves the others as they were.
class Random
{
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Normal with mean 0 and standard deviation 1.
  double normal();
  /// Uniform in {0, ..., count - 1}; `count` > 0.
  std::size_t index(std::size_t count);
  /// True with the given probability.
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::mt19937_64 engine_;
  bool has_spare_ = false;
  double spare_ = 0;
};
}  // namespace sigloc
