// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/RelocationSchedule.h"

#include <algorithm>

namespace sigloc
{
void RelocationSchedule::countTravel(const Travel& travel)
{
  since_relocation_ += travel.with_turns;
  travelled_ += travel.with_turns;
}

void RelocationSchedule::noteVerdict(bool localized)
{
  localized_ = localized;
  if (localized) searched_ = 0;
}

bool RelocationSchedule::isDue(bool suspicious) const
{
  if ((waking_up_ && !waits_) || suspicious) return true;
  return since_relocation_ >=
         (localized_ ? options_.confirmation_distance : options_.relocation_distance);
}

void RelocationSchedule::noteKnownStart()
{
  waking_up_ = false;
  searched_all_ = true;
  since_relocation_ = 0;
}

bool RelocationSchedule::noteResult(const RelocationResult& result)
{
  const bool answered = result.verdict != Verdict::too_little_seen;
  if (!answered && result.complete) return false;
  since_relocation_ = 0;
  waits_ = !answered;
  if (!answered) return false;
  waking_up_ = false;
  searched_all_ = searched_all_ || result.complete;
  return true;
}

double RelocationSchedule::freshShare() const
{
  return waking_up_ ? 1.0 : std::min(1.0, since_relocation_ / options_.evidence_distance);
}
}  // namespace sigloc
