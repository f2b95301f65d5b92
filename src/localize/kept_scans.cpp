// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/kept_scans.h"

#include <algorithm>

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostChanges = 400;
constexpr std::size_t kMoments = 3;  // first right, first localized, last

/// Of so many steps one is chosen so that at most `most` are.
std::size_t intervalFor(std::size_t steps, std::size_t most)
{
  return std::max<std::size_t>(1, (steps + most - 1) / most);
}

/// The steps whose verdict is not that of the step before.
std::vector<std::size_t> changesOfVerdict(const std::vector<StepRecord>& steps)
{
  std::vector<std::size_t> changes;
  for (std::size_t k = 1; k < steps.size(); ++k)
  {
    if (steps[k].belief.verdict != steps[k - 1].belief.verdict) changes.push_back(k);
  }
  return changes;
}
}  // namespace

KeptScans keptScans(const std::vector<StepRecord>& steps)
{
  KeptScans scans;
  scans.kept.assign(steps.size(), true);
  if (steps.size() <= KeptScans::kMost) return scans;
  scans.every = intervalFor(steps.size(), KeptScans::kMost - kMostChanges - kMoments);
  for (std::size_t k = 0; k < steps.size(); ++k) scans.kept[k] = k % scans.every == 0;
  const std::vector<std::size_t> changes = changesOfVerdict(steps);
  const std::size_t stride = intervalFor(changes.size(), kMostChanges);
  for (std::size_t i = 0; i < changes.size(); i += stride) scans.kept[changes[i]] = true;
  const auto keep_first = [&](auto is_one)
  {
    const auto first = std::find_if(steps.begin(), steps.end(), is_one);
    if (first != steps.end()) scans.kept[static_cast<std::size_t>(first - steps.begin())] = true;
  };
  keep_first([](const StepRecord& step) { return step.truth && step.any_right; });
  keep_first([](const StepRecord& step) { return step.belief.verdict == Verdict::localized; });
  scans.kept.back() = true;
  return scans;
}
}  // namespace sigloc::detail
