// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/candidate_probabilities.h"

#include <algorithm>
#include <cmath>

#include "matching/verdict.h"

namespace sigloc
{
namespace
{
// Fitted on aces, freiburg-101 and foreign pairs of the two, \cite algorithm section 7.
constexpr double kScoreSlope = 15.0;  // log-likelihood per unit of score, eq. (7.1)
constexpr double kMisfitPower = 5.0;  // power of the unexplained share, eq. (7.1)
constexpr double kMisfitFloor =
    0.02;  // share that even the right pose leaves unexplained, eq. (7.1)
// The log-odds of being in the map, fitted on simulated worlds too, eq. (7.2).
constexpr double kExplainedSlope = 12.52;  // per share of explained or occluded returns
constexpr double kThroughSlope = 14.93;  // per share of beams through walls
constexpr double kWallSlope = 0.363;  // per explained wall
constexpr double kMissingWallSlope = 0.611;  // per wall that is not mapped
constexpr double kWallEndSlope = 0.882;  // per explained wall end
constexpr double kLeadSlope = 0.287;  // per unit of log-likelihood ahead of the best rival
constexpr double kFitOffset = 14.36;  // constant of eq. (7.2) without the prior of 2.6
// A scan with little angular coverage fits elsewhere by chance. The scans that were fitted on cover
// 180 degrees and more, so a further term is needed.
constexpr double kFullCoverage = M_PI / 2;  // [rad] angular coverage from which the term is 0
constexpr double kNarrowSlope = 12.0;  // log-odds per share of this coverage that is missing
constexpr double kPriorOutside = 0.01;  // prior of a pose outside the prior region, section 7
constexpr double kBackgroundScore = 0.4;  // score of the background without a runner-up, eq. (7.2)
constexpr double kUsualScore = 0.8;  // usual score of the right pose, eq. (7.6)
// Odds that the right pose was not refined, as a share of the runner-up's relative likelihood.
// Fitted by scripts/fit_missed, eq. (7.8).
constexpr double kUnrefinedShare = 0.44;
// Factors of the log-odds of features, eq. (7.4). Walls of a scan share its errors, and buildings
// repeat walls. Places gathered over a drive share less.
constexpr double kWallTempering = 0.25;  // where the scan has walls
constexpr double kPlaceTempering = 0.5;  // where it has none

/// Returns the score of the best candidate but the k-th, or that of the background without one.
double rivalScore(const RelocationResult& result, std::size_t k)
{
  const std::size_t rival = k == 0 ? 1 : 0;
  return rival < result.candidates.size() ? result.candidates[rival].score : kBackgroundScore;
}

/// Returns what a share of the returns is of those that remain when the ones in free space count as
/// occlusions.
double ofUnhidden(const DenseEvidence& evidence, double share)
{
  return evidence.in_free < 1 ? share / (1.0 - evidence.in_free) : 0.0;
}

/// Sets the verdict by the probabilities.
void decide(RelocationResult& result)
{
  VerdictGrounds grounds;
  grounds.confirmed = true;  // what one scan tells of being in the map is in its probabilities
  grounds.poses = result.candidates.size();
  grounds.unfinished = !result.complete;
  if (result.candidates.empty())
  {
    result.elsewhere = 1;
  }
  else
  {
    grounds.first = result.candidates.front().probability;
    grounds.first_pose = result.candidates.front().pose;
  }
  grounds.elsewhere = result.elsewhere;
  const VerdictDecision decision = decideVerdict(grounds);
  result.verdict = decision.verdict;
  result.probability = decision.probability;
}
}  // namespace

double logLikelihoodOfScore(double score)
{
  const double misfit = std::max(1.0 - score, 0.0) + kMisfitFloor;
  return kScoreSlope * score - kMisfitPower * std::log(misfit);
}

double reliabilityOf(const DenseEvidence& evidence)
{
  const double explained = evidence.fine - DenseEvidence::kPenalty * evidence.through_wall;
  return std::clamp(ofUnhidden(evidence, explained), 0.0, 1.0);
}

double scoreOfUnhidden(const DenseEvidence& evidence)
{
  const double explained =
      (evidence.fine + evidence.coarse) / 2 - DenseEvidence::kPenalty * evidence.through_wall;
  return std::min(1.0, ofUnhidden(evidence, explained));
}

double unexplainedShare(const DenseEvidence& evidence)
{
  const double known = 1.0 - evidence.unknown;
  return known > 0 ? std::max(0.0, 1.0 - (evidence.coarse + evidence.in_free) / known) : 0.0;
}

double trackedLogOdds(const DenseEvidence& evidence)
{
  constexpr double kNeutralMisfit = 0.25;  // misfit with its floor, also usual in a foreign map
  const double misfit = unexplainedShare(evidence) + kMisfitFloor;
  return (1.0 - evidence.unknown) * std::log(kNeutralMisfit / misfit);
}

double fitLogOdds(const Candidate& candidate)
{
  // A return in free space may be an occlusion. It lowers the rank of the pose, but is no evidence
  // against being in the map.
  const double explained = candidate.explained + candidate.in_free;
  return kExplainedSlope * explained - kThroughSlope * candidate.through_wall +
         kWallSlope * candidate.constraints.walls -
         kMissingWallSlope * candidate.constraints.missing_walls +
         kWallEndSlope * candidate.constraints.wall_ends - kFitOffset;
}

double leadLogOdds(double score, double rival_score)
{
  return kLeadSlope * (logLikelihoodOfScore(score) - logLikelihoodOfScore(rival_score));
}

double inMapLogOdds(const RelocationResult& result, std::size_t k)
{
  const Candidate& candidate = result.candidates[k];
  return fitLogOdds(candidate) + leadLogOdds(candidate.score, rivalScore(result, k));
}

void weighCandidates(RelocationResult& result, const std::vector<Candidate>& outside,
                     const Missed& missed)
{
  std::vector<Candidate>& candidates = result.candidates;
  if (candidates.empty()) return decide(result);
  const double best = logLikelihoodOfScore(candidates.front().score);
  const auto weight_of = [&](const Candidate& candidate)
  { return std::exp(logLikelihoodOfScore(candidate.score) - best); };
  double sum = 0;
  for (Candidate& candidate : candidates) sum += candidate.probability = weight_of(candidate);
  double sum_outside = 0;
  for (const Candidate& candidate : outside) sum_outside += kPriorOutside * weight_of(candidate);
  double sum_missed = missed.unproposed * std::exp(logLikelihoodOfScore(kUsualScore) - best);
  if (missed.unrefined)
  {
    const double rival = std::exp(logLikelihoodOfScore(rivalScore(result, 0)) - best);
    sum_missed += kUnrefinedShare * rival * sum;
  }

  const double narrow = kNarrowSlope * std::max(0.0, 1.0 - result.view / kFullCoverage);
  const double here = 1.0 / (1.0 + std::exp(narrow - inMapLogOdds(result, 0) - kPriorHereLogOdds));
  const double all = sum + sum_outside + sum_missed;
  for (Candidate& candidate : candidates) candidate.probability *= here / all;
  result.elsewhere = 1.0 - here * sum / all;

  decide(result);
}

void weighByLogOdds(RelocationResult& result, std::optional<double> place_background, double missed)
{
  const double elsewhere = std::max(kLeastElsewhere, missed);
  const double tempering = place_background ? kPlaceTempering : kWallTempering;
  std::vector<Candidate>& candidates = result.candidates;
  double largest = 0;  // the clutter hypothesis itself has log-odds 0
  for (const Candidate& candidate : candidates) largest = std::max(largest, candidate.score);
  double sum = 0;
  for (Candidate& candidate : candidates)
  {
    candidate.probability = std::exp(tempering * (candidate.score - largest));
    sum += candidate.probability;
  }
  const double background =
      candidates.empty() ? 0 : place_background.value_or(0) * candidates.front().probability;
  const double all = std::exp(-tempering * largest) + background + sum;
  for (Candidate& candidate : candidates)
  {
    candidate.probability *= (1.0 - elsewhere) / all;
  }
  result.elsewhere = 1.0 - (1.0 - elsewhere) * sum / all;
  decide(result);
}
}  // namespace sigloc
