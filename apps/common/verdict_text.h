// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>
#include <string>

#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// The verdict and, in brackets, how probable the first pose is, whatever the verdict:
/// "ambiguous (0.984)".
inline std::string verdictText(const Belief& belief)
{
  if (belief.hypotheses.empty()) return fmt::format("{} (no pose)", toString(belief.verdict));
  return fmt::format("{} ({})", toString(belief.verdict),
                     probabilityText(belief.probabilityOfFirst()));
}
}  // namespace sigloc
