// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/features/observe_scans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/hand_made_scan.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using test::outline;
using test::scanByHand;
using test::Scanner;
using test::Surfaces;

std::vector<Feature> ofType(const ObservedScene& scene, FeatureType type)
{
  std::vector<Feature> out;
  std::copy_if(scene.features.begin(), scene.features.end(), std::back_inserter(out),
               [&](const Feature& feature) { return feature.type == type; });
  return out;
}

double turnBetween(double a, double b)
{
  return std::abs(std::remainder(a - b, 2 * M_PI));
}

/// A room 6 m x 4 m around the origin, without a door.
Surfaces closedRoom()
{
  return outline({{-2, -1.5}, {4, -1.5}, {4, 2.5}, {-2, 2.5}});
}

void expectWellFormed(const ObservedScene& scene)
{
  for (std::size_t k = 0; k < scene.features.size(); ++k)
  {
    const Feature& feature = scene.features[k];
    const auto& p = feature.position_covariance;
    EXPECT_TRUE(std::isfinite(feature.position.x) && std::isfinite(feature.position.y));
    EXPECT_TRUE(std::isfinite(feature.direction) && std::isfinite(feature.size));
    EXPECT_GT(p(0, 0), 0);
    EXPECT_GT(p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0), 0);
    EXPECT_EQ(p(0, 1), p(1, 0));
    EXPECT_GE(feature.direction_variance, 0);
    EXPECT_GE(feature.size_variance, 0);
    if (feature.type == FeatureType::corner || feature.type == FeatureType::wall_end)
    {
      ASSERT_GE(feature.parent, 0);
      ASSERT_LT(static_cast<std::size_t>(feature.parent), scene.features.size());
      EXPECT_EQ(scene.features[static_cast<std::size_t>(feature.parent)].type,
                FeatureType::segment);
    }
  }
  for (const BeamEnd& beam : scene.beams) EXPECT_LT(beam.origin, scene.sensor_origins.size());
}

TEST(FeatureExtractor, RoomHasFourWallsAndFourInnerCorners)
{
  const ObservedScene scene = observeScene({scanByHand(closedRoom(), {0, 0, 0})});
  expectWellFormed(scene);
  const auto walls = ofType(scene, FeatureType::segment);
  const auto corners = ofType(scene, FeatureType::corner);
  EXPECT_EQ(walls.size(), 4U);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());
  EXPECT_TRUE(ofType(scene, FeatureType::circle).empty());
  for (const Feature& corner : corners)
  {
    EXPECT_NEAR(corner.size, M_PI / 2, 0.01);
    // The bisector points into the room.
    const TPoint2D inside = corner.position + directionVector(corner) * 0.5;
    EXPECT_TRUE(inside.x > -2 && inside.x < 4 && inside.y > -1.5 && inside.y < 2.5);
    EXPECT_NEAR(std::abs(corner.position.x - 1), 3.0, 0.01);
    EXPECT_NEAR(std::abs(corner.position.y - 0.5), 2.0, 0.01);
  }
}

TEST(FeatureExtractor, SeamOfAFullCircleCutsNoWall)
{
  // Wherever the first beam points, the same walls and corners are seen.
  for (int k = 0; k < 24; ++k)
  {
    Scanner scanner;
    scanner.first_angle = -M_PI + 2 * M_PI * k / 24;
    const ObservedScene scene = observeScene({scanByHand(closedRoom(), {0.3, 0.2, 0}, scanner)});
    EXPECT_EQ(ofType(scene, FeatureType::segment).size(), 4U) << scanner.first_angle;
    EXPECT_EQ(ofType(scene, FeatureType::corner).size(), 4U) << scanner.first_angle;
    EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());
    EXPECT_EQ(scene.beams.size(), scanner.beams);
  }
}

TEST(FeatureExtractor, SeamOfAFullCircleHidesNoWallEndAndNoPillar)
{
  // A block and a pillar in the open room have jumps all around: the seam must not swallow any.
  Surfaces surfaces = closedRoom();
  surfaces.walls.push_back({{2.0, -0.6}, {2.0, 0.6}});
  surfaces.pillars.push_back({{-1.0, 0.9}, 0.2});
  const ObservedScene expected = observeScene({scanByHand(surfaces, {0, 0, 0})});
  ASSERT_EQ(ofType(expected, FeatureType::wall_end).size(), 2U);
  ASSERT_EQ(ofType(expected, FeatureType::circle).size(), 1U);
  Scanner scanner;
  scanner.beams = 360;
  for (int k = 0; k < 360; k += 3)
  {
    scanner.first_angle = -M_PI + 2 * M_PI * k / 360;
    const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0}, scanner)});
    EXPECT_EQ(ofType(scene, FeatureType::wall_end).size(), 2U) << "seam at " << k;
    EXPECT_EQ(ofType(scene, FeatureType::circle).size(), 1U) << "seam at " << k;
  }
}

