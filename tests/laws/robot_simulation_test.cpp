// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/robot_simulation.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "eval/worlds/world_generators.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

double clearanceAt(const WorldRayCaster& caster, const TPose2D& pose)
{
  double nearest = 100;
  for (int i = 0; i < 90; ++i)
  {
    nearest = std::min(nearest, caster.cast({pose.x, pose.y}, i * 4 * M_PI / 180, 100));
  }
  return nearest;
}

class DriveWorlds : public ::testing::TestWithParam<WorldKind>
{
};

TEST_P(DriveWorlds, KeepsClearMovesSteadilyAndGoesFar)
{
  const World world = makeWorld(GetParam(), {}, 3);
  DriveOptions options;
  options.metres = 150;
  const FreeSpace space(world, options.clearance);
  const auto truth = simulateTruth(space, options, 21);
  const WorldRayCaster caster(world);
  const double stride = options.speed * options.step_time;
  const double max_turn = options.turn_rate_deg * M_PI / 180 * options.step_time;
  double farthest = 0;
  double travelled = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    // A path runs through cells whose centres keep the clearance: the clearance may be half a
    // cell's diagonal less.
    EXPECT_GT(clearanceAt(caster, truth[i]), options.clearance - 0.08) << "step " << i;
    if (i == 0) continue;
    const TPose2D motion = truth[i] - truth[i - 1];
    EXPECT_LE(std::hypot(motion.x, motion.y), stride + 1e-9) << "step " << i;
    EXPECT_LE(std::abs(mrpt::math::wrapToPi(motion.phi)), max_turn + 1e-9) << "step " << i;
    travelled += std::hypot(motion.x, motion.y);
    farthest = std::max(farthest, std::hypot(truth[i].x - truth[0].x, truth[i].y - truth[0].y));
  }
  EXPECT_NEAR(travelled, options.metres, 0.05 * options.metres);
  EXPECT_GT(farthest, 8);
}

INSTANTIATE_TEST_SUITE_P(Kinds, DriveWorlds,
                         ::testing::Values(WorldKind::office, WorldKind::corridor, WorldKind::hall,
                                           WorldKind::park),
                         [](const auto& tested) { return std::string(toString(tested.param)); });

TEST(Odometry, ErrorsHaveTheStatedCovariance)
{
  const World world = makeWorld(WorldKind::office, {}, 3);
  DriveOptions drive;
  drive.metres = 1500;
  const auto truth = simulateTruth(FreeSpace(world, drive.clearance), drive, 4);
  const auto motions = simulateOdometry(truth, {}, 4);
  ASSERT_EQ(motions.size(), truth.size());
  ASSERT_GT(motions.size(), 5000U);
  EXPECT_EQ(motions[0].mean, TPose2D(0, 0, 0));
  double nees = 0;
  double nees_of_log = 0;
  for (std::size_t i = 1; i < truth.size(); ++i)
  {
    const TPose2D exact = truth[i] - truth[i - 1];
    const TPose2D& measured = motions[i].mean;
    const Eigen::Vector3d error(measured.x - exact.x, measured.y - exact.y,
                                mrpt::math::wrapToPi(measured.phi - exact.phi));
    const Eigen::Matrix3d stated = motions[i].covariance.asEigen();
    const Eigen::Matrix3d in_log = odometryCovariance(measured, {}).asEigen();
    nees += error.dot(stated.llt().solve(error));
    nees_of_log += error.dot(in_log.llt().solve(error));
  }
  // Chi-square with 3 degrees of freedom: mean 3, variance 6.
  const double n = static_cast<double>(truth.size() - 1);
  EXPECT_NEAR(nees / n, 3.0, 5 * std::sqrt(6 / n));
  EXPECT_GT(nees_of_log / n, 2.6);
  EXPECT_LT(nees_of_log / n, 3.05);
}

