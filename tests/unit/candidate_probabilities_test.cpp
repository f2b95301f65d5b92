// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/candidate_probabilities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace sigloc
{
namespace
{
RelocationResult resultOf(const std::vector<double>& scores)
{
  RelocationResult result;
  for (const double score : scores)
  {
    Candidate candidate;
    candidate.score = score;
    candidate.explained = std::max(0.0, score);
    for (int d = 0; d < 3; ++d) candidate.pose.covariance(d, d) = 0.01;
    result.candidates.push_back(candidate);
  }
  weighCandidates(result);
  return result;
}

double sumOf(const RelocationResult& result)
{
  double sum = result.elsewhere;
  for (const Candidate& candidate : result.candidates) sum += candidate.probability;
  return sum;
}

TEST(Weighing, ANarrowViewConvincesLess)
{
  const auto probability = [](double view)
  {
    RelocationResult result = resultOf({0.9, 0.5});
    result.view = view;
    weighCandidates(result);
    return result.candidates.front().probability;
  };
  EXPECT_EQ(probability(M_PI), probability(2 * M_PI));
  EXPECT_LT(probability(M_PI / 3), probability(M_PI));
  EXPECT_LT(probability(M_PI / 6), 0.1 * probability(M_PI));
}

TEST(Weighing, ProbabilitiesAndElsewhereSumToOne)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 500; ++k)
  {
    std::vector<double> scores(1 + static_cast<std::size_t>(k % 10));
    for (double& score : scores) score = uniform(random);
    std::sort(scores.rbegin(), scores.rend());
    const RelocationResult result = resultOf(scores);
    EXPECT_NEAR(sumOf(result), 1.0, 1e-12);
    for (std::size_t i = 0; i < scores.size(); ++i)
    {
      EXPECT_GE(result.candidates[i].probability, 0);
      const double before = i > 0 ? result.candidates[i - 1].probability : 1.0;
      EXPECT_LE(result.candidates[i].probability, before);
    }
    EXPECT_GE(result.probability, 0);
    EXPECT_LE(result.probability, 1);
  }
  EXPECT_NEAR(sumOf(resultOf({1.5, 1.0, -3.0})), 1.0, 1e-12);
}

TEST(Weighing, EqualScoresGetEqualWeights)
{
  for (const std::size_t copies : {2U, 3U, 8U})
  {
    const RelocationResult result = resultOf(std::vector<double>(copies, 0.83));
    for (const Candidate& candidate : result.candidates)
    {
      EXPECT_NEAR(candidate.probability, result.candidates.front().probability, 1e-9);
      EXPECT_NEAR(candidate.probability, (1 - result.elsewhere) / static_cast<double>(copies),
                  1e-9);
    }
    EXPECT_NE(result.verdict, Verdict::localized);
  }
}

TEST(Weighing, GrowsWithScoreAndWithLead)
{
  double last = -1e9;
  for (double score = -1.0; score <= 1.0; score += 0.01)
  {
    EXPECT_GT(logLikelihoodOfScore(score), last) << score;
    last = logLikelihoodOfScore(score);
  }
  double by_score = 0;
  double by_lead = 0;
  for (double step = 0; step < 0.4; step += 0.02)
  {
    const double p = resultOf({0.55 + step, 0.5}).candidates.front().probability;
    EXPECT_GT(p, by_score);
    by_score = p;
    const double q = resultOf({0.9, 0.9 - step}).candidates.front().probability;
    EXPECT_GT(q, by_lead);
    by_lead = q;
  }
}

TEST(Weighing, SpeaksOfNothingWithoutCandidates)
{
  const RelocationResult none = resultOf({});
  EXPECT_EQ(none.verdict, Verdict::not_here);
  EXPECT_EQ(none.elsewhere, 1);
  EXPECT_EQ(resultOf({0.1, 0.1}).verdict, Verdict::not_here);
  EXPECT_EQ(resultOf({0.97, 0.4}).verdict, Verdict::localized);
}

TEST(Weighing, APlaceThatMayHaveBeenMissedRivalsAPoorWinner)
{
  const auto first_of = [](double score, double missed)
  {
    RelocationResult result = resultOf({score, 0.2});
    weighCandidates(result, {}, {missed});
    EXPECT_NEAR(sumOf(result), 1.0, 1e-12);
    return result.candidates.front().probability;
  };
  for (double score = 0.3; score < 1.0; score += 0.05)
  {
    double last = first_of(score, 0);
    for (double missed = 0.01; missed < 0.3; missed *= 2)
    {
      EXPECT_LT(first_of(score, missed), last) << score << " " << missed;
      last = first_of(score, missed);
    }
  }
  EXPECT_LT(first_of(0.7, 0.2), 0.9);  // the right pose would usually score higher
  EXPECT_GT(first_of(0.97, 0.2), 0.99);  // hardly
}

