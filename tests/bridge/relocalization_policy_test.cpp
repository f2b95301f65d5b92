// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/RelocalizationPolicy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// A robot that drives 0.5 m along x in each second, a step each half.
class Drive
{
 public:
  explicit Drive(const RelocalizationPolicyOptions& options = {}) : policy_(options) {}

  static constexpr double kStep = 0.5;  // [s]

  /// A step after which the tracker is sure of the true pose.
  PolicyDecision localized() { return localizedAt({x() + 0.25, 0, 0}); }

  PolicyDecision localizedAt(const TPose2D& pose)
  {
    PolicyStep step = next();
    step.belief.verdict = Verdict::localized;
    step.belief.hypotheses.resize(1);
    step.belief.hypotheses.front().pose.mean = pose;
    step.belief.hypotheses.front().weight = step.belief.probability = 0.998;
    return policy_.update(step);
  }

  PolicyDecision lost(Verdict verdict = Verdict::ambiguous)
  {
    PolicyStep step = next();
    step.belief.verdict = verdict;
    step.belief.reason = "two rooms look alike";
    // Even a first hypothesis of great weight is not sure.
    step.belief.hypotheses.resize(1);
    step.belief.hypotheses.front().pose.mean = {x(), 0, 0};
    step.belief.hypotheses.front().weight = 0.98;
    return policy_.update(step);
  }

  /// Drives until the pose is known and returns that decision, or the last of many others.
  PolicyDecision untilKnown()
  {
    PolicyDecision decision;
    for (int k = 0; k < 20 && decision.state != PoseState::known; ++k) decision = localized();
    return decision;
  }

  double x() const { return x_; }
  RelocalizationPolicy& policy() { return policy_; }

  std::optional<TPose2D> filter_pose;
  std::function<RelocationResult()> alone;

 private:
  PolicyStep next()
  {
    PolicyStep step;
    step.time = 100 + kStep * ++steps_;
    step.motion = TPose2D(0.25, 0, 0);
    x_ += 0.25;
    step.filter_pose = filter_pose;
    step.localize_alone = alone;
    return step;
  }

  RelocalizationPolicy policy_;
  int steps_ = 0;
  double x_ = 0;
};

RelocationResult explainedAt(const TPose2D& pose)
{
  RelocationResult result;
  result.verdict = Verdict::ambiguous;
  result.candidates.resize(2);
  result.candidates[0].pose.mean = {30, 30, 0};
  result.candidates[1].pose.mean = pose;
  return result;
}

TEST(RelocalizationPolicy, givesAPoseOutOnceItIsConfirmed)
{
  Drive drive;  // three steps that span a second
  for (int k = 0; k < 2; ++k)
  {
    const PolicyDecision decision = drive.localized();
    EXPECT_EQ(decision.state, PoseState::confirming);
    EXPECT_FALSE(decision.pose || decision.announce || decision.restart || decision.alarm);
  }
  const PolicyDecision decision = drive.localized();
  EXPECT_EQ(decision.state, PoseState::known);
  ASSERT_TRUE(decision.pose.has_value());
  EXPECT_DOUBLE_EQ(decision.pose->mean.x, 0.75);
  EXPECT_TRUE(decision.announce);
  EXPECT_FALSE(drive.localized().announce) << "announced twice";
}

TEST(RelocalizationPolicy, neverGivesOutAPoseThatIsNotLocalized)
{
  Drive drive;
  for (int k = 0; k < 10; ++k)
  {
    EXPECT_FALSE(drive.lost(Verdict::ambiguous).pose);
    EXPECT_FALSE(drive.lost(Verdict::not_here).pose);
    EXPECT_FALSE(drive.lost(Verdict::too_little_seen).pose);
  }
  drive.untilKnown();
  const PolicyDecision decision = drive.lost();
  EXPECT_EQ(decision.state, PoseState::holding);
  EXPECT_FALSE(decision.pose);
  EXPECT_NE(decision.message.find("two rooms look alike"), std::string::npos);
}

TEST(RelocalizationPolicy, startsConfirmingAnewAfterAStepThatIsNotLocalized)
{
  Drive drive;
  drive.localized();
  drive.localized();
  drive.lost();
  EXPECT_EQ(drive.localized().state, PoseState::confirming);
  EXPECT_EQ(drive.localized().state, PoseState::confirming);
  EXPECT_EQ(drive.localized().state, PoseState::known);
}

TEST(RelocalizationPolicy, startsConfirmingAnewWhereThePoseDoesNotFollowOdometry)
{
  Drive drive;
  for (int k = 0; k < 10; ++k)
  {
    // Sure of it at every step, and elsewhere at every other one.
    EXPECT_EQ(drive.localizedAt({drive.x(), k % 2 * 5.0, 0}).state, PoseState::confirming);
  }
  EXPECT_EQ(drive.untilKnown().state, PoseState::known);
}

TEST(RelocalizationPolicy, aShortLossIsBridgedWithoutAnnouncingAgain)
{
  Drive drive;
  drive.untilKnown();
  for (int k = 0; k < 3; ++k) EXPECT_EQ(drive.lost().state, PoseState::holding);  // below 2 s
  const PolicyDecision decision = drive.localized();
  EXPECT_EQ(decision.state, PoseState::known);
  EXPECT_TRUE(decision.pose);
  EXPECT_FALSE(decision.announce);
}

TEST(RelocalizationPolicy, aLongLossIsSaidAndTheNewPoseConfirmedAndAnnounced)
{
  Drive drive;
  drive.untilKnown();
  for (int k = 0; k < 3; ++k) drive.lost();
  const PolicyDecision lost = drive.lost();
  EXPECT_EQ(lost.state, PoseState::searching);
  EXPECT_EQ(lost.message.rfind("lost: ", 0), 0U) << lost.message;
  EXPECT_EQ(drive.localized().state, PoseState::confirming);
  EXPECT_TRUE(drive.untilKnown().announce);
}

