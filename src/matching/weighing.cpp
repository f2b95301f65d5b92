// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/weighing.h"

#include <algorithm>
#include <cmath>

#include "sigloc/geometry/pose_fusion.h"

namespace sigloc
{
namespace
{
// Fitted on aces, freiburg-101 and foreign pairs of the two, \cite algorithm section 7.
constexpr double kScoreSlope = 15.0;  // of the log-likelihood per unit of score
constexpr double kMisfitPower = 5.0;  // of the unexplained share
constexpr double kMisfitFloor = 0.02;  // share that even the right pose leaves unexplained
constexpr double kSharpening = 1.3;  // of rivals against each other
constexpr double kHereSlope = 12.0;  // of the log-odds of being in the map, per unit of score
constexpr double kHereOffset = 10.4;
constexpr double kChanceScore = 0.4;  // what chance reaches where there is no runner-up
constexpr double kFeatureTempering = 0.25;  // features of one scan share their errors
constexpr double kPriorElsewhere =
    0.002;  // of standing off the map, and of a generator that failed
constexpr double kLocalized = 0.99;
constexpr double kNotHere = 0.98;
constexpr double kMaxOpenSigma = 0.5;  // [m], a wider pose is a line of poses

/// The verdict that the weights allow.
void decide(RelocationResult& result)
{
  if (result.candidates.empty())
  {
    result.elsewhere = 1;
    result.verdict = Verdict::not_here;
    result.probability = 1;
    return;
  }
  const Candidate& first = result.candidates.front();
  if (first.probability >= kLocalized && largestPositionSigma(first.pose) < kMaxOpenSigma)
  {
    result.verdict = Verdict::localized;
    result.probability = first.probability;
  }
  else if (result.elsewhere >= kNotHere)
  {
    result.verdict = Verdict::not_here;
    result.probability = result.elsewhere;
  }
  else
  {
    result.verdict = Verdict::ambiguous;
    result.probability = 1.0 - first.probability;
  }
}
}  // namespace

double logLikelihoodOfScore(double score)
{
  const double misfit = std::max(1.0 - score, 0.0) + kMisfitFloor;
  return kScoreSlope * score - kMisfitPower * std::log(misfit);
}

double reliabilityOf(const DenseEvidence& evidence)
{
  constexpr double kLeastSeen = 0.25;  // share of the returns that must be left to judge by
  const double seen = std::max(kLeastSeen, 1.0 - evidence.in_free);
  return std::clamp((evidence.fine - 0.5 * evidence.through_wall) / seen, 0.0, 1.0);
}

double hereLogOdds(double best_score, double rival_score)
{
  return kHereSlope * best_score + logLikelihoodOfScore(best_score) -
         logLikelihoodOfScore(rival_score) - kHereOffset;
}

void weighCandidates(RelocationResult& result)
{
  std::vector<Candidate>& candidates = result.candidates;
  if (candidates.empty()) return decide(result);
  const double best = logLikelihoodOfScore(candidates.front().score);
  const double runner_up = candidates.size() > 1 ? candidates[1].score : kChanceScore;
  const double here = 1.0 / (1.0 + std::exp(-hereLogOdds(candidates.front().score, runner_up)));

  double sum = 0;
  for (Candidate& candidate : candidates)
  {
    candidate.probability = std::exp(kSharpening * (logLikelihoodOfScore(candidate.score) - best));
    sum += candidate.probability;
  }
  for (Candidate& candidate : candidates) candidate.probability *= here / sum;
  result.elsewhere = 1.0 - here;

  decide(result);
}

void weighByLogOdds(RelocationResult& result)
{
  std::vector<Candidate>& candidates = result.candidates;
  double largest = 0;  // the clutter hypothesis itself has log-odds 0
  for (const Candidate& candidate : candidates) largest = std::max(largest, candidate.score);
  double sum = std::exp(-kFeatureTempering * largest);
  for (Candidate& candidate : candidates)
  {
    candidate.probability = std::exp(kFeatureTempering * (candidate.score - largest));
    sum += candidate.probability;
  }
  for (Candidate& candidate : candidates)
  {
    candidate.probability *= (1.0 - kPriorElsewhere) / sum;
  }
  result.elsewhere =
      kPriorElsewhere + (1.0 - kPriorElsewhere) * std::exp(-kFeatureTempering * largest) / sum;
  decide(result);
}
}  // namespace sigloc