TEST(FeatureExtractor, OuterCornerOpensThreeQuarters)
{
  // An L-shaped room; its re-entrant corner is at (1, 1).
  const Surfaces room = outline({{-2, -2}, {3, -2}, {3, 1}, {1, 1}, {1, 3}, {-2, 3}});
  const ObservedScene scene = observeScene({scanByHand(room, {-0.5, -0.5, 0})});
  const auto corners = ofType(scene, FeatureType::corner);
  const auto outer = std::find_if(corners.begin(), corners.end(),
                                  [](const Feature& corner) { return corner.size > M_PI; });
  ASSERT_NE(outer, corners.end());
  EXPECT_NEAR(outer->size, 1.5 * M_PI, 0.03);
  EXPECT_NEAR((outer->position - TPoint2D(1.5, 1.5)).norm(), 0, 0.01);  // robot frame
  EXPECT_LT(turnBetween(outer->direction, -0.75 * M_PI), 0.02);
}

TEST(FeatureExtractor, WallEndsOnlyWhereTheNextBeamIsFarther)
{
  // A screen in front of a wall: the screen really ends, the wall behind is only hidden.
  Surfaces surfaces;
  surfaces.walls = {{{2, -1}, {2, 1}}, {{5, -4}, {5, 4}}};
  const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0})});
  expectWellFormed(scene);
  const auto ends = ofType(scene, FeatureType::wall_end);
  ASSERT_EQ(ends.size(), 2U);
  for (const Feature& end : ends)
  {
    EXPECT_NEAR(end.position.x, 2.0, 0.02);
    EXPECT_NEAR(std::abs(end.position.y), 1.0, 0.05);
    EXPECT_LT(turnBetween(end.direction, end.position.y > 0 ? -M_PI / 2 : M_PI / 2), 1e-3);
    EXPECT_EQ(end.side, end.position.y < 0 ? WallSide::start : WallSide::end);
    EXPECT_NEAR(end.size, 2.0, 0.1);
  }
  for (const Feature& wall : ofType(scene, FeatureType::segment))
  {
    const bool screen = wall.position.x < 3;
    EXPECT_EQ(wall.start_seen, screen);
    EXPECT_EQ(wall.end_seen, screen);
  }
}

TEST(FeatureExtractor, WhereNothingReturnsNoWallEnds)
{
  Surfaces surfaces;
  surfaces.walls = {{{2, -1}, {2, 1}}};
  const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0})});
  ASSERT_EQ(ofType(scene, FeatureType::segment).size(), 1U);
  EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());
}

TEST(FeatureExtractor, PillarIsOneCircleAndNoSegment)
{
  for (const double distance : {1.0, 2.0, 3.5})
  {
    Surfaces surfaces = outline({{-5, -5}, {5, -5}, {5, 5}, {-5, 5}});
    surfaces.pillars.push_back({{distance, 0.4}, 0.2});
    Scanner scanner;
    scanner.beams = 720;
    const ObservedScene scene = observeScene({scanByHand(surfaces, {0, 0, 0}, scanner)});
    expectWellFormed(scene);
    const auto circles = ofType(scene, FeatureType::circle);
    ASSERT_EQ(circles.size(), 1U) << distance;
    EXPECT_NEAR((circles[0].position - TPoint2D(distance, 0.4)).norm(), 0, 0.05);
    EXPECT_NEAR(circles[0].size, 0.2, 0.05);
    for (const Feature& wall : ofType(scene, FeatureType::segment))
    {
      EXPECT_GT(wall.position.norm(), 4.0);
    }
  }
}

/// Every feature of `actual` has an equal one in `expected`, and the other way round.
void expectSameFeatures(const ObservedScene& actual, const ObservedScene& expected,
                        double tolerance, const std::string& name)
{
  ASSERT_EQ(actual.features.size(), expected.features.size()) << name;
  for (const Feature& wanted : expected.features)
  {
    const bool found =
        std::any_of(actual.features.begin(), actual.features.end(),
                    [&](const Feature& feature)
                    {
                      return feature.type == wanted.type && feature.side == wanted.side &&
                             (feature.position - wanted.position).norm() < tolerance &&
                             turnBetween(feature.direction, wanted.direction) < tolerance &&
                             std::abs(feature.size - wanted.size) < tolerance;
                    });
    EXPECT_TRUE(found) << name << ": no " << static_cast<int>(wanted.type) << " at "
                       << wanted.position;
  }
}

