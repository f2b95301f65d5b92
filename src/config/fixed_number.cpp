// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "config/fixed_number.h"

#include <cmath>
#include <iomanip>

#include "config/TextStream.h"

namespace sigloc
{
std::string fixedNumber(double value, int decimals)
{
  if (std::isnan(value)) return "";
  TextStream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}
}  // namespace sigloc
