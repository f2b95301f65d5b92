// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_conversion.h"

#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <stdexcept>

#include "io/archive/UnreadObservation.h"
#include "io/solid/sensor_mount.h"

namespace sigloc
{
namespace
{
constexpr double kMaxTilt = 10.0 * M_PI / 180.0;  // [rad]
constexpr double kSameAngle = 1e-6;  // [rad]
constexpr double kMaxRangeSigma = 1.0;  // [m], a greater one counts as not given

double rangeSigmaOf(const mrpt::obs::CObservation2DRangeScan& scan)
{
  const auto sigma = static_cast<double>(scan.stdError);
  return sigma > 0 && sigma <= kMaxRangeSigma ? sigma : kDefaultRangeSigma;
}

/// A sensor's pose on the robot, seen from above.
struct PlanarMount
{
  mrpt::math::TPose2D robot_from_sensor;
  bool upside_down = false;
};

/// Returns nullopt for a pose that no sensor has, or tilted so that the planar model does not hold.
std::optional<PlanarMount> planarMountOf(const mrpt::poses::CPose3D& robot_from_sensor)
{
  if (!detail::isSensorMount(robot_from_sensor)) return std::nullopt;
  // The third column of the rotation is the scan plane's normal: up, down (upside-down mounting) or
  // tilted.
  const auto rotation = robot_from_sensor.getRotationMatrix();
  constexpr double kRounding = 1e-3;  // of files in single floats
  const Eigen::Matrix3d turned = rotation.asEigen();
  const Eigen::Matrix3d unit = turned * turned.transpose();
  if (!((unit - Eigen::Matrix3d::Identity()).norm() <= kRounding)) return std::nullopt;
  const double up = rotation(2, 2);
  if (std::abs(up) < std::cos(kMaxTilt)) return std::nullopt;
  const double heading = std::atan2(rotation(1, 0), rotation(0, 0));
  return PlanarMount{{robot_from_sensor.x(), robot_from_sensor.y(), heading}, up < 0};
}

void require(bool sound, const char* reason)
{
  if (!sound) throw std::invalid_argument(reason);
}
}  // namespace

std::optional<LaserScan> toLaserScan(const mrpt::obs::CObservation2DRangeScan& scan)
{
  const std::size_t n = scan.getScanSize();
  const auto mount = planarMountOf(scan.sensorPose);
  if (n < 2 || n > kMostBeams || !mount) return std::nullopt;

  LaserScan out;
  out.angle_step = static_cast<double>(scan.aperture) / static_cast<double>(n - 1);
  const auto view = static_cast<double>(scan.aperture);
  if (!(out.angle_step > 0 && out.angle_step < M_PI && view <= kMostView)) return std::nullopt;
  out.first_angle = -0.5 * static_cast<double>(scan.aperture);
  out.max_range = std::min(static_cast<double>(scan.maxRange), kFarthestReturn);
  out.range_sigma = rangeSigmaOf(scan);
  out.robot_from_sensor = mount->robot_from_sensor;
  out.ranges.resize(n);
  out.valid.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const float range = scan.getScanRange(i);
    const bool usable =
        scan.getScanRangeValidity(i) && range > 0 && static_cast<double>(range) < out.max_range;
    out.ranges[i] = usable ? range : 0.0F;
    out.valid[i] = usable ? 1 : 0;
  }
  // An upside-down sensor mirrors left and right; a clockwise one starts at its left end.
  const bool reversed = mount->upside_down == scan.rightToLeft;
  if (reversed)
  {
    std::reverse(out.ranges.begin(), out.ranges.end());
    std::reverse(out.valid.begin(), out.valid.end());
  }
  return out;
}

