// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/observe_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace sigloc;
using mrpt::math::TPoint2D;

namespace
{
/// Where a laser of 1 degree at (0.5, 0) in a room of 8 m x 5 m around the origin hits, no beam
/// behind.
LaserScan roomScan()
{
  LaserScan scan;
  scan.first_angle = -0.75 * M_PI;
  scan.angle_step = M_PI / 180;
  scan.range_sigma = 0.02;
  scan.robot_from_sensor = {0.5, 0, 0};
  for (int i = 0; i <= 270; ++i)
  {
    const double angle = scan.first_angle + i * scan.angle_step;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double range = std::min((std::copysign(4.0, c) - 0.5) / c, std::copysign(2.5, s) / s);
    scan.ranges.push_back(static_cast<float>(range));
    scan.valid.push_back(1);
  }
  return scan;
}

std::vector<TPoint2D> shuffledReturns(const ObservedScene& scene)
{
  std::vector<TPoint2D> points;
  for (const BeamEnd& beam : scene.beams) points.push_back(beam.point);
  std::mt19937 random(5);
  std::shuffle(points.begin(), points.end(), random);
  return points;
}
}  // namespace

TEST(ObservePoints, SeesWhatTheLaserSaw)
{
  const ObservedScene of_scan = observeScene({roomScan()});
  const ObservedScene of_points = observePoints(shuffledReturns(of_scan), {0.5, 0});
  EXPECT_EQ(of_points.beams.size(), of_scan.beams.size());
  ASSERT_EQ(of_points.features.size(), of_scan.features.size());
  ASSERT_GE(of_scan.features.size(), 5U);
  for (const Feature& feature : of_scan.features)
  {
    EXPECT_TRUE(std::any_of(of_points.features.begin(), of_points.features.end(),
                            [&](const Feature& other)
                            {
                              return other.type == feature.type &&
                                     (other.position - feature.position).norm() < 1e-6 &&
                                     std::cos(other.direction - feature.direction) > 1 - 1e-9;
                            }));
  }
}

TEST(ObservePoints, KeepsTheNearestOfOneDirection)
{
  std::vector<TPoint2D> points = shuffledReturns(observeScene({roomScan()}));
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(TPoint2D(0.5, 0) + (points[i] - TPoint2D(0.5, 0)) * 1.5);
  }
  const ObservedScene scene = observePoints(points, {0.5, 0});
  EXPECT_EQ(scene.beams.size(), count);
  for (const BeamEnd& beam : scene.beams) EXPECT_LT(std::abs(beam.point.x), 4.001);
}

TEST(ObservePoints, SkipsWhatIsNoPoint)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(observePoints({}).features.empty());
  EXPECT_TRUE(observePoints({{nan, 1}, {0, 0}}).beams.empty());
  EXPECT_EQ(observePoints({{1, 1}, {nan, 2}}).beams.size(), 1U);
  EXPECT_EQ(observePoints({{1, 1}, {1e30, 2}}).beams.size(), 1U);
}

// The cells of such returns once overflowed an integer in the coarse stage.
TEST(ObserveScene, SeesNoReturnBeyondTheFarthest)
{
  LaserScan scan = roomScan();
  const std::size_t all = observeScene({scan}).beams.size();
  scan.max_range = 3e38;
  scan.ranges[10] = 1e38F;
  scan.ranges[20] = 2e4F;
  scan.ranges[30] = 9e3F;
  EXPECT_EQ(observeScene({scan}).beams.size(), all - 2);
}
