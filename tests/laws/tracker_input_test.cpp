// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "sigloc/tracking/HypothesisTracker.h"
#include "support/followed_drive.h"
#include "support/simulated_office.h"

namespace sigloc
{
namespace
{
using test::driveThrough;
using test::expectWellFormed;
using test::follow;
using test::isRight;
using test::office;

TEST(Tracker, TellsTheMapsCommonErrorOnce)
{
  MapErrorModel error;
  error.common_sigma = 0.3;
  error.common_turn_sigma = 0.05;
  const FeatureMap& map = *office().map();
  const auto matcher = std::make_shared<const SignatureMatcher>(
      std::make_shared<const FeatureMap>(map.features(), map.field(), error));
  Random random(95);
  const ObservedScene scene = office().sceneAt(office().randomPose(random), random);
  HypothesisTracker tracker(matcher);
  const GaussianPose tracked = tracker.step(std::nullopt, scene).hypotheses.at(0).pose;
  const GaussianPose found = matcher->localize(scene).candidates.at(0).pose;
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_NEAR(tracked.covariance(k, k), found.covariance(k, k), 1e-6);
  }
  EXPECT_GT(tracked.covariance(0, 0), 0.09);
}

TEST(Tracker, RefusesWhatIsNotFiniteAndForgetsNothing)
{
  HypothesisTracker tracker(office().matcher());
  HypothesisTracker undisturbed(office().matcher());
  const auto drive = driveThrough(office().world(), 6, 96);
  follow(tracker, drive);
  follow(undisturbed, drive);
  const std::string before = tracker.belief().reason;
  const ObservedScene scene = observeScene({*drive.back().scan});
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MotionIncrement motion;
  motion.mean.x = kNan;
  EXPECT_THROW(tracker.step(motion, scene), std::invalid_argument);
  motion = {};
  motion.covariance(1, 1) = -1;
  EXPECT_THROW(tracker.step(motion, scene), std::invalid_argument);
  // Neither negative nor infinite, but no covariance: the variances are too small for xy, and yx
  // differs from it.
  motion.covariance(0, 0) = motion.covariance(1, 1) = 1e-6;
  motion.covariance(0, 1) = motion.covariance(1, 0) = 1;
  EXPECT_THROW(tracker.step(motion, scene), std::invalid_argument);
  motion.covariance(0, 0) = motion.covariance(1, 1) = 2;
  motion.covariance(1, 0) = -1;
  EXPECT_THROW(tracker.step(motion, scene), std::invalid_argument);
  ObservedScene broken = scene;
  broken.beams.back().point.y = kNan;
  EXPECT_THROW(tracker.step(MotionIncrement{}, broken), std::invalid_argument);
  EXPECT_EQ(tracker.belief().reason, before);
  const Belief& after = tracker.step(MotionIncrement{}, scene);
  expectWellFormed(after);
  const Belief& expected = undisturbed.step(MotionIncrement{}, scene);
  ASSERT_EQ(after.hypotheses.size(), expected.hypotheses.size());
  for (std::size_t k = 0; k < expected.hypotheses.size(); ++k)
  {
    EXPECT_EQ(after.hypotheses[k].weight, expected.hypotheses[k].weight);
    EXPECT_EQ(after.hypotheses[k].pose.mean, expected.hypotheses[k].pose.mean);
  }
  EXPECT_TRUE(isRight(after.hypotheses.front().pose.mean, drive.back().world_from_robot));
}

TEST(Tracker, BlindStepsKeepTheBeliefWellFormed)
{
  const auto drive = driveThrough(office().world(), 15, 91);
  HypothesisTracker tracker(office().matcher());
  EXPECT_EQ(tracker.step(std::nullopt, {}).verdict, Verdict::too_little_seen);
  std::size_t k = 0;
  for (const DriveStep& step : drive)
  {
    const bool blind = k > drive.size() / 2 && k % 3 == 0;
    expectWellFormed(
        tracker.step(step.motion, blind ? ObservedScene{} : observeScene({*step.scan})));
    ++k;
  }
  EXPECT_TRUE(
      isRight(tracker.belief().hypotheses.front().pose.mean, drive.back().world_from_robot));
  tracker.reset();
  EXPECT_TRUE(tracker.belief().hypotheses.empty());
  EXPECT_EQ(tracker.belief().elsewhere, 1);
}
}  // namespace
}  // namespace sigloc
