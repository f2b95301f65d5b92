// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sigloc
{
/// A cell of a grid as one number, for hashes and for sorting: the low 32 bits of both indices.
constexpr std::uint64_t cellKey(std::int64_t x, std::int64_t y)
{
  return static_cast<std::uint64_t>(x) << 32U | static_cast<std::uint32_t>(y);
}

constexpr std::int32_t xOfCell(std::uint64_t key)
{
  return static_cast<std::int32_t>(key >> 32U);
}

constexpr std::int32_t yOfCell(std::uint64_t key)
{
  return static_cast<std::int32_t>(key);
}
}  // namespace sigloc
