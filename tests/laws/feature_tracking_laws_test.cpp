// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <sstream>

#include "eval/wakeup/wakeup_simulated.h"
#include "eval/worlds/LandmarkSimulator.h"
#include "eval/worlds/world_generators.h"
#include "geometry/chi_square.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "signature/location_constraint.h"
#include "tracking/tracks/SchmidtKalmanFilter.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

MotionIncrement disturbed(const TPose2D& increment, Random& random)
{
  constexpr double kSigma = 0.02;  // [m]
  constexpr double kTurnSigma = 0.005;  // [rad]
  MotionIncrement motion;
  motion.mean = {increment.x + kSigma * random.normal(), increment.y + kSigma * random.normal(),
                 increment.phi + kTurnSigma * random.normal()};
  motion.covariance(0, 0) = motion.covariance(1, 1) = kSigma * kSigma;
  motion.covariance(2, 2) = kTurnSigma * kTurnSigma;
  return motion;
}

/// The squared normalised error, 3 degrees of freedom, at the end of a drive through a random point
/// field with known pairings. One filter models the map's errors as constant, the other takes them
/// for fresh noise at every scan.
double errorAtTheEnd(std::uint64_t seed, bool errors_stay)
{
  constexpr int kSteps = 40;
  WorldOptions sizes;
  sizes.points = 160;
  const World world = makeWorld(WorldKind::points, sizes, seed);
  LandmarkSensorOptions sensor;
  sensor.spurious_share = 0;
  sensor.map_sigma = 0.04;
  const LandmarkSimulator simulator(world, sensor);
  Random random(seed, 77);
  const std::vector<Feature> mapped = simulator.mappedLandmarks(random);

  TPose2D truth(20, 12, random.uniform(-M_PI, M_PI));
  GaussianPose pose = composeWithMotion({truth, {}}, disturbed({0, 0, 0}, random));
  SchmidtKalmanFilter correlation;
  for (int step = 0; step < kSteps; ++step)
  {
    const TPose2D increment(0.2, 0, 0.05);
    truth = truth + increment;
    const MotionIncrement motion = disturbed(increment, random);
    correlation.predict(pose.mean, motion.mean);
    pose = composeWithMotion(pose, motion);
    const LandmarkObservation seen = simulator.observe(truth, random);
    PoseEstimate estimate = toEstimate(pose);
    for (std::size_t k = 0; k < seen.features.size(); ++k)
    {
      const auto source = static_cast<std::uint32_t>(seen.sources[k]);
      const DirectedFeature observed = directed(seen.features[k]);
      const DirectedFeature known = directed(mapped[source]);
      const PlanarMeasurement m = placeMeasurement(estimate, observed, known, 0);
      if (errors_stay)
      {
        correlation.update(estimate, m, source, mapNoise(estimate, observed, known, 0), step);
      }
      else
      {
        update(estimate, m);
      }
    }
    pose = toGaussian(estimate);
  }
  return squaredMahalanobisDistance(pose, {truth, {}});
}

double meanErrorOfRuns(int runs, bool errors_stay)
{
  constexpr std::uint64_t kFirstSeed = 70000;
  double sum = 0;
  for (int run = 0; run < runs; ++run)
  {
    sum += errorAtTheEnd(kFirstSeed + static_cast<std::uint64_t>(run), errors_stay);
  }
  return sum / runs;
}

TEST(SchmidtKalmanFilter, KeepsTheCovarianceExactlyHonest)
{
  constexpr int kRuns = 1000;
  const double mean = meanErrorOfRuns(kRuns, true);
  std::cout << "mean squared normalised error of " << kRuns << " runs: " << mean << "\n";
  // The mean over the runs, times their number, is chi-square with 3 degrees of freedom a run.
  EXPECT_GT(mean, chiSquareGate(0.005, 3 * kRuns) / kRuns);
  EXPECT_LT(mean, chiSquareGate(0.995, 3 * kRuns) / kRuns);
}

TEST(SchmidtKalmanFilter, IsWhatKeepsItHonest)
{
  constexpr int kRuns = 1000;
  EXPECT_GT(meanErrorOfRuns(kRuns, false), chiSquareGate(0.995, 3 * kRuns) / kRuns);
}

