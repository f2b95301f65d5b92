// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/belief_verdict.h"

#include <gtest/gtest.h>

namespace sigloc
{
namespace
{
constexpr double kSureProbability = 0.99;

VerdictGrounds grounds(bool confirmed, bool doubtful = false, bool sees_too_little = false,
                       bool unfinished = false)
{
  VerdictGrounds made;
  made.confirmed = confirmed;
  made.doubtful = doubtful;
  made.sees_too_little = sees_too_little;
  made.unfinished = unfinished;
  return made;
}

Belief beliefOf(const std::vector<double>& weights, double elsewhere, double sigma = 0.05)
{
  Belief belief;
  belief.elsewhere = elsewhere;
  for (const double weight : weights)
  {
    TrackedHypothesis hypothesis;
    hypothesis.weight = weight;
    hypothesis.pose.mean.x = 10.0 * static_cast<double>(belief.hypotheses.size());
    hypothesis.pose.covariance(0, 0) = sigma * sigma;
    belief.hypotheses.push_back(hypothesis);
  }
  return belief;
}

TEST(ProbabilityText, LessThanAClaimDoesNotLookLikeOne)
{
  EXPECT_EQ(probabilityText(0.98999), "0.989");
  EXPECT_EQ(probabilityText(0.9896), "0.989");
  EXPECT_EQ(probabilityText(0.99), "0.990");
  EXPECT_EQ(probabilityText(0.57, 2), "0.57") << "stored as a little less";
  EXPECT_EQ(probabilityText(0.99996, 4), "0.9999");
  EXPECT_EQ(probabilityText(1), "1.000");
  EXPECT_EQ(probabilityText(0), "0.000");
}

struct Case
{
  const char* what;
  Belief belief;
  VerdictGrounds grounds;
  Verdict verdict;
  double probability;
  const char* reason;  // part of it
};

TEST(DecideVerdict, ClaimsOnlyWhatNothingSpeaksAgainst)
{
  const std::vector<Case> cases = {
      {"all is well", beliefOf({0.995}, 0.005), grounds(true), Verdict::localized, 0.995, "one"},
      {"a light rival", beliefOf({0.99, 0.005}, 0.005), grounds(true), Verdict::localized, 0.99,
       "one hypothesis holds"},
      {"not sure", beliefOf({0.98, 0.015}, 0.005), grounds(true), Verdict::ambiguous, 0.02,
       "2 hypotheses remain"},
      {"alone, not sure", beliefOf({0.9}, 0.1), grounds(true), Verdict::ambiguous, 0.1,
       "one hypothesis remains"},
      {"not confirmed", beliefOf({0.998}, 0.002), grounds(false), Verdict::ambiguous, 0.002,
       "too little of what has been seen is explained by this map alone"},
      {"not confirmed, a rival", beliefOf({0.99, 0.005}, 0.005), grounds(false), Verdict::ambiguous,
       0.01, "2 hypotheses remain"},
      {"doubtful", beliefOf({0.995}, 0.005), grounds(true, true), Verdict::ambiguous, 0.005,
       "less than it used to"},
      {"open", beliefOf({0.995}, 0.005, 0.5), grounds(true), Verdict::ambiguous, 0.005,
       "open along a line"},
      {"elsewhere", beliefOf({0.02}, 0.98), grounds(true), Verdict::not_here, 0.98,
       "no hypothesis explains the scan"},
      {"nowhere", beliefOf({}, 1.0), grounds(false), Verdict::not_here, 1.0, "nothing in the map"},
      {"blind", beliefOf({}, 1.0), grounds(false, false, true), Verdict::too_little_seen, 1.0,
       "fewer returns than needed"},
      {"not searched to its end", beliefOf({}, 1.0), grounds(false, false, false, true),
       Verdict::too_little_seen, 1.0, "ended at its budget"},
      {"not searched to its end, a poor pose", beliefOf({0.02}, 0.98),
       grounds(false, false, false, true), Verdict::ambiguous, 0.98,
       "too little of what has been seen"},
      {"blind, held", beliefOf({0.995}, 0.005), grounds(true, false, true), Verdict::localized,
       0.995, "one hypothesis holds"},
  };
  for (const Case& c : cases)
  {
    Belief belief = c.belief;
    setVerdict(belief, c.grounds, kSureProbability, nullptr);
    EXPECT_EQ(belief.verdict, c.verdict) << c.what;
    EXPECT_NEAR(belief.probability, c.probability, 1e-9) << c.what;
    EXPECT_NE(belief.reason.find(c.reason), std::string::npos) << c.what << ": " << belief.reason;
  }
}
}  // namespace
}  // namespace sigloc