TEST(RelocalizationPolicy, aPoseThatJumpsIsConfirmedAgain)
{
  Drive drive;
  drive.untilKnown();
  PolicyDecision decision = drive.localizedAt({40, 7, 1});
  EXPECT_EQ(decision.state, PoseState::confirming);
  EXPECT_FALSE(decision.pose);
  // It drives on along its heading there.
  for (int k = 1; k <= 2; ++k)
  {
    decision = drive.localizedAt({40 + 0.25 * k * std::cos(1), 7 + 0.25 * k * std::sin(1), 1});
  }
  EXPECT_EQ(decision.state, PoseState::known);
  EXPECT_TRUE(decision.announce);
}

TEST(RelocalizationPolicy, thePoseIsCrossCheckedByTheScanAlone)
{
  Drive drive;
  int asked = 0;
  drive.alone = [&]
  {
    ++asked;
    return explainedAt({-20, 0, 0});
  };
  PolicyDecision decision;
  for (int k = 0; k < 9; ++k) decision = drive.localized();
  EXPECT_EQ(decision.state, PoseState::confirming);
  EXPECT_GE(asked, 2);
  EXPECT_LE(asked, 4) << "asked where it was not needed";
  drive.alone = [&] { return explainedAt({drive.x() + 0.25, 0.2, 0.1}); };
  EXPECT_EQ(drive.untilKnown().state, PoseState::known);
  drive.alone = []() -> RelocationResult { throw std::logic_error("the pose is known"); };
  EXPECT_NO_THROW(drive.localized());
}

TEST(RelocalizationPolicy, searchesAgainFromNothingAndThenGivesUpLoudly)
{
  RelocalizationPolicyOptions options;
  options.attempt_time = 5;
  options.max_attempts = 3;
  Drive drive(options);
  int restarts = 0;
  PolicyDecision decision;
  for (int k = 0; k < 60; ++k)
  {
    decision = drive.lost();
    if (decision.restart) ++restarts;
    EXPECT_FALSE(decision.restart && decision.alarm);
    EXPECT_FALSE(decision.alarm && k < 30) << k;
  }
  EXPECT_EQ(restarts, 2);
  EXPECT_TRUE(decision.alarm);
  EXPECT_NE(decision.message.find("given up after searching 3 times"), std::string::npos);
  const PolicyDecision found = drive.untilKnown();
  EXPECT_TRUE(found.pose);
  EXPECT_FALSE(found.alarm);
}

TEST(RelocalizationPolicy, searchesFromNothingOnRequest)
{
  RelocalizationPolicyOptions options;
  options.attempt_time = 5;
  options.max_attempts = 1;
  Drive drive(options);
  PolicyDecision decision;
  for (int k = 0; k < 12; ++k) decision = drive.lost();
  EXPECT_TRUE(decision.alarm);
  drive.policy().requestRestart();
  decision = drive.lost();
  EXPECT_TRUE(decision.restart);
  EXPECT_FALSE(decision.alarm);
  EXPECT_FALSE(drive.lost().restart) << "restarted twice";

  drive.untilKnown();
  drive.policy().requestRestart();
  decision = drive.localized();
  EXPECT_TRUE(decision.restart);
  EXPECT_FALSE(decision.pose);
  EXPECT_TRUE(drive.untilKnown().announce);
}

TEST(RelocalizationPolicy, announcesNothingToAFilterThatHasThePose)
{
  Drive drive;
  for (int k = 0; k < 10; ++k)
  {
    drive.filter_pose = TPose2D(drive.x() + 0.4, 0.1, 0.05);
    EXPECT_FALSE(drive.localized().announce);
  }
}

TEST(RelocalizationPolicy, setsAFilterAgainThatStaysAway)
{
  Drive drive;
  drive.filter_pose = TPose2D(-9, 0, 0);
  EXPECT_TRUE(drive.untilKnown().announce);
  int steps = 1;
  while (!drive.localized().announce) ++steps;
  // After the time to settle, and to disagree.
  EXPECT_EQ(steps * Drive::kStep, 3.0 + 2.0);
}

TEST(RelocalizationPolicy, givesUpAFilterThatTakesNoPose)
{
  RelocalizationPolicyOptions options;
  options.max_attempts = 2;
  Drive drive(options);
  drive.filter_pose = TPose2D(-9, 0, 0);
  int announced = 0;
  PolicyDecision decision;
  for (int k = 0; k < 60; ++k)
  {
    decision = drive.localized();
    if (decision.announce) ++announced;
  }
  EXPECT_EQ(announced, 2);
  EXPECT_TRUE(decision.alarm);
  EXPECT_TRUE(decision.pose) << "our own pose is as good as before";
  drive.filter_pose = TPose2D(drive.x() + 0.25, 0, 0);
  EXPECT_FALSE(drive.localized().alarm);
}

TEST(RelocalizationPolicy, refusesWhatItCannotUse)
{
  RelocalizationPolicyOptions options;
  options.confirm_steps = 0;
  EXPECT_THROW(RelocalizationPolicy{options}, std::invalid_argument);
  RelocalizationPolicy policy;
  PolicyStep step;
  step.time = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(policy.update(step), std::invalid_argument);
  step.time = 10;
  EXPECT_EQ(policy.update(step).state, PoseState::searching);
  step.time = 9;
  EXPECT_THROW(policy.update(step), std::invalid_argument);
  // Localized without a pose is not localized.
  step.time = 10;
  step.belief.verdict = Verdict::localized;
  EXPECT_EQ(policy.update(step).state, PoseState::searching);
}
}  // namespace
}  // namespace sigloc
