// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "eval/wakeup/wakeup.h"

namespace sigloc
{
namespace
{
using Steps = std::vector<WakeupStep>;

/// Index of the first confident step from which the method stays confident to the end. Steps
/// outside the mapped area are ignored.
std::size_t settledAt(const Steps& steps)
{
  std::size_t settled = steps.size();
  while (settled > 0 && (steps[settled - 1].claim.confident || !steps[settled - 1].mapped))
  {
    --settled;
  }
  while (settled < steps.size() && !steps[settled].claim.confident) ++settled;
  return settled;
}

/// Index of the first step after the kidnapping that does not claim a wrong pose.
std::size_t noticedAt(const Wakeup& run)
{
  std::size_t noticed = run.kidnapped_at;
  while (noticed < run.steps.size() && run.steps[noticed].claim.confident &&
         run.steps[noticed].judged != Claim::right)
  {
    ++noticed;
  }
  return noticed;
}

/// The distance and time between two steps; none when there is no step `to`.
std::optional<WakeupEvent> eventAt(const Steps& steps, std::size_t from, std::size_t to)
{
  if (to >= steps.size()) return std::nullopt;
  return WakeupEvent{steps[to].travelled - steps[from].travelled,
                     steps[to].seconds - steps[from].seconds};
}

void countWrong(Wakeup& run)
{
  for (std::size_t i = 0; i < run.steps.size(); ++i)
  {
    if (run.steps[i].judged != Claim::wrong) continue;
    ++run.wrong_steps;
    run.wrong_mapped_steps += run.steps[i].mapped;
    if (i == 0 || run.steps[i - 1].judged != Claim::wrong) ++run.wrong_episodes;
  }
}
}  // namespace

std::optional<std::size_t> judgedStep(const Wakeup& run)
{
  for (std::size_t i = run.steps.size(); i > 0; --i)
  {
    if (run.steps[i - 1].mapped && !std::isnan(run.steps[i - 1].error.distance)) return i - 1;
  }
  return std::nullopt;
}

bool isFailedRun(const Wakeup& run)
{
  return run.wrong_steps > 0 || (judgedStep(run) && !run.right_at_end);
}

void judgeRun(Wakeup& run)
{
  const Steps& steps = run.steps;
  const std::size_t from = run.kidnapped_at;  // 0, the start, without a kidnapping
  std::size_t settled = settledAt(steps);
  if (run.kidnapped_at > 0)
  {
    const std::size_t noticed = noticedAt(run);
    run.noticed_after = eventAt(steps, from, noticed);
    settled = std::max(settled, noticed);
  }
  run.settled_after = eventAt(steps, from, settled);
  run.cpu_to_settled = 0;
  for (std::size_t i = from; i < steps.size() && i <= settled; ++i)
  {
    run.cpu_to_settled += 1e-3 * steps[i].time_ms;
  }
  countWrong(run);
  const auto judged = judgedStep(run);
  run.right_at_end = judged && steps[*judged].judged == Claim::right;
}
}  // namespace sigloc