TEST(SchmidtKalmanFilter, ForgetsWhatWasLastSeenLongAgo)
{
  Feature feature;
  feature.position = {1, 2};
  feature.position_covariance.setIdentity();
  const DirectedFeature view = directed(feature);
  PoseEstimate estimate = toEstimate({});
  estimate.covariance = {1, 0, 0, 1, 0, 1};
  SchmidtKalmanFilter correlation;
  for (std::uint32_t k = 0; k < 5; ++k)
  {
    correlation.update(estimate, placeMeasurement(estimate, view, view, 0), k,
                       mapNoise(estimate, view, view, 0), k);
  }
  correlation.forgetBefore(2);
  EXPECT_EQ(correlation.size(), 3U);
  EXPECT_FALSE(correlation.knows(1));
  EXPECT_TRUE(correlation.knows(2));
}

TEST(FeatureTracking, CovarianceIsHonestOnGatedDrives)
{
  SimulatedTrackOptions options;
  options.drives = 150;
  options.drives_per_world = 3;
  options.travel = 8;
  options.map_sigma = 0;
  options.kinds = {WorldKind::points};
  options.method.seed = 23;
  options.threads = 2;
  double sum = 0;
  std::size_t count = 0;
  std::ostringstream others;
  const WakeupReport report = runSimulatedTrack(options);
  for (const Wakeup& run : report.methods.front().runs)
  {
    const WakeupStep& end = run.steps.back();
    if (end.judged != Claim::right)
    {
      others << "drive " << run.start << " of " << run.steps.size() << " steps ends confident "
             << end.claim.confident << ", " << end.error.distance << " m and "
             << mrpt::RAD2DEG(end.error.angle) << " degrees off\n";
      continue;
    }
    sum += end.nees;
    ++count;
  }
  std::cout << "gated drives: mean squared normalised error " << sum / static_cast<double>(count)
            << " at the end of " << count << "\n";
  EXPECT_GE(count, 140U) << others.str();
  EXPECT_GT(sum / static_cast<double>(count), 2.0);
  EXPECT_LT(sum / static_cast<double>(count), 4.0);
}

/// Positions of landmarks that fix the pose of the robot, around (0, 0).
const std::vector<TPoint2D> kUnique = {{3, 1},     {-2, 4}, {4.5, -3}, {1, -5},
                                       {-4, -1.5}, {6, 3},  {-1, 2.2}, {2.4, 5.5}};
/// As seen ahead, symmetric about the x axis.
const std::vector<TPoint2D> kPattern = {{3, 2}, {3, -2}, {5, 3.1}, {5, -3.1}, {7, 0.9}, {7, -0.9}};
constexpr double kHalfway = 0.6;  // [m], from the middle to either copy of the pattern

Feature landmarkAt(const TPoint2D& place, double sigma)
{
  Feature feature;
  feature.position = place;
  feature.position_covariance.setIdentity();
  feature.position_covariance *= sigma * sigma;
  return feature;
}

ObservedScene sceneOf(const std::vector<TPoint2D>& places)
{
  ObservedScene scene;
  for (const TPoint2D& place : places) scene.features.push_back(landmarkAt(place, 0.03));
  return scene;
}

/// A unique pattern at x = 0 and, turned upside down, at x = 60; at x = 30 one pattern twice.
std::shared_ptr<const SignatureMatcher> ambiguousPlace()
{
  std::vector<Feature> map;
  for (const TPoint2D& p : kUnique)
  {
    map.push_back(landmarkAt(p, 0.01));
    map.push_back(landmarkAt({60 + p.y, p.x}, 0.01));
  }
  for (const TPoint2D& p : kPattern)
  {
    map.push_back(landmarkAt({30 + p.x, p.y + kHalfway}, 0.01));
    map.push_back(landmarkAt({30 + p.x, p.y - kHalfway}, 0.01));
  }
  return std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(map));
}

/// A drive of 30 m whose lateral error is large.
MotionIncrement drift()
{
  MotionIncrement motion;
  motion.mean = {30, 0, 0};
  motion.covariance(0, 0) = 1e-4;
  motion.covariance(1, 1) = 0.25;
  motion.covariance(2, 2) = 1e-6;
  return motion;
}

