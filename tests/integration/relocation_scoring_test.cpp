// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/relocation_summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

EvaluationQuery queryAt(const TPose2D& truth, std::size_t valid_beams = 50)
{
  EvaluationQuery query;
  query.name = "0";
  query.truth = truth;
  LaserScan scan;
  scan.ranges.assign(60, 1.0F);
  scan.valid.assign(60, 0);
  std::fill_n(scan.valid.begin(), valid_beams, std::uint8_t{1});
  query.scans = {scan};
  return query;
}

RelocationResult answerOf(const std::vector<TPose2D>& poses, Verdict verdict)
{
  RelocationResult answer;
  for (const TPose2D& pose : poses)
  {
    Candidate candidate;
    candidate.pose.mean = pose;
    answer.candidates.push_back(candidate);
  }
  answer.verdict = verdict;
  return answer;
}

constexpr double kDegree = M_PI / 180;

TEST(RelocationScoring, JudgesTheFirstCandidateAcrossTheHeadingsSeam)
{
  const auto query = queryAt({1, 2, M_PI - 0.01});
  const auto answer = answerOf({{1.3, 2.4, -M_PI + 0.04}}, Verdict::localized);
  const auto record = judgeRelocation(query, answer, true, std::nullopt, {});
  EXPECT_NEAR(record.error.distance, 0.5, 1e-9);
  EXPECT_NEAR(record.error.angle, 0.05, 1e-8);
  EXPECT_EQ(record.rank_of_right, 1U);
  EXPECT_EQ(record.claim, Claim::right);
}

TEST(RelocationScoring, TellsRightInaccurateAndWrongApart)
{
  const auto claim = [](const TPose2D& pose, const AccuracyGates& gates)
  {
    return judgeRelocation(queryAt({0, 0, 0}), answerOf({pose}, Verdict::localized), true,
                           std::nullopt, gates)
        .claim;
  };
  EXPECT_EQ(claim({0.49, 0, 9 * kDegree}, {}), Claim::right);
  EXPECT_EQ(claim({0.51, 0, 0}, {}), Claim::inaccurate);
  EXPECT_EQ(claim({0, 0, 11 * kDegree}, {}), Claim::inaccurate);
  EXPECT_EQ(claim({1.01, 0, 0}, {}), Claim::wrong);
  EXPECT_EQ(claim({0, 0, 21 * kDegree}, {}), Claim::wrong);
  EXPECT_EQ(claim({0.51, 0, 0}, simulationGates()), Claim::wrong);
}

TEST(RelocationScoring, OnlyAVerdictIsAClaim)
{
  const auto query = queryAt({0, 0, 0});
  const auto sure = answerOf({{9, 9, 0}}, Verdict::localized);
  const auto unsure = answerOf({{9, 9, 0}}, Verdict::ambiguous);
  EXPECT_EQ(judgeRelocation(query, sure, true, std::nullopt, {}).claim, Claim::wrong);
  EXPECT_FALSE(judgeRelocation(query, sure, false, std::nullopt, {}).claim.has_value());
  EXPECT_EQ(judgeRelocation(query, unsure, true, std::nullopt, {}).claim, Claim::none);
}

TEST(RelocationScoring, AForeignMapMakesEveryClaimWrong)
{
  auto query = queryAt({0, 0, 0});
  query.truth.reset();
  const auto record = judgeRelocation(query, answerOf({{0, 0, 0}}, Verdict::localized), true,
                                      std::vector<TPose2D>{{0, 0, 0}}, {});
  EXPECT_EQ(record.claim, Claim::wrong);
  EXPECT_FALSE(record.proposed.has_value());
  RelocationSummary summary;
  summary.add(record);
  EXPECT_EQ(total(&Outcome::confidently_wrong)(summary), 1U);
  EXPECT_EQ(share(&Outcome::right)(summary).cases, 0U);
}

TEST(RelocationScoring, FindsTheRankOfTheRightPoseAmongTen)
{
  std::vector<TPose2D> poses;
  for (int i = 0; i < 12; ++i) poses.emplace_back(10.0 + 5 * i, 0, 0);
  poses[9] = {0.1, 0, 0};
  const auto query = queryAt({0, 0, 0});
  EXPECT_EQ(
      judgeRelocation(query, answerOf(poses, Verdict::ambiguous), true, poses, {}).rank_of_right,
      10U);
  std::swap(poses[9], poses[10]);
  const auto record = judgeRelocation(query, answerOf(poses, Verdict::ambiguous), true, poses, {});
  EXPECT_EQ(record.rank_of_right, 0U) << "the eleventh does not count";
  EXPECT_TRUE(record.proposed.value());
}

TEST(RelocationScoring, CountsQueriesThatSawNothingApart)
{
  const auto answer = answerOf({{0.2, 0, 0}}, Verdict::ambiguous);
  const std::vector<RelocationRecord> records = {
      judgeRelocation(queryAt({0, 0, 0}), answer, true, std::nullopt, {}),
      judgeRelocation(queryAt({5, 0, 0}), answer, true, std::nullopt, {}),
      judgeRelocation(queryAt({0, 0, 0}, 9), answer, true, std::nullopt, {})};
  RelocationSummary summary;
  for (const RelocationRecord& record : records) summary.add(record);
  const auto json = toJson(summaryColumns(), summary);
  EXPECT_EQ(json.at("queries"), 3);
  EXPECT_EQ(json.at("saw_nothing"), 1);
  EXPECT_EQ(json.at("recall_at_1_counts"), nlohmann::ordered_json({1, 2}));
  EXPECT_NEAR(json.at("median_error_m").get<double>(), 0.2, 1e-12) << "of right answers only";
}

TEST(RelocationScoring, WilsonIntervals)
{
  // Values of the published formula, from a calculator.
  const Proportion some{8, 10};
  EXPECT_NEAR(some.low(), 0.4902, 1e-4);
  EXPECT_NEAR(some.high(), 0.9433, 1e-4);
  const Proportion none{0, 20};
  EXPECT_EQ(none.low(), 0.0);
  EXPECT_NEAR(none.high(), 0.1611, 1e-4);
  const Proportion all{20, 20};
  EXPECT_EQ(all.high(), 1.0);
  EXPECT_NEAR(all.low(), 0.8389, 1e-4);
  EXPECT_TRUE(std::isnan(Proportion{}.low()));
}

TEST(RelocationScoring, QuantilesAreNearestRank)
{
  const auto q = quantilesOf({5, 1, 4, 2, 3, 6, 7, 8, 9, 10});
  EXPECT_EQ(q.median, 5);
  EXPECT_EQ(q.p95, 10);
  EXPECT_EQ(q.mean, 5.5);
  EXPECT_TRUE(std::isnan(quantilesOf({}).median));
}
}  // namespace
}  // namespace sigloc
