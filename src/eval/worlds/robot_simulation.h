// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "eval/worlds/FreeSpace.h"
#include "eval/worlds/LandmarkSimulator.h"
#include "eval/worlds/LaserSimulator.h"
#include "sigloc/config/option_fields.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// How a simulated robot drives.
struct DriveOptions
{
  double metres = 60;
  std::uint32_t max_steps = 100000;
  double speed = 0.5;
  double step_time = 0.5;
  double turn_rate_deg = 60;
  double clearance = kRobotClearance;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = DriveOptions;
    visit(OptionField{"metres", &O::metres, 0.0, 1e6, "[m] length of the drive"});
    visit(OptionField{"max_steps", &O::max_steps, 1U, 10000000U, "[-] the drive ends there"});
    visit(OptionField{"speed", &O::speed, 0.01, 20.0, "[m/s] forward"});
    visit(OptionField{"step_time", &O::step_time, 0.01, 60.0, "[s] between two scans"});
    visit(OptionField{"turn_rate_deg", &O::turn_rate_deg, 1.0, 720.0,
                      "[deg/s] beyond this the robot turns on the spot"});
    visit(OptionField{"clearance", &O::clearance, 0.05, 5.0, "[m] kept from every surface"});
  }
};

/// Odometry errors: MRPT's Gaussian motion model and its default values, so that programs which
/// apply that model to a log without stated noise are right.
struct OdometryOptions
{
  double a1 = 0.01;
  double a2 = 0.0572957795;
  double a3 = 0.0174532925;
  double a4 = 0.05;
  double min_sigma_xy = 0.01;
  double min_sigma_phi = 0.0034906585;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = OdometryOptions;
    visit(OptionField{"a1", &O::a1, 0.0, 10.0, "[m/m] sigma of x and y a metre driven"});
    visit(OptionField{"a2", &O::a2, 0.0, 10.0, "[m/rad] sigma of x and y a radian turned"});
    visit(OptionField{"a3", &O::a3, 0.0, 10.0, "[rad/m] sigma of phi a metre driven"});
    visit(OptionField{"a4", &O::a4, 0.0, 10.0, "[rad/rad] sigma of phi a radian turned"});
    visit(
        OptionField{"min_sigma_xy", &O::min_sigma_xy, 1e-6, 10.0, "[m] smallest sigma of a step"});
    visit(OptionField{"min_sigma_phi", &O::min_sigma_phi, 1e-6, 10.0,
                      "[rad] smallest sigma of a step"});
  }
};

/// One step of a simulated drive.
struct DriveStep
{
  double time = 0;  ///< [s] since the epoch of 1970
  mrpt::math::TPose2D world_from_robot;  ///< the exact truth
  mrpt::math::TPose2D odometry;  ///< measured increments summed up from (0, 0, 0)
  MotionIncrement motion;  ///< measured since the step before; zero at the first step
  std::optional<LaserScan> scan;
  std::vector<Feature> landmarks;
};

/// Every simulated log starts at this time [s since 1970]: files do not depend on the clock. It is
/// no whole number, because pf-localization takes the times of a truth file for step indices when
/// the first one is whole.
constexpr double kSimulationEpoch = 1.0e9 + 0.25;

/// Returns the true poses of a drive between random positions, one every step_time. The robot
/// drives along shortest paths at constant speed, towards a point ahead on the path. It turns on
/// the spot where the path bends faster than the turn rate. Throws std::invalid_argument for
/// options out of range.
std::vector<mrpt::math::TPose2D> simulateTruth(const FreeSpace& space, const DriveOptions& options,
                                               std::uint64_t seed);

/// Returns the measured increments of a true path, as many as poses; the first is zero.
/// Each states the covariance it was drawn with. A rawlog holds no covariance: its readers compute
/// that of the measured increment, which is a few percent larger where the robot moves little.
std::vector<MotionIncrement> simulateOdometry(const std::vector<mrpt::math::TPose2D>& truth,
                                              const OdometryOptions& options, std::uint64_t seed);

/// Returns the covariance of an increment in MRPT's Gaussian motion model.
mrpt::math::CMatrixDouble33 odometryCovariance(const mrpt::math::TPose2D& increment,
                                               const OdometryOptions& options);

/// Returns a whole drive through a world: truth, odometry and scans, each from its own random
/// stream of the seed.
std::vector<DriveStep> simulateDrive(const World& world, const DriveOptions& drive,
                                     const OdometryOptions& odometry, const LaserOptions& laser,
                                     std::uint64_t seed);

/// The same with a sensor of point landmarks in place of the laser.
std::vector<DriveStep> simulateLandmarkDrive(const World& world, const DriveOptions& drive,
                                             const OdometryOptions& odometry,
                                             const LandmarkSensorOptions& sensor,
                                             std::uint64_t seed);

/// Returns scans from all over a world with their exact poses, as a mapping run takes them. There
/// is one position each `spacing` [m], with a random heading. Lasers that see less than 300 degrees
/// take a second scan backwards.
std::vector<PosedScans> simulateMapping(const World& world, double spacing, double clearance,
                                        const LaserOptions& laser, std::uint64_t seed);
}  // namespace sigloc