LaserScan toLaserScan(const RangeReadings& readings)
{
  constexpr double kWholeTurn = 2 * M_PI;
  const std::size_t n = readings.ranges.size();
  require(n >= 2, "a scan has at least two beams");
  require(std::isfinite(readings.first_angle) && std::abs(readings.first_angle) <= kWholeTurn,
          "the angle of the first beam is not within a turn");
  const double view = std::abs(readings.angle_step) * static_cast<double>(n - 1);
  require(view > 0 && view <= kMostView, "the beams do not cover more than 0 and at most one turn");
  require(readings.min_range >= 0 && readings.max_range > readings.min_range,
          "the limits of the range are not 0 <= least < greatest");
  require(readings.range_sigma > 0 && readings.range_sigma <= kMaxRangeSigma,
          "the standard deviation of a range is not within (0, 1] m");
  const auto mount = planarMountOf(readings.robot_from_sensor);
  require(
      mount.has_value(),
      "the sensor's pose on the robot is no number, beyond 100 m, or tilted by over 10 degrees");

  LaserScan out;
  out.max_range = std::min(readings.max_range, kFarthestReturn);
  out.range_sigma = readings.range_sigma;
  out.robot_from_sensor = mount->robot_from_sensor;
  for (const float reading : readings.ranges)
  {
    const auto range = static_cast<double>(reading);
    const bool usable = range > 0 && range >= readings.min_range && range < out.max_range;
    out.ranges.push_back(usable ? reading : 0.0F);
    out.valid.push_back(usable ? 1 : 0);
  }
  // Seen from above, the beams of an upside-down sensor turn the other way.
  const double turn = mount->upside_down ? -1 : 1;
  out.first_angle = turn * readings.first_angle;
  out.angle_step = turn * readings.angle_step;
  if (out.angle_step < 0)
  {
    out.first_angle += static_cast<double>(n - 1) * out.angle_step;
    out.angle_step = -out.angle_step;
    std::reverse(out.ranges.begin(), out.ranges.end());
    std::reverse(out.valid.begin(), out.valid.end());
  }
  return out;
}

mrpt::obs::CObservation2DRangeScan::Ptr toRangeScan(const LaserScan& scan, double time)
{
  auto out = mrpt::obs::CObservation2DRangeScan::Create();
  out->timestamp = mrpt::Clock::fromDouble(time);
  out->sensorLabel = "LASER";
  const double view = scan.angle_step * static_cast<double>(scan.ranges.size() - 1);
  out->aperture = static_cast<float>(view);
  out->rightToLeft = true;
  out->maxRange = static_cast<float>(scan.max_range);
  out->stdError = static_cast<float>(scan.range_sigma);
  // MRPT's scans are symmetric about the sensor's x axis.
  mrpt::math::TPose2D mount = scan.robot_from_sensor;
  const double middle = scan.first_angle + 0.5 * view;
  if (std::abs(middle) > kSameAngle) mount.phi += middle;
  out->sensorPose = mrpt::poses::CPose3D(mrpt::poses::CPose2D(mount));
  out->resizeScan(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const bool valid = scan.valid[i] != 0;
    // Scanners report the largest range where they get no return. Programs that use such beams as
    // free space then do the right thing.
    out->setScanRange(i, valid ? scan.ranges[i] : out->maxRange);
    out->setScanRangeValidity(i, valid);
  }
  return out;
}

std::vector<LaserScan> laserScansOf(const mrpt::obs::CSensoryFrame& frame)
{
  std::vector<LaserScan> scans;
  for (const auto& observation : frame)
  {
    const auto range_scan =
        std::dynamic_pointer_cast<const mrpt::obs::CObservation2DRangeScan>(observation);
    if (!range_scan) continue;
    if (auto scan = toLaserScan(*range_scan)) scans.push_back(std::move(*scan));
  }
  return scans;
}

std::vector<LaserScan> planarCutsOf(const mrpt::obs::CSensoryFrame& frame)
{
  std::vector<LaserScan> scans;
  for (const auto& entry : frame)
  {
    const auto solid = std::dynamic_pointer_cast<const detail::UnreadObservation>(entry);
    if (solid && solid->cut) scans.push_back(*solid->cut);
  }
  return scans;
}
}  // namespace sigloc
