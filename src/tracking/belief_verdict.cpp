// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/belief_verdict.h"

#include <algorithm>

#include "matching/verdict.h"
#include "tracking/rivals.h"

namespace sigloc
{
Belief beliefOf(const TrackSet& set, const FeatureMap& map)
{
  Belief belief;
  belief.elsewhere = set.elsewhere;
  for (const Track& track : set.tracks)
  {
    belief.hypotheses.push_back(track.hypothesis);
    belief.hypotheses.back().pose = withCommonError(track.hypothesis.pose, map.error());
  }
  if (set.tracks.empty()) return belief;
  const double here = set.probabilityHere();
  double sum = 0;
  for (TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    hypothesis.weight *= here / (1.0 - set.options().min_elsewhere);
    sum += hypothesis.weight;
  }
  belief.elsewhere = std::max(0.0, 1.0 - sum);
  return belief;
}

void setVerdict(Belief& belief, VerdictGrounds grounds, double sure, const DenseField* field)
{
  grounds.poses = belief.hypotheses.size();
  grounds.elsewhere = belief.elsewhere;
  if (grounds.poses > 0)
  {
    grounds.first = belief.hypotheses.front().weight;
    grounds.first_pose = belief.hypotheses.front().pose;
  }
  const VerdictDecision decision = decideVerdict(grounds, sure);
  belief.verdict = decision.verdict;
  belief.probability = decision.probability;
  const bool has_rivals =
      decision.reason == VerdictReason::not_sure ||
      (decision.reason == VerdictReason::unconfirmed && belief.hypotheses.size() > 1);
  belief.reason = has_rivals ? describeRivals(belief.hypotheses, belief.elsewhere, field)
                             : toString(decision.reason);
}

void concludeBelief(Belief& belief, const TrackSet& set, RelocationSchedule& schedule,
                    const FeatureMap& map, const StepFindings& findings)
{
  VerdictGrounds grounds;
  grounds.sees_too_little = findings.sees_too_little;
  grounds.unfinished = !schedule.hasSearchedAll();
  if (!set.tracks.empty())
  {
    belief.reliability = findings.reliability;
    grounds.confirmed = set.isConfirmed();
    grounds.doubtful = findings.doubtful;
  }
  const DenseField* const field = map.field() ? &*map.field() : nullptr;
  setVerdict(belief, grounds, set.options().localized_probability, field);
  schedule.noteVerdict(belief.verdict == Verdict::localized);
}
}  // namespace sigloc
