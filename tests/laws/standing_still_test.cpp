// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "eval/worlds/LandmarkSimulator.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "support/followed_drive.h"
#include "support/simulated_office.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;
using test::expectWellFormed;
using test::isRight;
using test::MappedWorld;
using test::office;

enum class Odometry
{
  none,
  exact,
  jittering,
  gaps  // exact, but between two scans is a step without odometry in which nothing is seen
};

/// A belief that is ambiguous after its first scan must stay so while the robot stands still. The
/// same scan again is no new evidence.
template <class MappedPlace>
void standStill(const MappedPlace& world, Odometry odometry, std::uint64_t seed, int tries,
                int at_least, int at_most_tipped = 0)
{
  Random random(seed);
  int ambiguous = 0;
  int tipped = 0;
  for (int k = 0; k < tries; ++k)
  {
    const TPose2D truth = world.randomPose(random);
    HypothesisTracker tracker(world.matcher());
    const auto step = [&]() -> const Belief&
    {
      if (odometry == Odometry::gaps) tracker.step(std::nullopt, {});
      std::optional<MotionIncrement> motion;
      if (odometry != Odometry::none) motion.emplace();
      if (odometry == Odometry::jittering)
        motion->mean = {0.002 * random.normal(), 0.002 * random.normal(), 0.001 * random.normal()};
      return tracker.step(motion, world.sceneAt(truth, random));
    };
    if (step().verdict != Verdict::ambiguous) continue;
    ++ambiguous;
    for (int scan = 0; scan < 60; ++scan)
    {
      const Belief& belief = step();
      expectWellFormed(belief);
      if (belief.verdict != Verdict::localized) continue;
      EXPECT_TRUE(isRight(belief.hypotheses.front().pose.mean, truth))
          << "try " << k << ", scan " << scan;
      ++tipped;
      break;
    }
  }
  EXPECT_GE(ambiguous, at_least);
  EXPECT_LE(tipped, at_most_tipped) << "of " << ambiguous;
}

const MappedWorld& corridor()
{
  static const MappedWorld world = []
  {
    WorldOptions options;
    options.copies = 4;
    return MappedWorld(makeWorld(WorldKind::corridor, options, 9), 9);
  }();
  return world;
}

/// Point landmarks, of which few are in view at a time.
class LandmarkPlace
{
 public:
  explicit LandmarkPlace(std::uint64_t seed)
      : world_(makeWorld(WorldKind::points, {}, seed)), simulator_(world_, sensor())
  {
    Random random(seed);
    matcher_ = std::make_shared<SignatureMatcher>(
        std::make_shared<FeatureMap>(simulator_.mappedLandmarks(random)));
  }
  const std::shared_ptr<const SignatureMatcher>& matcher() const { return matcher_; }
  TPose2D randomPose(Random& random) const
  {
    const Bounds& bounds = world_.bounds;
    return {random.uniform(bounds.x_min, bounds.x_max), random.uniform(bounds.y_min, bounds.y_max),
            random.uniform(-M_PI, M_PI)};
  }
  ObservedScene sceneAt(const TPose2D& pose, Random& random) const
  {
    ObservedScene scene;
    scene.features = simulator_.observe(pose, random).features;
    return scene;
  }

 private:
  static LandmarkSensorOptions sensor()
  {
    LandmarkSensorOptions options;
    options.range = 5;
    return options;
  }
  World world_;
  LandmarkSimulator simulator_;
  std::shared_ptr<const SignatureMatcher> matcher_;
};

TEST(Tracker, StandingStillAmongLandmarksSettlesNothing)
{
  const LandmarkPlace place(10);
  standStill(place, Odometry::exact, 55, 100, 60);
  standStill(place, Odometry::jittering, 56, 100, 60);
}

TEST(Tracker, StandingStillSettlesNothing)
{
  standStill(corridor(), Odometry::exact, 51, 40, 30);
  standStill(office(), Odometry::exact, 52, 160, 8);
}

TEST(Tracker, StandingStillWithJitteringOdometrySettlesNothing)
{
  standStill(corridor(), Odometry::jittering, 51, 40, 30);
  standStill(office(), Odometry::jittering, 52, 160, 8);
}

TEST(Tracker, StandingStillWithGapsSettlesNothing)
{
  // One belief is at 0.9900, and gains 0.0003 as a light track goes.
  standStill(corridor(), Odometry::gaps, 61, 40, 30, 1);
  standStill(office(), Odometry::gaps, 62, 160, 5);
}

TEST(Tracker, StandingStillWithoutOdometrySettlesNothing)
{
  standStill(corridor(), Odometry::none, 53, 40, 30);
  standStill(office(), Odometry::none, 54, 160, 8);
}
}  // namespace
}  // namespace sigloc
