// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "sigloc/localize/LocalizationRun.h"

namespace sigloc::detail
{
/// The steps of a run whose scans its page holds. Scans are its largest part, so that it holds a
/// bounded number.
struct KeptScans
{
  static constexpr std::size_t kMost = 2000;

  std::size_t every = 1;  ///< of so many steps one is kept, counted from the first
  std::vector<bool> kept;  ///< of each step
};

/// All of a short run. Of a long one every n-th, the last, the first right one, the first localized
/// one, and those where the verdict changes. Where these are very many, some are left out.
KeptScans keptScans(const std::vector<StepRecord>& steps);
}  // namespace sigloc::detail
