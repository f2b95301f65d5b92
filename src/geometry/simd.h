// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// Placed before a function, this compiles it twice. The form for wide vectors runs where the
/// processor has them. Everything called in its loops is inlined into both forms. Sanitizers do
/// without: the choice is made by instrumented code, before they are ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SIGLOC_WIDE_VECTORS __attribute__((target_clones("avx2", "default"), flatten))
#else
#define SIGLOC_WIDE_VECTORS
#endif

namespace sigloc
{
constexpr std::size_t kWideFloats = 8;

/// Eight floats that are processed together, by as many instructions as the processor needs. Sums
/// are the same, bit for bit, whether it processes four at once or eight.
using WideFloat = float __attribute__((vector_size(kWideFloats * sizeof(float))));

/// Eight integers. A comparison of two wide values gives -1 where it is true, 0 elsewhere.
using WideInt = std::int32_t __attribute__((vector_size(kWideFloats * sizeof(std::int32_t))));

/// Reads the first n <= 8 floats; the others become 0. The result is an argument, because the way a
/// wide vector is returned depends on the instructions that a function is compiled for.
inline void loadWide(const float* from, std::size_t n, WideFloat& to)
{
  if (n == kWideFloats)
  {
    std::memcpy(&to, from, sizeof(to));
    return;
  }
  to = WideFloat{};
  std::memcpy(&to, from, n * sizeof(float));
}

/// Reads from eight places of a table, each counted from its beginning.
template <class T>
void loadWide(const T* table, const WideInt& places, WideInt& to)
{
  const auto at = [&](std::size_t k)
  { return static_cast<std::int32_t>(table[static_cast<std::uint32_t>(places[k])]); };
  to = WideInt{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)};
}

inline float sumOf(const WideFloat& v)
{
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Returns whether any of them is not 0.
inline bool anyOf(const WideInt& v)
{
  std::array<std::uint64_t, sizeof(v) / sizeof(std::uint64_t)> pairs;
  std::memcpy(pairs.data(), &v, sizeof(v));
  std::uint64_t all = 0;
  for (const std::uint64_t pair : pairs) all |= pair;
  return all != 0;
}
}  // namespace sigloc