TEST(Drive, IsDeterministicAndItsPartsAreIndependent)
{
  const World world = makeWorld(WorldKind::office, {}, 3);
  DriveOptions drive;
  drive.metres = 20;
  LaserOptions laser;
  const auto first = simulateDrive(world, drive, {}, laser, 8);
  const auto second = simulateDrive(world, drive, {}, laser, 8);
  laser.clutter_share = 0.3;
  const auto cluttered = simulateDrive(world, drive, {}, laser, 8);
  const auto other = simulateDrive(world, drive, {}, laser, 9);
  ASSERT_EQ(first.size(), second.size());
  ASSERT_EQ(first.size(), cluttered.size());
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].world_from_robot, second[i].world_from_robot);
    EXPECT_EQ(first[i].odometry, second[i].odometry);
    EXPECT_EQ(first[i].scan->ranges, second[i].scan->ranges);
    EXPECT_EQ(first[i].world_from_robot, cluttered[i].world_from_robot);
    EXPECT_EQ(first[i].odometry, cluttered[i].odometry);
    EXPECT_NE(first[i].scan->ranges, cluttered[i].scan->ranges);
  }
  EXPECT_NE(first[0].world_from_robot, other[0].world_from_robot);
  EXPECT_EQ(first[0].motion.mean, TPose2D(0, 0, 0));
  EXPECT_EQ(first[0].time, kSimulationEpoch);
}

TEST(Mapping, SeesEveryPlaceTheRobotCanBe)
{
  const World world = makeWorld(WorldKind::office, {}, 3);
  LaserOptions laser;
  laser.fov_deg = 180;
  const auto scans = simulateMapping(world, 2.0, 0.35, laser, 1);
  const FreeSpace space(world, 0.35);
  Random random(6);
  for (int i = 0; i < 300; ++i)
  {
    const TPoint2D place = space.randomPlace(random);
    double nearest = 100;
    for (const PosedScans& taken : scans)
    {
      nearest = std::min(
          nearest, std::hypot(taken.map_from_robot.x - place.x, taken.map_from_robot.y - place.y));
    }
    EXPECT_LT(nearest, 2.0 * M_SQRT2 + 1e-9);
  }
  ASSERT_EQ(scans.size() % 2, 0U);
  EXPECT_NEAR(
      std::abs(mrpt::math::wrapToPi(scans[0].map_from_robot.phi - scans[1].map_from_robot.phi)),
      M_PI, 1e-9);
}

TEST(FreeSpace, RefusesWhatIsNotFree)
{
  const World world = makeWorld(WorldKind::office, {}, 3);
  const FreeSpace space(world, 0.3);
  Random random(1);
  const TPoint2D place = space.randomPlace(random);
  EXPECT_THROW(space.path(place, {-5, -5}), std::invalid_argument);
  World full;
  full.bounds = {0, 1, 0, 1};
  full.discs = {{{0.5, 0.5}, 0.3}};
  EXPECT_THROW(FreeSpace(full, 0.5), std::invalid_argument);
}

TEST(Landmarks, StandardWorldIsObservedAsStated)
{
  WorldOptions options;
  options.points = 16000;
  const World world = makeWorld(WorldKind::points, options, 2);
  const LandmarkSensorOptions sensor;
  const LandmarkSimulator simulator(world, sensor);
  Random random(3);
  double observed = 0;
  double spurious = 0;
  double squares = 0;
  double matched = 0;
  for (int i = 0; i < 300; ++i)
  {
    const TPoint2D place{random.uniform(20, 380), random.uniform(20, 380)};
    const TPose2D pose{place.x, place.y, random.uniform(-M_PI, M_PI)};
    const LandmarkObservation seen = simulator.observe(pose, random);
    std::size_t expected = 0;
    for (const TPoint2D& p : world.points)
    {
      expected += std::hypot(p.x - place.x, p.y - place.y) <= sensor.range ? 1 : 0;
    }
    std::size_t true_ones = 0;
    for (std::size_t k = 0; k < seen.features.size(); ++k)
    {
      ++observed;
      if (seen.sources[k] < 0)
      {
        ++spurious;
        continue;
      }
      ++true_ones;
      const TPoint2D exact =
          pose.inverseComposePoint(world.points[static_cast<std::size_t>(seen.sources[k])]);
      const TPoint2D error = seen.features[k].position - exact;
      squares += error.x * error.x + error.y * error.y;
      matched += 2;
    }
    EXPECT_EQ(true_ones, expected);
  }
  EXPECT_NEAR(spurious / observed, 0.3, 0.01);
  EXPECT_NEAR(observed / 300, 0.1 * M_PI * 64 / 0.7, 1.5);
  EXPECT_NEAR(std::sqrt(squares / matched), 0.05, 0.001);
  const auto mapped = simulator.mappedLandmarks(random);
  ASSERT_EQ(mapped.size(), world.points.size());
  EXPECT_LT(std::hypot(mapped[0].position.x - world.points[0].x,
                       mapped[0].position.y - world.points[0].y),
            0.2);
}
}  // namespace
}  // namespace sigloc
