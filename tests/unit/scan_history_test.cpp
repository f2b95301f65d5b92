// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/ScanHistory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "map/RayCaster.h"

namespace sigloc
{
namespace
{
using mrpt::math::TPose2D;

/// Two rooms side by side, of 9 m x 6 m each. Only their right parts are alike: a pillar stands in
/// the left part of the first.
DenseField twoRooms()
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, 440, 160};
  for (int y = 0; y < 160; ++y)
  {
    for (int x = 0; x < 440; ++x)
    {
      const int in_room = x % 220;
      const bool pillar = x >= 50 && x < 70 && y >= 60 && y < 90;
      const bool inside = in_room >= 20 && in_room < 200 && y >= 20 && y < 140;
      const bool edge = in_room >= 18 && in_room < 202 && y >= 18 && y < 142;
      raster.cells.push_back(inside && !pillar ? CellState::free
                             : edge            ? CellState::solid_wall
                                               : CellState::unknown);
    }
  }
  return buildDenseField(raster);
}

/// The scan of a laser that looks as far as 3.5 m.
DenseScan scanFrom(const DenseField& field, const TPose2D& pose)
{
  constexpr int kBeams = 180;
  constexpr double kRange = 3.5;  // [m]
  const RayCaster rays(field);
  ObservedScene scene;
  scene.sensor_origins = {{0, 0}};
  for (int i = 0; i < kBeams; ++i)
  {
    const double angle = -M_PI + 2 * M_PI * i / kBeams;
    const auto range = rays.cast({pose.x, pose.y}, pose.phi + angle, kRange);
    if (!range) continue;
    scene.beams.push_back({{*range * std::cos(angle), *range * std::sin(angle)}, 0});
  }
  return makeDenseScan(scene, kBeams);
}

/// The weight of a track that begins in the second room, 0.002 dealt to it. The robot has driven
/// through the first room, past the pillar, and a track has followed it, with `kappa`.
double weightOfTheOtherRoom(double kappa, double score)
{
  constexpr double kDealt = 0.002;
  constexpr double kStep = 0.5;  // [m]
  constexpr double kWay = 6.0;  // [m]
  const DenseField field = twoRooms();
  const DenseVerifier verifier(field);
  const TrackerOptions options;
  TrackSet set(options);
  set.elsewhere = 0;
  set.tracks.resize(2);
  Track& followed = set.tracks[0];
  followed.hypothesis.weight = 1 - kDealt;
  followed.confirmed = kappa;
  followed.score = score;
  followed.mean_score = 0.9;
  followed.in_field = true;
  set.tracks[1].hypothesis.weight = kDealt;
  ScanHistory history(options);
  TPose2D pose(1.8, 2.2, 0);
  DenseScan scan;
  double travelled = 0;
  for (; travelled < kWay; travelled += kStep)
  {
    MotionIncrement motion;
    motion.mean = {travelled > 0 ? kStep : 0, 0, 0};
    pose = pose + motion.mean;
    scan = scanFrom(field, pose);
    history.move(motion);
    history.remember(scan, travelled);
    if (travelled > 0) ++followed.hypothesis.age;
  }
  followed.hypothesis.pose.mean = pose;
  set.tracks[1].hypothesis.pose.mean = {pose.x + 11, pose.y, pose.phi};
  history.weighNewTracksAgainstOlder(set, scan, verifier, travelled);
  EXPECT_NEAR(set.tracks[0].hypothesis.weight + set.tracks[1].hypothesis.weight, 1, 1e-9);
  return set.tracks[1].hypothesis.weight;
}

TEST(ScanHistory, WhereTheRobotCannotHaveDrivenToItIsOnlyWhenItMayHaveBeenCarried)
{
  constexpr double kSure = 12;  // kappa
  constexpr double kGood = 0.9;  // score
  EXPECT_EQ(weightOfTheOtherRoom(kSure, kGood), 0);
  EXPECT_NEAR(weightOfTheOtherRoom(0, kGood), 0.002, 1e-6) << "the track may be wrong itself";
  EXPECT_NEAR(weightOfTheOtherRoom(kSure, 0.3), 0.002, 1e-6) << "it fits no more";
}
}  // namespace
}  // namespace sigloc
