// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "map_check.h"

namespace sigloc
{
/// A drive in a picture, to metres. It is never "0": a place has a drive because one scan is not
/// enough there.
inline std::string metresText(double drive)
{
  if (!std::isfinite(drive)) return fmt::format(">{:.0f}", MapCheck::kDrive);
  return drive < 1 ? "<1" : fmt::format("{:.0f}", drive);
}
}  // namespace sigloc