TEST(FeatureMatching, ListsTenOfTwentyCopiesOfAPattern)
{
  constexpr double kApart = 60;  // [m]
  std::vector<Feature> map;
  for (int copy = 0; copy < 20; ++copy)
  {
    for (const TPoint2D& p : kPattern) map.push_back(landmarkAt({copy * kApart + p.x, p.y}, 0.01));
  }
  const SignatureMatcher matcher(std::make_shared<const FeatureMap>(map));
  EXPECT_EQ(matcher.localize(sceneOf(kPattern)).candidates.size(), 10U);
}

TEST(FeatureTracking, SplitsWhereTwoPairingsAreAsGoodAndJoinsAgain)
{
  TrackerOptions options;
  options.relocation_distance = options.confirmation_distance = 90;  // the tracks alone
  HypothesisTracker tracker(ambiguousPlace(), options);
  const Belief start = tracker.step(MotionIncrement{}, sceneOf(kUnique));
  ASSERT_FALSE(start.hypotheses.empty());
  EXPECT_GT(start.hypotheses[0].weight, 0.9);
  EXPECT_NEAR(start.hypotheses[0].pose.mean.x, 0, 0.05);

  const Belief split = tracker.step(drift(), sceneOf(kPattern));
  ASSERT_GE(split.hypotheses.size(), 2U);
  const TrackedHypothesis& one = split.hypotheses[0];
  const TrackedHypothesis& other = split.hypotheses[1];
  EXPECT_NEAR(one.weight, other.weight, 1e-4);  // but for the linearisation
  EXPECT_NEAR(one.weight, 0.5 * (1 - split.elsewhere), 0.01);  // of all that the parent had
  EXPECT_NEAR(std::abs(one.pose.mean.y), kHalfway, 0.1);
  EXPECT_NEAR(one.pose.mean.y + other.pose.mean.y, 0, 1e-3);
  EXPECT_EQ(split.verdict, Verdict::ambiguous);
  EXPECT_NE(one.id, other.id);

  std::vector<TPoint2D> seen;
  for (const TPoint2D& p : kUnique) seen.emplace_back(p.y, p.x);
  const Belief joined = tracker.step(drift(), sceneOf(seen));
  ASSERT_FALSE(joined.hypotheses.empty());
  EXPECT_GT(joined.hypotheses[0].weight, 0.99);
  EXPECT_EQ(joined.hypotheses[0].id, start.hypotheses[0].id);
  EXPECT_NEAR(joined.hypotheses[0].pose.mean.x, 60, 0.05);
  EXPECT_NEAR(joined.hypotheses[0].pose.mean.y, 0, 0.05);
}

TEST(FeatureTracking, WhereNothingIsMappedAClaimStands)
{
  std::vector<Feature> map;
  for (const TPoint2D& p : kUnique) map.push_back(landmarkAt(p, 0.01));
  HypothesisTracker tracker(
      std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(map)));
  for (const double x : {-0.6, -0.3, 0.0})
  {
    MotionIncrement drive;
    drive.mean = {0.3, 0, 0};
    std::vector<TPoint2D> seen;
    for (const TPoint2D& p : kUnique) seen.emplace_back(p.x - x, p.y);
    tracker.step(drive, sceneOf(seen));
  }
  ASSERT_EQ(tracker.belief().verdict, Verdict::localized);
  Random random(5, 1);
  for (int step = 1; step <= 8; ++step)
  {
    MotionIncrement drive;
    drive.mean = {step == 1 ? 16.0 : 0.5, 0, 0};
    drive.covariance(0, 0) = drive.covariance(1, 1) = 1e-4;
    drive.covariance(2, 2) = 1e-6;
    std::vector<TPoint2D> unmapped;
    for (int k = 0; k < 6; ++k)
    {
      unmapped.emplace_back(random.uniform(0.5, 5.0), random.uniform(-4.0, 4.0));
    }
    const Belief& belief = tracker.step(drive, sceneOf(unmapped));
    ASSERT_FALSE(belief.hypotheses.empty());
    EXPECT_NEAR(belief.hypotheses[0].pose.mean.x, 15.5 + 0.5 * step, 0.1) << step;
    EXPECT_GE(belief.hypotheses[0].weight, 0.99) << step;
    EXPECT_EQ(belief.verdict, Verdict::localized) << step;
  }
}