TEST(FeatureExtractor, MountingPosesDontShowInTheRobotFrame)
{
  // The sensor stays put in the world while the robot's frame moves around it.
  Surfaces surfaces = closedRoom();
  surfaces.walls.push_back({{2.0, -0.6}, {2.0, 0.6}});
  const TPose2D world_from_sensor(0.1, 0.2, 0.3);
  const ObservedScene sensor_frame = observeScene({scanByHand(surfaces, world_from_sensor)});
  for (const TPose2D& robot_from_sensor :
       {TPose2D(0.4, 0, 0), TPose2D(-0.2, 0.3, M_PI), TPose2D(0, 0, -2.0)})
  {
    Scanner scanner;
    scanner.robot_from_sensor = robot_from_sensor;
    const TPose2D world_from_robot = world_from_sensor + (TPose2D(0, 0, 0) - robot_from_sensor);
    const ObservedScene scene = observeScene({scanByHand(surfaces, world_from_robot, scanner)});
    ObservedScene expected;
    for (const Feature& feature : sensor_frame.features)
    {
      expected.features.push_back(transformed(robot_from_sensor, feature));
    }
    expectSameFeatures(scene, expected, 1e-6, "mounting");
    EXPECT_NEAR(scene.sensor_origins.at(0).x, robot_from_sensor.x, 1e-12);
    EXPECT_NEAR(scene.sensor_origins.at(0).y, robot_from_sensor.y, 1e-12);
  }
}

TEST(FeatureExtractor, SeveralLasersShareOneScene)
{
  Surfaces surfaces = closedRoom();
  surfaces.walls.push_back({{2.0, -0.6}, {2.0, 0.6}});
  Scanner front;
  front.field_of_view = M_PI;
  front.first_angle = -M_PI / 2;
  front.robot_from_sensor = {0.3, 0, 0};
  Scanner rear = front;
  rear.robot_from_sensor = {-0.3, 0, M_PI};
  const LaserScan a = scanByHand(surfaces, {0, 0, 0}, front);
  const LaserScan b = scanByHand(surfaces, {0, 0, 0}, rear);
  const ObservedScene both = observeScene({a, b});
  expectWellFormed(both);
  EXPECT_EQ(both.sensor_origins.size(), 2U);
  EXPECT_EQ(both.beams.size(), front.beams + rear.beams);
  EXPECT_EQ(both.beams.front().origin, 0U);
  EXPECT_EQ(both.beams.back().origin, 1U);
  EXPECT_EQ(both.features.size(),
            observeScene({a}).features.size() + observeScene({b}).features.size());
}

TEST(FeatureExtractor, AnyBeamCountFindsTheRoom)
{
  for (const std::size_t beams : {181U, 361U, 1081U, 4000U})
  {
    Scanner scanner;
    scanner.beams = beams;
    const ObservedScene scene = observeScene({scanByHand(closedRoom(), {0, 0, 0}, scanner)});
    expectWellFormed(scene);
    const auto walls = ofType(scene, FeatureType::segment);
    // With few beams a short piece may bridge a corner.
    EXPECT_EQ(std::count_if(walls.begin(), walls.end(),
                            [](const Feature& wall) { return wall.size > 0.5; }),
              4)
        << beams;
    EXPECT_GE(ofType(scene, FeatureType::corner).size(), 4U) << beams;
  }
  for (const std::size_t beams : {0U, 1U, 2U, 3U, 5U})
  {
    Scanner scanner;
    scanner.beams = beams;
    const LaserScan scan = beams == 0 ? [] {
      LaserScan none;
      none.angle_step = 0.01;
      return none;
    }()
                                      : scanByHand(closedRoom(), {0, 0, 0}, scanner);
    const ObservedScene scene = observeScene({scan});
    expectWellFormed(scene);
    EXPECT_EQ(scene.beams.size(), beams);
  }
  EXPECT_TRUE(observeScene({}).beams.empty());
}

