// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/belief_verdict.h"

#include "geometry/pose_fusion.h"
#include "tracking/rivals.h"

namespace sigloc
{
namespace
{
constexpr double kMaxOpenSigma = 0.5;  // [m], a wider pose is a line of poses
constexpr double kNotHere = 0.98;

void say(Belief& belief, Verdict verdict, double probability, const std::string& reason)
{
  belief.verdict = verdict;
  belief.probability = probability;
  belief.reason = reason;
}
}  // namespace

void decideVerdict(Belief& belief, const BeliefGrounds& grounds, double sure,
                   const DenseField* field)
{
  if (belief.hypotheses.empty())
  {
    if (grounds.sees_too_little)
    {
      say(belief, Verdict::too_little_seen, belief.elsewhere, "fewer returns than needed");
    }
    else
    {
      say(belief, Verdict::not_here, belief.elsewhere, "nothing in the map explains the scan");
    }
    return;
  }
  const TrackedHypothesis& first = belief.hypotheses.front();
  const bool open = largestPositionSigma(first.pose) >= kMaxOpenSigma;
  if (first.weight >= sure && grounds.confirmed && !grounds.doubtful && !open)
  {
    say(belief, Verdict::localized, first.weight, "one hypothesis holds");
  }
  else if (belief.elsewhere >= kNotHere)
  {
    say(belief, Verdict::not_here, belief.elsewhere, "no hypothesis explains the scan");
  }
  else
  {
    const bool rivalled = first.weight < sure || belief.hypotheses.size() > 1;
    say(belief, Verdict::ambiguous, 1.0 - first.weight,
        open               ? "the position is open along a line"
        : grounds.doubtful ? "the hypothesis explains much less than it used to"
        : rivalled         ? describeRivals(belief.hypotheses, field)
                           : "too little of what has been seen is explained by this map alone");
  }
}
}  // namespace sigloc
