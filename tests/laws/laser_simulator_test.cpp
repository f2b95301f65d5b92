// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/LaserSimulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/worlds/world_generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Intersects a ray with a line by solving the 2x2 system, an independent way to the caster's.
double bruteForce(const World& world, const TPoint2D& origin, double angle, double max_range)
{
  const TPoint2D d{std::cos(angle), std::sin(angle)};
  const TPoint2D normal{-d.y, d.x};
  double nearest = kInfinity;
  for (const WallSegment& s : visibleSegments(world))
  {
    const double side_a = normal.x * (s.start.x - origin.x) + normal.y * (s.start.y - origin.y);
    const double side_b = normal.x * (s.end.x - origin.x) + normal.y * (s.end.y - origin.y);
    if (side_a * side_b > 0 || side_a == side_b) continue;
    const double t = side_a / (side_a - side_b);
    const TPoint2D hit = s.start + (s.end - s.start) * t;
    const double distance = (hit.x - origin.x) * d.x + (hit.y - origin.y) * d.y;
    if (distance > 0) nearest = std::min(nearest, distance);
  }
  for (const Disc& disc : world.discs)
  {
    const TPoint2D o = origin - disc.centre;
    const double b = 2 * (o.x * d.x + o.y * d.y);
    const double c = o.x * o.x + o.y * o.y - disc.radius * disc.radius;
    const double discriminant = b * b - 4 * c;
    if (discriminant < 0) continue;
    for (const double sign : {-1.0, 1.0})
    {
      const double distance = 0.5 * (-b + sign * std::sqrt(discriminant));
      if (distance > 0) nearest = std::min(nearest, distance);
    }
  }
  return nearest <= max_range ? nearest : kInfinity;
}

class RayCasterWorlds : public ::testing::TestWithParam<WorldKind>
{
};

TEST_P(RayCasterWorlds, AgreesWithBruteForce)
{
  const World world = makeWorld(GetParam(), {}, 7);
  const WorldRayCaster caster(world);
  Random random(11);
  const Bounds& b = world.bounds;
  int hits = 0;
  for (int i = 0; i < 4000; ++i)
  {
    // Some rays start outside the world, some run exactly along an axis.
    const TPoint2D origin{random.uniform(b.x_min - 5, b.x_max + 5),
                          random.uniform(b.y_min - 5, b.y_max + 5)};
    const double angle =
        i % 10 == 0 ? M_PI / 2 * static_cast<double>(random.index(4)) : random.uniform(-M_PI, M_PI);
    const double max_range = i % 3 == 0 ? 6.0 : 100.0;
    const double expected = bruteForce(world, origin, angle, max_range);
    const double actual = caster.cast(origin, angle, max_range);
    if (std::isinf(expected))
    {
      EXPECT_TRUE(std::isinf(actual)) << "ray " << i << ": " << actual;
      continue;
    }
    ++hits;
    EXPECT_NEAR(actual, expected, 1e-9) << "ray " << i;
  }
  EXPECT_GT(hits, 500);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RayCasterWorlds,
                         ::testing::Values(WorldKind::office, WorldKind::corridor, WorldKind::hall,
                                           WorldKind::park),
                         [](const auto& tested) { return std::string(toString(tested.param)); });

TEST(WorldRayCaster, KnownDistances)
{
  World world;
  world.walls = {{{3, -1}, {3, 1}}};
  world.discs = {{{0, 5}, 1}};
  const WorldRayCaster caster(world);
  EXPECT_NEAR(caster.cast({0, 0}, 0, 10), 3, 1e-12);
  EXPECT_NEAR(caster.cast({5, 0}, M_PI, 10), 2, 1e-12) << "seen from behind";
  EXPECT_NEAR(caster.cast({0, 0}, M_PI / 2, 10), 4, 1e-12);
  EXPECT_TRUE(std::isinf(caster.cast({0, 0}, 0, 2.9))) << "beyond the range";
  EXPECT_TRUE(std::isinf(caster.cast({0, 0}, -M_PI / 2, 10)));
  EXPECT_TRUE(std::isinf(WorldRayCaster(World{}).cast({0, 0}, 0, 10))) << "an empty world";
}

TEST(LaserSimulator, FullCircleDoesNotRepeatItsFirstBeam)
{
  LaserOptions options;
  options.beams = 360;
  options.fov_deg = 360;
  const LaserScan scan = LaserSimulator(World{}, options).exactScan({});
  EXPECT_NEAR(scan.angle_step, M_PI / 180, 1e-12);
  EXPECT_NEAR(scan.first_angle, -179.5 * M_PI / 180, 1e-12);
}

TEST(LaserSimulator, SensorPoseMovesTheScan)
{
  const World world = makeWorld(WorldKind::hall, {}, 3);
  LaserOptions mounted;
  mounted.sensor_x = 0.4;
  mounted.sensor_y = -0.1;
  mounted.sensor_phi_deg = 30;
  const TPose2D robot{5, 4, 1.0};
  const TPose2D sensor = robot + TPose2D{0.4, -0.1, M_PI / 6};
  EXPECT_EQ(LaserSimulator(world, mounted).exactScan(robot).ranges,
            LaserSimulator(world, {}).exactScan(sensor).ranges);
}

