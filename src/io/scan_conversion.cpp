// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_conversion.h"

#include <algorithm>
#include <cmath>

#include "io/sensor_mount.h"

namespace sigloc
{
namespace
{
constexpr double kMaxTilt = 10.0 * M_PI / 180.0;  // [rad]
constexpr double kDefaultRangeSigma = 0.01;  // [m], where the log gives none
constexpr double kMaxRangeSigma = 1.0;  // [m], a greater one counts as not given

double rangeSigmaOf(const mrpt::obs::CObservation2DRangeScan& scan)
{
  const auto sigma = static_cast<double>(scan.stdError);
  return sigma > 0 && sigma <= kMaxRangeSigma ? sigma : kDefaultRangeSigma;
}
}  // namespace

std::optional<LaserScan> toLaserScan(const mrpt::obs::CObservation2DRangeScan& scan)
{
  const std::size_t n = scan.getScanSize();
  if (n < 2 || !detail::isSensorMount(scan.sensorPose)) return std::nullopt;

  // The third column of the rotation is the scan plane's normal: up, down (upside-down mounting) or
  // tilted, in which case the planar model does not hold.
  const auto rotation = scan.sensorPose.getRotationMatrix();
  const double up = rotation(2, 2);
  if (std::abs(up) < std::cos(kMaxTilt)) return std::nullopt;
  const bool upside_down = up < 0;

  LaserScan out;
  out.angle_step = static_cast<double>(scan.aperture) / static_cast<double>(n - 1);
  if (!(out.angle_step > 0 && std::isfinite(out.angle_step))) return std::nullopt;
  out.first_angle = -0.5 * static_cast<double>(scan.aperture);
  out.max_range = std::min(static_cast<double>(scan.maxRange), kFarthestReturn);
  out.range_sigma = rangeSigmaOf(scan);
  out.robot_from_sensor = {scan.sensorPose.x(), scan.sensorPose.y(),
                           std::atan2(rotation(1, 0), rotation(0, 0))};
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
  const bool reversed = upside_down == scan.rightToLeft;
  if (reversed)
  {
    std::reverse(out.ranges.begin(), out.ranges.end());
    std::reverse(out.valid.begin(), out.valid.end());
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
}  // namespace sigloc
