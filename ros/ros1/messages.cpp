// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros1/messages.h"

#include <fmt/format.h>
#include <mrpt/math/CQuaternion.h>
#include <mrpt/poses/CPose2D.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/maps/occupancy_grid.h"
#include "io/scan_conversion.h"
#include "sigloc/map/map_building.h"

namespace sigloc::ros1
{
namespace
{
constexpr int kUnknown = -1;
constexpr int kPercent = 100;
constexpr char kName[] = "sigloc: localization";

/// Throws std::invalid_argument for a quaternion that is no rotation.
mrpt::poses::CPose3D poseOf(double x, double y, double z, const geometry_msgs::Quaternion& turn)
{
  const double norm =
      std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  if (!(std::abs(norm - 1) < 0.01)) throw std::invalid_argument("a quaternion is not of length 1");
  const mrpt::math::CQuaternionDouble unit(turn.w / norm, turn.x / norm, turn.y / norm,
                                           turn.z / norm);
  return {unit, x, y, z};
}

geometry_msgs::Quaternion quaternionOf(double heading)
{
  geometry_msgs::Quaternion turn;
  turn.w = std::cos(heading / 2);
  turn.z = std::sin(heading / 2);
  return turn;
}

diagnostic_msgs::KeyValue valueOf(const std::string& key, const std::string& value)
{
  diagnostic_msgs::KeyValue entry;
  entry.key = key;
  entry.value = value;
  return entry;
}
}  // namespace

FeatureMap mapOf(const nav_msgs::OccupancyGrid& message)
{
  detail::OccupancyGrid grid;
  grid.width = message.info.width;
  grid.height = message.info.height;
  grid.resolution = static_cast<double>(message.info.resolution);
  const auto& origin = message.info.origin;
  const auto pose = poseOf(origin.position.x, origin.position.y, 0, origin.orientation);
  grid.origin = mrpt::poses::CPose2D(pose).asTPose();
  grid.occupied.reserve(message.data.size());
  for (const std::int8_t cell : message.data)
  {
    if (cell < kUnknown || cell > kPercent)
    {
      throw std::invalid_argument(fmt::format("a cell of {}, not of -1 to 100", cell));
    }
    grid.occupied.push_back(cell == kUnknown ? std::numeric_limits<float>::quiet_NaN()
                                             : static_cast<float>(cell) / kPercent);
  }
  return buildMapFromRaster(detail::rasterOfOccupancy(grid));
}

LaserScan scanOf(const sensor_msgs::LaserScan& message, const mrpt::poses::CPose3D& base_from_laser)
{
  RangeReadings readings;
  readings.ranges = message.ranges;
  readings.first_angle = static_cast<double>(message.angle_min);
  readings.angle_step = static_cast<double>(message.angle_increment);
  readings.min_range = static_cast<double>(message.range_min);
  readings.max_range = static_cast<double>(message.range_max);
  readings.robot_from_sensor = base_from_laser;
  return toLaserScan(readings);
}

mrpt::poses::CPose3D poseOf(const geometry_msgs::Transform& transform)
{
  const auto& shift = transform.translation;
  return poseOf(shift.x, shift.y, shift.z, transform.rotation);
}

geometry_msgs::Transform transformOf(const mrpt::math::TPose2D& pose)
{
  geometry_msgs::Transform transform;
  transform.translation.x = pose.x;
  transform.translation.y = pose.y;
  transform.rotation = quaternionOf(pose.phi);
  return transform;
}

geometry_msgs::Pose poseMessageOf(const mrpt::math::TPose2D& pose)
{
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation = quaternionOf(pose.phi);
  return message;
}

geometry_msgs::PoseWithCovariance poseMessageOf(const GaussianPose& pose)
{
  constexpr std::size_t kRow = 6;  // x, y, z, roll, pitch, yaw
  constexpr std::size_t kPlanar[] = {0, 1, 5};
  geometry_msgs::PoseWithCovariance message;
  message.pose = poseMessageOf(pose.mean);
  for (std::size_t r = 0; r < 3; ++r)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      message.covariance[kPlanar[r] * kRow + kPlanar[c]] =
          pose.covariance(static_cast<int>(r), static_cast<int>(c));
    }
  }
  return message;
}

geometry_msgs::PoseArray hypothesesOf(const Belief& belief)
{
  geometry_msgs::PoseArray array;
  for (const TrackedHypothesis& hypothesis : belief.hypotheses)
  {
    array.poses.push_back(poseMessageOf(hypothesis.pose.mean));
  }
  return array;
}

diagnostic_msgs::DiagnosticStatus statusOf(const Belief& belief, const PolicyDecision& decision)
{
  using Status = diagnostic_msgs::DiagnosticStatus;
  Status status;
  status.name = kName;
  status.level = decision.alarm                       ? Status::ERROR
                 : decision.state == PoseState::known ? Status::OK
                                                      : Status::WARN;
  status.message = decision.message;
  status.values = {
      valueOf("verdict", toString(belief.verdict)),
      valueOf("probability of the first pose", probabilityText(belief.probabilityOfFirst(), 4)),
      valueOf("probability of elsewhere", fmt::format("{:.4f}", belief.elsewhere)),
      valueOf("hypotheses", std::to_string(belief.hypotheses.size())),
      valueOf("reason", belief.reason),
      valueOf("state", toString(decision.state)),
  };
  return status;
}

diagnostic_msgs::DiagnosticStatus statusOf(const std::string& error)
{
  diagnostic_msgs::DiagnosticStatus status;
  status.name = kName;
  status.level = diagnostic_msgs::DiagnosticStatus::ERROR;
  status.message = error;
  return status;
}
}  // namespace sigloc::ros1