TEST(FeatureTracking, AFirstLookAtTooLittleDoesNotEndTheSearch)
{
  std::vector<Feature> map;
  for (const TPoint2D& p : kUnique)
  {
    map.push_back(landmarkAt(p, 0.01));
    map.push_back(landmarkAt({50 + p.x, p.y}, 0.01));
  }
  HypothesisTracker tracker(
      std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(map)));
  PoseRegion second_copy;
  second_copy.x_min = 45;
  second_copy.x_max = 55;
  second_copy.y_min = -5;
  second_copy.y_max = 5;
  tracker.reset(second_copy);
  EXPECT_EQ(tracker.step(std::nullopt, sceneOf({kUnique.front()})).verdict,
            Verdict::too_little_seen);
  EXPECT_FALSE(tracker.relocated());
  const Belief& found = tracker.step(MotionIncrement{}, sceneOf(kUnique));
  EXPECT_TRUE(tracker.relocated());
  ASSERT_EQ(found.hypotheses.size(), 1U);
  EXPECT_NEAR(found.hypotheses[0].pose.mean.x, 50, 0.05);
}

TEST(FeatureTracking, LeavesOutWhatTheMapDoesNotHold)
{
  const auto matcher = ambiguousPlace();
  HypothesisTracker tracker(matcher);
  HypothesisTracker with_walls(matcher);
  ObservedScene scene = sceneOf(kUnique);
  ObservedScene more = scene;
  Feature wall;
  wall.type = FeatureType::segment;
  wall.position = {2, 2};
  wall.size = 3;
  more.features.insert(more.features.begin(), wall);
  for (int step = 0; step < 3; ++step)
  {
    const Belief& a = tracker.step(MotionIncrement{}, scene);
    const Belief& b = with_walls.step(MotionIncrement{}, more);
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
    EXPECT_EQ(a.hypotheses[0].pose.mean, b.hypotheses[0].pose.mean);
    EXPECT_EQ(a.hypotheses[0].weight, b.hypotheses[0].weight);
  }
  // A scene of walls alone only causes a prediction.
  ObservedScene walls;
  walls.features = {wall};
  const std::size_t held = with_walls.belief().hypotheses.size();
  EXPECT_EQ(with_walls.step(MotionIncrement{}, walls).hypotheses.size(), held);
}

// Evidence of a thousand landmarks at once is far beyond what a double holds as odds. The robot
// that was carried away must still be found at once.
TEST(FeatureTracking, OverwhelmingEvidenceLeavesWhatARelocationFinds)
{
  constexpr int kSide = 80;  // landmarks along a side of the map
  constexpr double kApart = 2;  // [m]
  constexpr double kView = 45;  // [m]
  Random random(620, 1);
  std::vector<Feature> map;
  for (int k = 0; k < kSide * kSide; ++k)
  {
    const double x = kApart * (k % kSide) + random.uniform(-0.5, 0.5);
    const double y = kApart * (k / kSide) + random.uniform(-0.5, 0.5);
    map.push_back(landmarkAt({x, y}, 0.01));
  }
  const auto seenFrom = [&](const TPoint2D& robot)
  {
    std::vector<TPoint2D> seen;
    for (const Feature& feature : map)
    {
      const TPoint2D at = feature.position - robot;
      if (at.norm() < kView) seen.push_back(at);
    }
    return sceneOf(seen);
  };
  HypothesisTracker tracker(
      std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(map)));
  MotionIncrement motion;
  motion.mean = {1, 0, 0};
  for (const TPoint2D& robot : {TPoint2D(60, 60), TPoint2D(100, 90)})
  {
    const Belief& belief = tracker.step(motion, seenFrom(robot));
    ASSERT_FALSE(belief.hypotheses.empty()) << robot;
    EXPECT_NEAR(belief.hypotheses[0].pose.mean.x, robot.x, 0.1);
    EXPECT_NEAR(belief.hypotheses[0].pose.mean.y, robot.y, 0.1);
  }
}
}  // namespace
}  // namespace sigloc
