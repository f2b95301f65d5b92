// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace sigloc::detail
{
/// Returns the value below which about `share`, in [0, 1], of the sorted values lie: the one at the
/// place nearest to share (n - 1), as pf-localization does. There must be one.
inline double quantileOf(const std::vector<double>& sorted, double share)
{
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(share * last))];
}
}  // namespace sigloc::detail
