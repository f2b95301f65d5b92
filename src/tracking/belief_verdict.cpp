// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/belief_verdict.h"

#include <algorithm>

#include "matching/verdict.h"
#include "tracking/rivals.h"

namespace sigloc
{
Belief beliefOf(const TrackSet& set, const FeatureMap& map, const TrackerOptions& options)
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
    hypothesis.weight *= here / (1.0 - options.min_elsewhere);
    sum += hypothesis.weight;
  }
  belief.elsewhere = std::max(0.0, 1.0 - sum);
  return belief;
}

const DenseField* fieldOf(const FeatureMap& map)
{
  return map.field() ? &*map.field() : nullptr;
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
  belief.reason = has_rivals ? describeRivals(belief.hypotheses, field) : toString(decision.reason);
}
}  // namespace sigloc
