// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

#include "sigloc/io/RawlogReader.h"

namespace sigloc::detail
{
/// Throws std::invalid_argument for options out of their ranges, or with heights that no point can
/// be between.
inline void checkReading(const ReadingOptions& reading)
{
  checkOptions(reading);
  if (!(reading.min_height < reading.max_height))
    throw std::invalid_argument("the lowest height of walls is not below the highest");
}
}  // namespace sigloc::detail
