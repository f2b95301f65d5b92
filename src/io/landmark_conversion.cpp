// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "io/scan_conversion.h"
#include "io/solid/sensor_mount.h"

namespace sigloc
{
namespace
{
using mrpt::obs::CObservationBearingRange;

constexpr double kMinSigmaRange = 0.01;  // [m], where the log gives none
constexpr double kMinSigmaBearing = 0.1 * M_PI / 180.0;  // [rad]

/// The variance that a log gives, where it is valid, and at least the square of `least`.
double varianceOr(double given, double least)
{
  return std::isfinite(given) ? std::max(given, least * least) : least * least;
}

bool isUsable(const CObservationBearingRange::TMeasurement& measured)
{
  return measured.range > 0 && static_cast<double>(measured.range) <= kFarthestReturn &&
         std::isfinite(measured.yaw) && std::isfinite(measured.pitch);
}

Feature toPoint(const CObservationBearingRange& observation,
                const CObservationBearingRange::TMeasurement& measured)
{
  const double range = static_cast<double>(measured.range);
  const double yaw = static_cast<double>(measured.yaw);
  const double flat = std::cos(static_cast<double>(measured.pitch));
  double local_x = range * flat * std::cos(yaw);
  double local_y = range * flat * std::sin(yaw);
  double local_z = -range * std::sin(static_cast<double>(measured.pitch));
  double x = 0;
  double y = 0;
  double z = 0;
  const auto& pose = observation.sensorLocationOnRobot;
  pose.composePoint(local_x, local_y, local_z, x, y, z);

  double range_variance = std::pow(static_cast<double>(observation.sensor_std_range), 2);
  double bearing_variance = std::pow(static_cast<double>(observation.sensor_std_yaw), 2);
  if (observation.validCovariances)
  {
    range_variance = measured.covariance(0, 0);
    bearing_variance = measured.covariance(1, 1);
  }
  range_variance = varianceOr(range_variance, kMinSigmaRange);
  bearing_variance = varianceOr(bearing_variance, kMinSigmaBearing);

  // Along and across the line of sight, seen from above.
  const auto rotation = pose.getRotationMatrix();
  const double heading = std::atan2(rotation(1, 0), rotation(0, 0));
  const double c = std::cos(heading + yaw);
  const double s = std::sin(heading + yaw);
  const double along = flat * flat * range_variance;
  const double across = flat * flat * range * range * bearing_variance;
  Feature point;
  point.type = FeatureType::point;
  point.position = {x, y};
  point.position_covariance(0, 0) = c * c * along + s * s * across;
  point.position_covariance(1, 1) = s * s * along + c * c * across;
  point.position_covariance(0, 1) = point.position_covariance(1, 0) = c * s * (along - across);
  return point;
}
}  // namespace

std::vector<Feature> landmarksOf(const CObservationBearingRange& observation)
{
  std::vector<Feature> landmarks;
  if (!detail::isSensorMount(observation.sensorLocationOnRobot)) return landmarks;
  for (const auto& measured : observation.sensedData)
  {
    if (isUsable(measured)) landmarks.push_back(toPoint(observation, measured));
  }
  return landmarks;
}

std::vector<Feature> landmarksOf(const mrpt::obs::CSensoryFrame& frame)
{
  std::vector<Feature> landmarks;
  for (const auto& entry : frame)
  {
    const auto observation = std::dynamic_pointer_cast<const CObservationBearingRange>(entry);
    if (!observation) continue;
    const std::vector<Feature> seen = landmarksOf(*observation);
    landmarks.insert(landmarks.end(), seen.begin(), seen.end());
  }
  return landmarks;
}
}  // namespace sigloc
