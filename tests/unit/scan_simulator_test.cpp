// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sigloc/map/sensor_model.h"

using namespace sigloc;
using mrpt::math::TPose2D;

namespace
{
constexpr std::uint64_t kSeed = 11;
constexpr std::uint32_t kSide = 200;  // [cells] of 5 cm
constexpr std::size_t kWallAt = 180;  // column of a wall across the whole raster

/// Free space with a wall at x = 9.025 m. What is left of x = 1 m is unknown.
DenseField fieldWithWall(CellState wall = CellState::solid_wall, CellState behind = CellState::free)
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.05, kSide, kSide};
  raster.cells.assign(std::size_t{kSide} * kSide, CellState::free);
  for (std::size_t row = 0; row < kSide; ++row)
  {
    for (std::size_t column = 0; column < 20; ++column)
      raster.cells[row * kSide + column] = CellState::unknown;
    raster.cells[row * kSide + kWallAt] = wall;
    for (std::size_t column = kWallAt + 1; column < kSide; ++column)
      raster.cells[row * kSide + column] = behind;
  }
  return buildDenseField(raster);
}

/// A laser that looks ahead and sees the map as it is.
SimulatedLaserOptions exactLaser()
{
  SimulatedLaserOptions laser;
  laser.beams = 61;
  laser.first_angle = -0.3;
  laser.angle_step = 0.01;
  laser.range_sigma = laser.map_sigma = 0;
  laser.clutter_share = laser.moved_share = laser.lost_share = 0;
  return laser;
}

const TPose2D kPose(4.025, 5, 0);

/// Share of the returns of many scans that a test is true of.
template <class Test>
double shareOfReturns(const ScanSimulator& simulator, const Test& test)
{
  double count = 0;
  double all = 0;
  for (std::uint64_t k = 0; k < 300; ++k)
  {
    const LaserScan scan = simulator.scan(kPose, kSeed + k);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      const double angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
      all += 1;
      count += test(scan.valid[i] != 0, scan.ranges[i] * std::cos(angle)) ? 1 : 0;
    }
  }
  return count / all;
}
}  // namespace

TEST(ScanSimulator, withoutErrorsBeamsEndOnTheRidgeOfTheWall)
{
  const DenseField field = fieldWithWall();
  const ScanSimulator simulator(field, exactLaser());
  EXPECT_EQ(shareOfReturns(simulator, [](bool valid, double ahead)
                           { return valid && std::abs(ahead - 5.0) < 0.02; }),
            1.0);
}

TEST(ScanSimulator, equalSeedsGiveEqualScansAndOthersDoNot)
{
  const DenseField field = fieldWithWall();
  const ScanSimulator simulator(field, {});
  EXPECT_EQ(simulator.scan(kPose, kSeed).ranges, simulator.scan(kPose, kSeed).ranges);
  EXPECT_NE(simulator.scan(kPose, kSeed).ranges, simulator.scan(kPose, kSeed + 1).ranges);
}

TEST(ScanSimulator, clutterEndsItsShareOfTheBeamsBeforeTheWall)
{
  const DenseField field = fieldWithWall();
  SimulatedLaserOptions laser = exactLaser();
  laser.clutter_share = 0.2;
  EXPECT_NEAR(shareOfReturns(ScanSimulator(field, laser),
                             [](bool valid, double ahead) { return valid && ahead < 4.9; }),
              0.2, 0.06);
}

TEST(ScanSimulator, beamsGoOnWhereAMappedObjectIsGone)
{
  const DenseField field = fieldWithWall();
  SimulatedLaserOptions laser = exactLaser();
  laser.moved_share = 0.2;
  // Behind the wall the raster ends without another one.
  EXPECT_NEAR(
      shareOfReturns(ScanSimulator(field, laser), [](bool valid, double) { return !valid; }), 0.2,
      0.06);
}

TEST(ScanSimulator, rarelyHitWallsStopBeamsInTheirShareOfTheDirections)
{
  const DenseField field = fieldWithWall(CellState::wall);
  SimulatedLaserOptions laser = exactLaser();
  laser.thin_share = 0.4;
  EXPECT_NEAR(shareOfReturns(ScanSimulator(field, laser), [](bool valid, double) { return valid; }),
              0.4, 0.08);
}

TEST(ScanSimulator, rarelyHitWallsBeforeUnknownSpaceStopEveryBeam)
{
  const DenseField field = fieldWithWall(CellState::wall, CellState::unknown);
  SimulatedLaserOptions laser = exactLaser();
  laser.thin_share = 0.4;
  laser.unknown_range = 1000;
  EXPECT_EQ(shareOfReturns(ScanSimulator(field, laser), [](bool valid, double ahead)
                           { return valid && std::abs(ahead - 5.0) < 0.02; }),
            1.0);
  laser.backed_within = 0;
  EXPECT_NEAR(shareOfReturns(ScanSimulator(field, laser), [](bool valid, double) { return valid; }),
              0.4, 0.08);
}

TEST(ScanSimulator, unknownSpaceHasSurfacesAtTheGivenRange)
{
  const DenseField field = fieldWithWall();
  SimulatedLaserOptions laser = exactLaser();
  laser.sensor_phi = M_PI;
  laser.unknown_range = 0.25;
  // The unknown begins 3 m behind the robot and is 1 m deep: e^-4 of the beams pass through.
  const auto in_unknown = [](bool valid, double ahead)
  { return valid && ahead > 2.95 && ahead < 4.05; };
  EXPECT_NEAR(shareOfReturns(ScanSimulator(field, laser), in_unknown), 1 - std::exp(-4), 0.05);
}

TEST(ScanSimulator, refusesOptionsOutOfRange)
{
  const DenseField field = fieldWithWall();
  SimulatedLaserOptions laser;
  laser.clutter_share = 2;
  EXPECT_THROW(ScanSimulator(field, laser), std::invalid_argument);
}