TEST(Weighing, PlacesThatWereNotRefinedAreAsLikelyAsTheRunnerUpSuggests)
{
  Missed cut_short;
  cut_short.unrefined = true;
  const auto share_of = [&](double score, double rival)
  {
    RelocationResult all = resultOf({score, rival});
    RelocationResult cut = all;
    weighCandidates(all);
    weighCandidates(cut, {}, cut_short);
    EXPECT_NEAR(sumOf(cut), 1.0, 1e-12);
    return cut.candidates.front().probability / all.candidates.front().probability;
  };
  for (double score = 0.5; score < 1.0; score += 0.05)
  {
    double last = 1;
    for (double lead = 0.4; lead >= 0; lead -= 0.05)
    {
      EXPECT_LT(share_of(score, score - lead), last) << score << " " << lead;
      last = share_of(score, score - lead);
    }
    EXPECT_NEAR(last, 1 / 1.44, 1e-9);  // a tie
  }
}

TEST(Weighing, ChanceRivalsPlacesThatAreFew)
{
  const auto first_of = [](double log_odds, double rival, std::optional<double> chance)
  {
    RelocationResult result = resultOf({0.5, 0.4});
    result.candidates[0].score = log_odds;
    result.candidates[1].score = rival;
    weighByLogOdds(result, chance);
    EXPECT_NEAR(sumOf(result), 1.0, 1e-12);
    return result.candidates.front().probability;
  };
  EXPECT_GT(first_of(15, 0, 1e-4), 0.99);
  EXPECT_LT(first_of(15, 0, 0.1), 0.95);
  EXPECT_NEAR(first_of(15, 15, 1e-6), 0.5, 0.01);
  EXPECT_LT(first_of(15, 0, std::nullopt), first_of(15, 0, 0.0)) << "walls are tempered more";
  EXPECT_GT(first_of(30, 0, std::nullopt), 0.99);
}

TEST(Weighing, WhatASearchThatWasCutShortFoundIsNeverLocalized)
{
  RelocationResult result = resultOf({0.5});
  result.candidates[0].score = 100;
  weighByLogOdds(result);
  EXPECT_EQ(result.verdict, Verdict::localized);
  weighByLogOdds(result, std::nullopt, 0.2);
  EXPECT_NE(result.verdict, Verdict::localized);
  EXPECT_NEAR(sumOf(result), 1.0, 1e-12);
}

TEST(Weighing, WhatASearchThatWasCutShortDidNotFindIsNotRuledOut)
{
  for (const bool complete : {true, false})
  {
    RelocationResult nothing;
    nothing.complete = complete;
    weighByLogOdds(nothing, std::nullopt, 0.2);
    EXPECT_EQ(nothing.verdict, complete ? Verdict::not_here : Verdict::too_little_seen);
    EXPECT_EQ(nothing.elsewhere, 1.0);
    weighCandidates(nothing);
    EXPECT_EQ(nothing.verdict, complete ? Verdict::not_here : Verdict::too_little_seen);

    RelocationResult poor = resultOf({0.1});
    ASSERT_EQ(poor.verdict, Verdict::not_here);
    poor.complete = complete;
    weighCandidates(poor);
    EXPECT_EQ(poor.verdict, complete ? Verdict::not_here : Verdict::ambiguous);
    EXPECT_NEAR(sumOf(poor), 1.0, 1e-12);
  }
}

TEST(Weighing, AnOpenLineIsNeverLocalized)
{
  RelocationResult result = resultOf({0.97, 0.2});
  ASSERT_EQ(result.verdict, Verdict::localized);
  result.candidates.front().pose.covariance(0, 0) = 4.0;
  weighCandidates(result);
  EXPECT_EQ(result.verdict, Verdict::ambiguous);
}
TEST(FollowedLogOdds, FallsWithWhatTheMapDoesNotExplain)
{
  DenseEvidence right;
  right.coarse = 0.99;
  DenseEvidence foreign;
  foreign.coarse = 0.76;
  EXPECT_GT(trackedLogOdds(right), 1.5);
  EXPECT_LT(trackedLogOdds(foreign), 0);
  double last = trackedLogOdds(right);
  for (int k = 0; k < 9; ++k)
  {
    right.coarse -= 0.1;
    const double now = trackedLogOdds(right);
    EXPECT_LT(now, last);
    last = now;
  }
}

TEST(FollowedLogOdds, WhatEndsInFreeSpaceSaysNothing)
{
  DenseEvidence clear;
  clear.coarse = 0.98;
  DenseEvidence hidden = clear;
  hidden.coarse = 0.58;
  hidden.in_free = 0.4;
  EXPECT_NEAR(trackedLogOdds(hidden), trackedLogOdds(clear), 1e-12);
}

TEST(FollowedLogOdds, UnknownLandSaysNothing)
{
  DenseEvidence known;
  known.coarse = 0.9;
  DenseEvidence half = known;
  half.coarse = 0.45;
  half.unknown = 0.5;
  EXPECT_NEAR(trackedLogOdds(half), 0.5 * trackedLogOdds(known), 1e-12);
  DenseEvidence none;
  none.unknown = 1.0;
  EXPECT_EQ(trackedLogOdds(none), 0.0);
}
}  // namespace
}  // namespace sigloc
