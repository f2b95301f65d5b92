// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sigloc/features/Feature.h"
#include "sigloc/features/LaserScan.h"

namespace sigloc
{
constexpr double kDefaultRangeSigma = 0.01;  ///< [m], of a scan that tells none
/// Beams of a scan at most: the finest lasers have 25 200. A zigzag of n returns is split in a time
/// of n^2.
constexpr std::size_t kMostBeams = 30000;
/// [rad] of a scan at most: rounding may carry it beyond a whole turn.
constexpr double kMostView = 1.01 * 2 * M_PI;

/// Returns the scan in the core's form, counter-clockwise: clockwise and upside-down scans are
/// reversed. NaN, infinite, non-positive and max-range beams are invalid, and those beyond
/// kFarthestReturn too. A noise of zero, or of more than a metre, counts as not given. Returns
/// nullopt for a scan with fewer than two beams, or more than kMostBeams, or whose plane is tilted
/// by more than 10 degrees. Returns nullopt, too, where the aperture is no part of a turn, or the
/// sensor pose is none or more than 100 m from the robot.
std::optional<LaserScan> toLaserScan(const mrpt::obs::CObservation2DRangeScan& scan);

/// A scan as programs hand it over: the message of ROS, or an array.
struct RangeReadings
{
  std::vector<float> ranges;  ///< [m]; a beam without a return is NaN, infinite or out of range
  double first_angle = 0;  ///< [rad] of the first beam in the sensor's frame
  double angle_step = 0;  ///< [rad] from beam to beam; negative: clockwise
  double min_range = 0;  ///< [m]
  double max_range = std::numeric_limits<double>::infinity();  ///< [m]
  double range_sigma = kDefaultRangeSigma;  ///< [m]
  mrpt::poses::CPose3D robot_from_sensor;
};

/// Returns such a scan in the core's form. Throws std::invalid_argument naming what is wrong. There
/// are fewer than two beams. Angles, limits or noise are not usable numbers. The sensor is more
/// than 100 m from the robot, or tilted by more than 10 degrees.
LaserScan toLaserScan(const RangeReadings& readings);

/// Returns a scan as MRPT stores it, at `time` [s since 1970], labelled "LASER".
mrpt::obs::CObservation2DRangeScan::Ptr toRangeScan(const LaserScan& scan, double time);

/// Returns all usable 2D scans of a sensory frame.
std::vector<LaserScan> laserScansOf(const mrpt::obs::CSensoryFrame& frame);

/// Returns the planar cuts that the observations of points in space of a frame were given.
std::vector<LaserScan> planarCutsOf(const mrpt::obs::CSensoryFrame& frame);

/// Returns the landmarks of an observation as points in the robot frame with their covariances,
/// without identities. Non-finite and non-positive ranges and those beyond kFarthestReturn are
/// skipped. So is a whole observation with a sensor pose that toLaserScan() refuses.
std::vector<Feature> landmarksOf(const mrpt::obs::CObservationBearingRange& observation);

/// Returns the landmarks of all CObservationBearingRange of a sensory frame.
std::vector<Feature> landmarksOf(const mrpt::obs::CSensoryFrame& frame);
}  // namespace sigloc
