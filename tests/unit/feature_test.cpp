// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/features/Feature.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>
#include <random>

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kPi = 3.14159265358979323846;
constexpr double kTolerance = 1e-12;

void expectNear(const TPoint2D& actual, const TPoint2D& expected)
{
  EXPECT_NEAR(actual.x, expected.x, kTolerance);
  EXPECT_NEAR(actual.y, expected.y, kTolerance);
}

/// A wall across the x axis at x = 2, 3 m long, free space on the side of the origin.
Feature wallAcrossX()
{
  Feature wall;
  wall.type = FeatureType::segment;
  wall.position = {2.0, 0.5};
  wall.direction = kPi;
  wall.size = 3.0;
  wall.position_covariance(0, 0) = 0.04;
  wall.position_covariance(1, 1) = 0.25;
  wall.position_covariance(0, 1) = wall.position_covariance(1, 0) = 0.02;
  wall.direction_variance = 1e-4;
  wall.size_variance = 0.01;
  wall.start_seen = true;
  wall.label = 3;
  wall.parent = 7;
  return wall;
}

TEST(Feature, segmentRunsFromTheEndThatACounterClockwiseScanSeesFirst)
{
  const Feature wall = wallAcrossX();
  expectNear(directionVector(wall), {-1.0, 0.0});
  expectNear(tangentVector(wall), {0.0, 1.0});
  expectNear(segmentStart(wall), {2.0, -1.0});
  expectNear(segmentEnd(wall), {2.0, 2.0});
  const double start_bearing = std::atan2(segmentStart(wall).y, segmentStart(wall).x);
  const double end_bearing = std::atan2(segmentEnd(wall).y, segmentEnd(wall).x);
  EXPECT_LT(start_bearing, end_bearing);
}

TEST(Feature, lineDistanceIsNegativeForAnObserverInTheFreeSpace)
{
  EXPECT_NEAR(lineDistance(wallAcrossX()), -2.0, kTolerance);
}

TEST(Feature, transformedMovesThePlaceAndTurnsDirectionAndCovariance)
{
  const Feature wall = wallAcrossX();
  const Feature turned = transformed(TPose2D(1.0, 2.0, kPi / 2), wall);
  expectNear(turned.position, {0.5, 4.0});
  EXPECT_NEAR(turned.direction, -kPi / 2, kTolerance) << "wrapped";
  EXPECT_NEAR(turned.position_covariance(0, 0), 0.25, kTolerance);
  EXPECT_NEAR(turned.position_covariance(1, 1), 0.04, kTolerance);
  EXPECT_NEAR(turned.position_covariance(0, 1), -0.02, kTolerance);
  EXPECT_EQ(turned.position_covariance(0, 1), turned.position_covariance(1, 0));
  EXPECT_EQ(turned.size, wall.size);
  EXPECT_EQ(turned.direction_variance, wall.direction_variance);
  EXPECT_EQ(turned.size_variance, wall.size_variance);
  EXPECT_EQ(turned.start_seen, wall.start_seen);
  EXPECT_EQ(turned.label, wall.label);
  EXPECT_EQ(turned.parent, wall.parent);
}

TEST(Feature, aPointHasNoDirectionInAnyFrame)
{
  Feature point;
  point.position = {1.0, 0.0};
  EXPECT_EQ(transformed(TPose2D(0.0, 0.0, 1.0), point).direction, 0.0);
}

TEST(Feature, transformingIsAnActionOfTheGroupOfPoses)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> metres(-20.0, 20.0);
  std::uniform_real_distribution<double> radians(-kPi, kPi);
  const auto random_pose = [&] { return TPose2D(metres(random), metres(random), radians(random)); };
  for (int run = 0; run < 200; ++run)
  {
    Feature feature = wallAcrossX();
    feature.position = {metres(random), metres(random)};
    feature.direction = radians(random);
    const TPose2D b_from_a = random_pose();
    const TPose2D c_from_b = random_pose();

    const Feature in_steps = transformed(c_from_b, transformed(b_from_a, feature));
    const Feature at_once = transformed(c_from_b + b_from_a, feature);
    EXPECT_NEAR(in_steps.position.x, at_once.position.x, 1e-9);
    EXPECT_NEAR(in_steps.position.y, at_once.position.y, 1e-9);
    EXPECT_NEAR(mrpt::math::wrapToPi(in_steps.direction - at_once.direction), 0.0, 1e-9);
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(in_steps.position_covariance(i / 2, i % 2),
                  at_once.position_covariance(i / 2, i % 2), 1e-9);
    }
    const TPoint2D moved_end = b_from_a.composePoint(segmentEnd(feature));
    const TPoint2D end_of_moved = segmentEnd(transformed(b_from_a, feature));
    EXPECT_NEAR(moved_end.x, end_of_moved.x, 1e-9);
    EXPECT_NEAR(moved_end.y, end_of_moved.y, 1e-9);
  }
}
}  // namespace
}  // namespace sigloc