TEST(FeatureExtractor, NoisyRoomKeepsItsWalls)
{
  std::mt19937_64 random(77);
  for (int k = 0; k < 20; ++k)
  {
    Scanner scanner;
    scanner.sigma = 0.015;
    const ObservedScene scene =
        observeScene({scanByHand(closedRoom(), {0.5, 0.2, 0.1 * k}, scanner, &random)});
    expectWellFormed(scene);
    // Noise may cut a wall, but its pieces still cover the 20 m of the outline.
    double length = 0;
    for (const Feature& wall : ofType(scene, FeatureType::segment)) length += wall.size;
    EXPECT_GT(length, 17.0);
    EXPECT_LT(length, 20.5);
    EXPECT_GE(ofType(scene, FeatureType::corner).size(), 3U);
    EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());
  }
}

TEST(FeatureExtractor, AVeryNoisyRoomKeepsItsWalls)
{
  std::mt19937_64 random(78);
  for (int k = 0; k < 20; ++k)
  {
    Scanner scanner;
    scanner.sigma = 0.1;
    const ObservedScene scene =
        observeScene({scanByHand(closedRoom(), {0.5, 0.2, 0.1 * k}, scanner, &random)});
    expectWellFormed(scene);
    const std::vector<Feature> walls = ofType(scene, FeatureType::segment);
    double length = 0;
    for (const Feature& wall : walls) length += wall.size;
    EXPECT_GT(length, 17.0);
    EXPECT_LT(length, 23.0);
    EXPECT_LE(walls.size(), 16U);
    EXPECT_LE(ofType(scene, FeatureType::wall_end).size(), 1U);
  }
}

TEST(FeatureExtractor, BrokenBeamsAreSkipped)
{
  LaserScan scan = scanByHand(closedRoom(), {0, 0, 0});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> broken = {nan, inf, -inf, 0.0F, -3.0F, 1e9F, 0.01F};
  for (std::size_t k = 0; k < broken.size(); ++k) scan.ranges[40 * k + 10] = broken[k];
  const ObservedScene scene = observeScene({scan});
  expectWellFormed(scene);
  EXPECT_EQ(scene.beams.size(), scan.ranges.size() - broken.size());
  EXPECT_EQ(ofType(scene, FeatureType::segment).size(), 4U);
  EXPECT_EQ(ofType(scene, FeatureType::corner).size(), 4U);
  EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());

  for (const float value : broken)
  {
    std::fill(scan.ranges.begin(), scan.ranges.end(), value);
    EXPECT_TRUE(observeScene({scan}).beams.empty()) << value;
    EXPECT_TRUE(observeScene({scan}).features.empty()) << value;
  }
  scan = scanByHand(closedRoom(), {0, 0, 0});
  std::fill(scan.valid.begin(), scan.valid.end(), std::uint8_t{0});
  EXPECT_TRUE(observeScene({scan}).beams.empty());
}

TEST(FeatureExtractor, SpecklesTearNoWallApart)
{
  const LaserScan clean = scanByHand(closedRoom(), {0, 0, 0});
  const ObservedScene expected = observeScene({clean});
  LaserScan dusty = clean;
  std::size_t specks = 0;
  for (std::size_t i = 5; i < dusty.ranges.size(); i += 7)
  {
    dusty.ranges[i] *= i % 2 == 0 ? 0.3F : 0.6F;
    ++specks;
  }
  const ObservedScene scene = observeScene({dusty});
  EXPECT_EQ(scene.beams.size() + specks, expected.beams.size());
  EXPECT_EQ(ofType(scene, FeatureType::segment).size(), 4U);
  EXPECT_TRUE(ofType(scene, FeatureType::wall_end).empty());
}

TEST(FeatureExtractor, LonelyReturnsThatAreFartherStay)
{
  // Seen through a gap: one beam reaches a point behind the wall.
  LaserScan scan = scanByHand(closedRoom(), {0, 0, 0});
  const std::size_t all = observeScene({scan}).beams.size();
  scan.ranges[scan.ranges.size() / 2] += 3.0F;
  EXPECT_EQ(observeScene({scan}).beams.size(), all);
}

TEST(FeatureExtractor, RefusesInconsistentScans)
{
  LaserScan scan = scanByHand(closedRoom(), {0, 0, 0});
  scan.valid.pop_back();
  EXPECT_THROW(observeScene({scan}), std::invalid_argument);
  scan.valid.push_back(1);
  for (const double step : {0.0, -0.01, std::numeric_limits<double>::quiet_NaN()})
  {
    scan.angle_step = step;
    EXPECT_THROW(observeScene({scan}), std::invalid_argument);
  }
}
}  // namespace
}  // namespace sigloc
