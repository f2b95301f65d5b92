// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "config/fixed_number.h"

#include <fmt/core.h>

#include <cmath>

namespace sigloc
{
std::string fixedNumber(double value, int decimals)
{
  return std::isnan(value) ? "" : fmt::format("{:.{}f}", value, decimals);
}
}  // namespace sigloc
