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
constexpr double kScoreSlope = 15.0;  // of the log-likelihood per unit of score
constexpr double kMisfitPower = 5.0;  // of the unexplained share
constexpr double kMisfitFloor = 0.02;  // share that even the right pose leaves unexplained
constexpr double kSharpening = 1.0;  // of rivals against each other
// The log-odds of being in the map, fitted on simulated worlds too, section 7.
constexpr double kExplainedSlope = 8.5;  // per share of what is no occlusion
constexpr double kThroughSlope = 20.0;  // per share of beams through walls
constexpr double kConstraintSlope = 0.3;  // per explained fact
constexpr double kLeadSlope = 0.46;  // per unit of log-likelihood ahead of the best rival
constexpr double kFitOffset = 11.2;
// A narrow view fits elsewhere by chance: what was fitted on scans of 180 degrees and more trusts
// it too much.
constexpr double kFullView = M_PI / 2;  // [rad]
constexpr double kNarrowSlope = 12.0;  // of the log-odds per share that is missing
constexpr double kPriorOutside = 0.01;  // of a pose outside the region it is said to be in
constexpr double kChanceScore = 0.4;  // what chance reaches where there is no runner-up
constexpr double kUsualScore = 0.8;  // of the right place
// Features of a scan share its errors, and buildings repeat their walls; places that were gathered
// over a drive share less.
constexpr double kWallTempering = 0.25;
constexpr double kPlaceTempering = 0.5;
constexpr double kPriorElsewhere =
    0.002;  // of standing off the map, and of a generator that failed

/// The score of the best candidate but the k-th, or what chance reaches where there is none.
double rivalScore(const RelocationResult& result, std::size_t k)
{
  const std::size_t rival = k == 0 ? 1 : 0;
  return rival < result.candidates.size() ? result.candidates[rival].score : kChanceScore;
}

/// What is left to judge by when returns in free space are taken for occlusions.
double unhiddenShare(const DenseEvidence& evidence)
{
  constexpr double kLeastSeen = 0.25;
  return std::max(kLeastSeen, 1.0 - evidence.in_free);
}

/// The verdict that the weights allow.
void decide(RelocationResult& result)
{
  VerdictGrounds grounds;
  grounds.poses = result.candidates.size();
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
  return std::clamp((evidence.fine - 0.5 * evidence.through_wall) / unhiddenShare(evidence), 0.0,
                    1.0);
}

double scoreOfUnhidden(const DenseEvidence& evidence)
{
  const double explained = 0.5 * (evidence.fine + evidence.coarse);
  return std::min(1.0, (explained - 0.5 * evidence.through_wall) / unhiddenShare(evidence));
}

double unexplainedShare(const DenseEvidence& evidence)
{
  const double known = 1.0 - evidence.unknown;
  return known > 0 ? std::max(0.0, 1.0 - (evidence.coarse + evidence.in_free) / known) : 0.0;
}

double trackedLogOdds(const DenseEvidence& evidence)
{
  constexpr double kMisfitOfChance = 0.25;  // where the map explains no more than a foreign one
  constexpr double kFloor = 0.03;
  constexpr double kSlope = 1.17;
  constexpr double kThrough = 5.0;
  const double misfit = unexplainedShare(evidence);
  return (1.0 - evidence.unknown) * (kSlope * std::log(kMisfitOfChance / (misfit + kFloor)) -
                                     kThrough * evidence.through_wall);
}

double fitLogOdds(const Candidate& candidate)
{
  // A return in free space may be an occlusion: it speaks against the pose's rank, not against
  // being in the map. The score already holds half of both shares.
  const double explained = candidate.score + 0.5 * candidate.through_wall + 1.5 * candidate.in_free;
  return kExplainedSlope * explained - kThroughSlope * candidate.through_wall +
         kConstraintSlope * candidate.explained_constraints - kFitOffset;
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

void weighCandidates(RelocationResult& result, const std::vector<Candidate>& outside, double missed)
{
  std::vector<Candidate>& candidates = result.candidates;
  if (candidates.empty()) return decide(result);
  const double best = logLikelihoodOfScore(candidates.front().score);
  const auto weight_of = [&](const Candidate& candidate)
  { return std::exp(kSharpening * (logLikelihoodOfScore(candidate.score) - best)); };
  double sum = 0;
  for (Candidate& candidate : candidates) sum += candidate.probability = weight_of(candidate);
  double sum_outside = 0;
  for (const Candidate& candidate : outside) sum_outside += kPriorOutside * weight_of(candidate);
  const double sum_missed = missed * std::exp(logLikelihoodOfScore(kUsualScore) - best);

  const double narrow = kNarrowSlope * std::max(0.0, 1.0 - result.view / kFullView);
  const double here = 1.0 / (1.0 + std::exp(narrow - inMapLogOdds(result, 0) - kPriorHereLogOdds));
  const double all = sum + sum_outside + sum_missed;
  for (Candidate& candidate : candidates) candidate.probability *= here / all;
  result.elsewhere = 1.0 - here * sum / all;

  decide(result);
}

void weighByLogOdds(RelocationResult& result, std::optional<double> chance_of_places)
{
  const double tempering = chance_of_places ? kPlaceTempering : kWallTempering;
  std::vector<Candidate>& candidates = result.candidates;
  double largest = 0;  // the clutter hypothesis itself has log-odds 0
  for (const Candidate& candidate : candidates) largest = std::max(largest, candidate.score);
  double sum = 0;
  for (Candidate& candidate : candidates)
  {
    candidate.probability = std::exp(tempering * (candidate.score - largest));
    sum += candidate.probability;
  }
  const double accidental =
      candidates.empty() ? 0 : chance_of_places.value_or(0) * candidates.front().probability;
  const double all = std::exp(-tempering * largest) + accidental + sum;
  for (Candidate& candidate : candidates)
  {
    candidate.probability *= (1.0 - kPriorElsewhere) / all;
  }
  result.elsewhere = 1.0 - (1.0 - kPriorElsewhere) * sum / all;
  decide(result);
}
}  // namespace sigloc
