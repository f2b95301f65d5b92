// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <optional>
#include <string>

#include "localize/RelocalizationPolicy.h"
#include "ros1/OdometryTrack.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc::ros1
{
/// The parameters of the node, in its private namespace.
struct NodeParameters
{
  std::string map_file;  ///< empty: the topic `map`
  ReadingOptions reading;  ///< reading/KEY, of map_file
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  std::string odom_topic;  ///< empty: odometry is the transform from odom_frame to base_frame
  bool publish_tf = false;  ///< the transform from map_frame to odom_frame, else `initialpose`
  double transform_tolerance = 0.5;  ///< [s] that a transform is dated ahead, and waited for
  TrackerOptions tracker;  ///< tracker/KEY
  RelocalizationPolicyOptions policy;  ///< policy/KEY
};

/// Reads all of them. Throws std::invalid_argument naming what is of another type or out of range.
NodeParameters readParameters(const ros::NodeHandle& parameters);

/// Returns a line for each parameter, as it is typed with its default, and what it is for.
std::string describeParameters();

/// Finds the robot in the map of a robot with ROS 1, and follows it. What it subscribes to and
/// publishes is in ros/README.md. Everything runs in the callbacks of one thread.
class LocalizationNode
{
 public:
  /// Throws std::runtime_error or std::invalid_argument, with the reason, for parameters or a map
  /// file that cannot be used.
  explicit LocalizationNode(const NodeParameters& parameters);

 private:
  void takeMap(const nav_msgs::OccupancyGrid::ConstPtr& message);
  void takeOdometry(const nav_msgs::Odometry::ConstPtr& message);
  void takeScan(const sensor_msgs::LaserScan::ConstPtr& message);
  bool takeRequest(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  void useMap(FeatureMap map);
  void startAnew();
  void localize(const sensor_msgs::LaserScan& message);
  std::optional<MotionIncrement> motionSinceLastScan(
      const std::optional<mrpt::math::TPose2D>& odom_from_base);
  std::optional<mrpt::math::TPose2D> odometryAt(const ros::Time& time);
  std::optional<mrpt::math::TPose2D> filterPoseAt(const ros::Time& time) const;
  void publish(const ros::Time& time, const PolicyDecision& decision,
               const std::optional<mrpt::math::TPose2D>& odom_from_base);
  void publishStatus(const ros::Time& time, const diagnostic_msgs::DiagnosticStatus& status);

  NodeParameters parameters_;
  std::shared_ptr<const SignatureMatcher> matcher_;
  std::optional<HypothesisTracker> tracker_;
  RelocalizationPolicy policy_;
  OdometryTrack odometry_;
  std::optional<mrpt::math::TPose2D> odometry_of_last_scan_;
  ros::Time time_of_last_scan_;

  ros::NodeHandle node_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher initial_pose_, pose_, hypotheses_, diagnostics_;
  ros::Subscriber map_, scan_, odometry_messages_;
  ros::ServiceServer request_;
};
}  // namespace sigloc::ros1
