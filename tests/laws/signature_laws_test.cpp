// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "eval/worlds/FeatureWorld.h"
#include "geometry/chi_square.h"
#include "signature/binary_constraint.h"
#include "signature/pose_fit.h"
#include "signature/unary_constraint.h"

namespace sigloc
{
namespace
{
FeatureWorldOptions everyType()
{
  FeatureWorldOptions options;
  options.type_weights = {1, 2, 1, 1, 1};
  return options;
}

mrpt::math::TPose2D anyPose(Random& random)
{
  return {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-M_PI, M_PI)};
}

TEST(BinaryConstraint, KeysAreInvariantUnderRigidMotion)
{
  Random random(1);
  const FeatureWorld world = makeFeatureWorld(60, everyType(), random);
  for (std::size_t i = 0; i < world.mapped.size(); ++i)
  {
    const mrpt::math::TPose2D motion = anyPose(random);
    for (std::size_t j = 0; j < world.mapped.size(); ++j)
    {
      if (i == j) continue;
      const Feature a = transformed(motion, world.mapped[i]);
      const Feature b = transformed(motion, world.mapped[j]);
      const BinaryKey before = binaryKey(directed(world.mapped[i]), directed(world.mapped[j]));
      const BinaryKey after = binaryKey(directed(a), directed(b));
      const double difference = before.is_angle ? mrpt::math::wrapToPi(before.value - after.value)
                                                : before.value - after.value;
      EXPECT_NEAR(difference, 0, 1e-9);
      EXPECT_NEAR(before.variance, after.variance, 1e-9 * (1 + before.variance));
    }
  }
}

TEST(BinaryConstraint, RightPairsPassTheGatesAsOftenAsTheySay)
{
  FeatureWorldOptions options = everyType();
  options.spurious = 0;
  options.range = 1e3;
  options.detection = 1;
  Random random(2);
  const FeatureWorld world = makeFeatureWorld(40, options, random);
  const mrpt::math::TPose2D robot_from_map = mrpt::math::TPose2D(0, 0, 0) - anyPose(random);
  const BinaryGates gates{chiSquareGate(0.995, 1), chiSquareGate(0.995, 2), 0.5};
  int passed = 0;
  int tried = 0;
  for (int round = 0; round < 20; ++round)
  {
    std::vector<Feature> seen;
    for (const Feature& feature : world.truth)
    {
      FeatureWorld one{world.side, {feature}, {}};
      seen.push_back(
          observeFeatures(one, mrpt::math::TPose2D(0, 0, 0) - robot_from_map, options, random)[0]);
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
    {
      for (std::size_t j = 0; j < seen.size(); ++j)
      {
        if (i == j) continue;
        ++tried;
        passed += binaryCompatible(directed(seen[i]), directed(seen[j]), directed(world.mapped[i]),
                                   directed(world.mapped[j]), {}, gates);
      }
    }
  }
  EXPECT_GT(passed, 0.98 * tried);
}

TEST(UnaryConstraint, TypesLabelsAndSizes)
{
  Feature wall;
  wall.type = FeatureType::segment;
  wall.size = 2;
  wall.position_covariance.setZero();
  Feature longer = wall;
  longer.size = 3;
  const double gate = chiSquareGate(0.995, 1);
  EXPECT_TRUE(unaryCompatible(directed(wall), directed(longer), gate));
  EXPECT_FALSE(unaryCompatible(directed(longer), directed(wall), gate));
  longer.label = 1;
  EXPECT_TRUE(unaryCompatible(directed(wall), directed(longer), gate));
  wall.label = 2;
  EXPECT_FALSE(unaryCompatible(directed(wall), directed(longer), gate));
  wall.type = FeatureType::point;
  wall.label = -1;
  EXPECT_FALSE(unaryCompatible(directed(wall), directed(longer), gate));
}

TEST(PoseFit, EveryBaseFindsTheExactPoseOfExactFeatures)
{
  FeatureWorldOptions options = everyType();
  Random random(4);
  for (int round = 0; round < 50; ++round)
  {
    const FeatureWorld world = makeFeatureWorld(10, options, random);
    const mrpt::math::TPose2D truth = anyPose(random);
    const mrpt::math::TPose2D inverse = mrpt::math::TPose2D(0, 0, 0) - truth;
    std::vector<Feature> seen;
    for (const Feature& f : world.mapped) seen.push_back(transformed(inverse, f));
    for (std::size_t i = 0; i < seen.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        const auto pose = poseFromBase({directed(seen[i]), directed(world.mapped[i])},
                                       {directed(seen[j]), directed(world.mapped[j])}, 0.02);
        ASSERT_TRUE(pose);
        EXPECT_NEAR(mrpt::math::wrapToPi(pose->heading - truth.phi), 0, 1e-6);
        EXPECT_NEAR(pose->x, truth.x, 1e-5);
        EXPECT_NEAR(pose->y, truth.y, 1e-5);
        EXPECT_TRUE(sigloc::inverse(pose->covariance)) << "not positive definite";
      }
    }
  }
}

TEST(PoseFit, ParallelWallsLeaveALineOfPoses)
{
  Feature wall;
  wall.type = FeatureType::segment;
  wall.size = 4;
  wall.direction = 0.5 * M_PI;
  wall.direction_variance = 1e-4;
  wall.position_covariance.setIdentity();
  wall.position_covariance *= 1e-4;
  Feature opposite = wall;
  opposite.position = {0, 3};
  opposite.direction = -0.5 * M_PI;
  const auto pose = poseFromBase({directed(wall), directed(wall)},
                                 {directed(opposite), directed(opposite)}, 0.02);
  ASSERT_TRUE(pose);
  EXPECT_GT(pose->covariance.xx, 0.5);
  EXPECT_LT(pose->covariance.yy, 0.01);
}

TEST(PoseFit, CoincidentPlacesFixNoPose)
{
  Feature point;
  point.position_covariance.setIdentity();
  EXPECT_FALSE(
      poseFromBase({directed(point), directed(point)}, {directed(point), directed(point)}, 0.02));
}

TEST(PoseFit, CovarianceOfTheRefitIsHonest)
{
  FeatureWorldOptions options = everyType();
  options.spurious = 0;
  options.detection = 1;
  options.range = 1e3;
  Random random(5);
  double sum = 0;
  constexpr int kRounds = 300;
  for (int round = 0; round < kRounds; ++round)
  {
    const FeatureWorld world = makeFeatureWorld(12, options, random);
    const mrpt::math::TPose2D truth = anyPose(random);
    std::vector<Feature> seen;
    for (const Feature& f : world.truth)
    {
      seen.push_back(observeFeatures({world.side, {f}, {}}, truth, options, random)[0]);
    }
    std::vector<DirectedPairing> pairings;
    for (std::size_t k = 0; k < seen.size(); ++k)
    {
      pairings.push_back({directed(seen[k]), directed(world.mapped[k])});
    }
    PoseEstimate start;
    start.x = truth.x + 0.3;
    start.y = truth.y - 0.2;
    start.setHeading(truth.phi + 0.1);
    const auto pose = refinePose(start, pairings, 0.0, 5);
    ASSERT_TRUE(pose);
    GaussianPose exact;
    exact.mean = truth;
    exact.covariance.setZero();
    sum += squaredMahalanobisDistance(toGaussian(*pose), exact);
  }
  // Mean of chi-square with 3 degrees of freedom over 300 rounds: 3 +- 0.14.
  EXPECT_NEAR(sum / kRounds, 3.0, 0.5);
}
}  // namespace
}  // namespace sigloc
