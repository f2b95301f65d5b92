// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/SeenReturns.h"

#include <fmt/core.h>

#include <algorithm>

namespace sigloc
{
void SeenReturns::add(const LaserScan& scan)
{
  ++scans_;
  const auto is_valid = [](std::uint8_t valid) { return valid != 0; };
  any_ = any_ || std::any_of(scan.valid.begin(), scan.valid.end(), is_valid);
  limit_ = std::max(limit_, scan.max_range);
}

// A reader may take a range that is too frequent for the laser's limit, and that one must be told.
std::string SeenReturns::whyNone() const
{
  return fmt::format(
      "no scan has a valid return: every range is 0, no number, marked as none, or at the laser's "
      "limit, which is taken to be {:g} m",
      limit_);
}
}  // namespace sigloc