TEST(LaserSimulator, BeamsOfATiltedRobotEndOnTheFloor)
{
  World world;
  world.bounds = {-50, 50, -50, 50};
  world.walls = {{{2, 10}, {2, -10}}, {{-4, 10}, {-4, -10}}};
  LaserOptions options;
  options.fov_deg = 360;
  options.beams = 360;
  options.height = 0.3;
  const auto ranges = [&](double pitch_deg)
  {
    options.pitch_deg = pitch_deg;
    return LaserSimulator(world, options).exactScan({0, 0, 0});
  };
  const double pitch = 5 * M_PI / 180;
  const LaserScan down = ranges(5);
  const LaserScan up = ranges(-5);
  const auto at = [](const LaserScan& scan, double bearing_deg)
  {
    const double i = (bearing_deg * M_PI / 180 - scan.first_angle) / scan.angle_step;
    return scan.ranges.at(static_cast<std::size_t>(std::lround(i)));
  };
  const double ahead = 0.5;  // where the beam nearest to the front lies
  const double off = ahead * M_PI / 180;
  // Nose down: the wall ahead comes before the floor, the one behind is seen from below.
  EXPECT_NEAR(at(down, ahead), 2 / (std::cos(off) * std::cos(pitch)), 1e-3);
  EXPECT_NEAR(at(down, 180 - ahead), 4 / (std::cos(off) * std::cos(pitch)), 1e-3);
  // Nose up: the floor behind comes before the wall.
  EXPECT_NEAR(at(up, 180 - ahead), 0.3 / (std::cos(off) * std::sin(pitch)), 1e-3);
  EXPECT_NEAR(at(up, ahead), 2 / (std::cos(off) * std::cos(pitch)), 1e-3);
  // Without walls only the floor is left, from abeam on to the front.
  world.walls.clear();
  options.max_range = 100;
  const LaserScan bare = ranges(5);
  for (std::size_t i = 0; i < bare.ranges.size(); ++i)
  {
    const double bearing = bare.first_angle + static_cast<double>(i) * bare.angle_step;
    const double floor = 0.3 / (std::cos(bearing) * std::sin(pitch));
    EXPECT_EQ(bare.valid[i] != 0, floor > 0 && floor <= 100);
    if (bare.valid[i] == 0) continue;
    EXPECT_NEAR(bare.ranges[i], floor, 1e-3 * floor);
  }
}

TEST(LaserSimulator, NoiseHasTheStatedStandardDeviation)
{
  const World world = makeWorld(WorldKind::office, {}, 1);
  LaserOptions options;
  options.range_sigma = 0.05;
  options.max_range = 60;
  const LaserSimulator laser(world, options);
  const TPose2D pose{12, 6, 0.3};
  const LaserScan exact = laser.exactScan(pose);
  Random random(5);
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (int k = 0; k < 200; ++k)
  {
    const LaserScan noisy = laser.scan(pose, random);
    for (std::size_t i = 0; i < noisy.ranges.size(); ++i)
    {
      if (exact.valid[i] == 0 || exact.ranges[i] < 0.5F) continue;
      const double error = static_cast<double>(noisy.ranges[i]) - exact.ranges[i];
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  ASSERT_GT(count, 20000);
  EXPECT_NEAR(sum / count, 0, 5 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.0005);
}

TEST(LaserSimulator, ClutterShortensTheStatedShareOfBeams)
{
  const World world = makeWorld(WorldKind::office, {}, 1);
  LaserOptions options;
  options.range_sigma = 0;
  options.clutter_share = 0.4;
  const LaserSimulator laser(world, options);
  const TPose2D pose{12, 6, 0.3};
  const LaserScan exact = laser.exactScan(pose);
  Random random(9);
  double shorter = 0;
  double count = 0;
  for (int k = 0; k < 100; ++k)
  {
    const LaserScan scan = laser.scan(pose, random);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      if (exact.valid[i] == 0) continue;
      EXPECT_LE(scan.ranges[i], exact.ranges[i]);
      shorter += scan.ranges[i] < exact.ranges[i] ? 1 : 0;
      ++count;
    }
  }
  EXPECT_NEAR(shorter / count, 0.4, 5 * std::sqrt(0.24 / count));
}

TEST(LaserSimulator, RangesAreRoundedToTheStep)
{
  const World world = makeWorld(WorldKind::office, {}, 1);
  LaserOptions options;
  options.range_step = 0.001;
  Random random(2);
  const LaserScan scan = LaserSimulator(world, options).scan({12, 6, 0}, random);
  for (const float range : scan.ranges)
  {
    const double steps = static_cast<double>(range) / 0.001;
    EXPECT_NEAR(steps, std::round(steps), 2e-3);
  }
}

TEST(LaserSimulator, RejectsBadOptions)
{
  LaserOptions options;
  options.clutter_share = 1.5;
  EXPECT_THROW(LaserSimulator(World{}, options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
