// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros1/LocalizationNode.h"

#include <mrpt/poses/CPose2D.h>

#include <stdexcept>
#include <utility>

#include "io/motion_conversion.h"
#include "ros1/messages.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/io/map_files.h"

namespace sigloc::ros1
{
using mrpt::math::TPose2D;

namespace
{
constexpr double kQuiet = 5.0;  // [s] between two lines on the same trouble

TPose2D planar(const mrpt::poses::CPose3D& pose)
{
  return mrpt::poses::CPose2D(pose).asTPose();
}
}  // namespace

LocalizationNode::LocalizationNode(const NodeParameters& parameters)
    : parameters_(parameters), policy_(parameters.policy), listener_(transforms_)
{
  if (!parameters_.map_file.empty())
    useMap(buildMapFromFile(parameters_.map_file, {}, {}, {}, parameters_.reading));
  initial_pose_ = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
  pose_ = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("sigloc_pose", 10);
  hypotheses_ = node_.advertise<geometry_msgs::PoseArray>("hypotheses", 10);
  diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 10);
  request_ = node_.advertiseService("global_localization", &LocalizationNode::takeRequest, this);
  if (parameters_.map_file.empty())
    map_ = node_.subscribe("map", 1, &LocalizationNode::takeMap, this);
  if (!parameters_.odom_topic.empty())
  {
    odometry_messages_ =
        node_.subscribe(parameters_.odom_topic, 100, &LocalizationNode::takeOdometry, this);
  }
  scan_ = node_.subscribe("scan", 1, &LocalizationNode::takeScan, this);
}

void LocalizationNode::useMap(FeatureMap map)
{
  const std::string warning = warningOfMap(map);
  if (!warning.empty()) ROS_WARN("map: %s", warning.c_str());
  matcher_ =
      std::make_shared<const SignatureMatcher>(std::make_shared<const FeatureMap>(std::move(map)));
  startAnew();
}

void LocalizationNode::startAnew()
{
  tracker_.reset();
  if (matcher_) tracker_.emplace(matcher_, parameters_.tracker);
  policy_ = RelocalizationPolicy(parameters_.policy);
  odometry_of_last_scan_ = std::nullopt;
  time_of_last_scan_ = ros::Time();
}

void LocalizationNode::takeMap(const nav_msgs::OccupancyGrid::ConstPtr& message)
{
  try
  {
    useMap(mapOf(*message));
  }
  catch (const std::exception& error)
  {
    ROS_ERROR("map: %s", error.what());
    publishStatus(message->header.stamp, statusOf(std::string("map: ") + error.what()));
  }
}

void LocalizationNode::takeOdometry(const nav_msgs::Odometry::ConstPtr& message)
{
  const auto& pose = message->pose.pose;
  geometry_msgs::Transform transform;
  transform.translation.x = pose.position.x;
  transform.translation.y = pose.position.y;
  transform.rotation = pose.orientation;
  try
  {
    odometry_.add(message->header.stamp.toSec(), planar(poseOf(transform)));
  }
  catch (const std::invalid_argument& error)
  {
    ROS_WARN_THROTTLE(kQuiet, "odometry left out: %s", error.what());
  }
}

bool LocalizationNode::takeRequest(std_srvs::Empty::Request&, std_srvs::Empty::Response&)
{
  policy_.requestRestart();
  return true;
}

void LocalizationNode::takeScan(const sensor_msgs::LaserScan::ConstPtr& message)
{
  const ros::Time& time = message->header.stamp;
  if (!tracker_)
  {
    publishStatus(time, statusOf("no map yet"));
    return;
  }
  if (time == time_of_last_scan_) return;
  if (time < time_of_last_scan_)  // a bag that is played again
  {
    ROS_WARN("time went back: everything before is forgotten");
    transforms_.clear();
    odometry_.clear();
    startAnew();
  }
  try
  {
    localize(*message);
  }
  catch (const std::exception& error)
  {
    // A transform that is not there, or a message that cannot be used.
    const std::string reason = std::string("scan left out: ") + error.what();
    ROS_WARN_THROTTLE(kQuiet, "%s", reason.c_str());
    publishStatus(time, statusOf(reason));
  }
}

void LocalizationNode::localize(const sensor_msgs::LaserScan& message)
{
  const ros::Time& time = message.header.stamp;
  const ros::Duration patience(parameters_.transform_tolerance);
  const auto base_from_laser =
      transforms_.lookupTransform(parameters_.base_frame, message.header.frame_id, time, patience);
  const ObservedScene scene = observeScene({scanOf(message, poseOf(base_from_laser.transform))});
  const std::optional<TPose2D> odom_from_base = odometryAt(time);

  PolicyStep step;
  step.time = time.toSec();
  const std::optional<MotionIncrement> motion = motionSinceLastScan(odom_from_base);
  if (motion) step.motion = motion->mean;
  step.belief = tracker_->step(motion, scene);
  step.filter_pose = filterPoseAt(time);
  step.localize_alone = [&] { return matcher_->localize(scene); };
  time_of_last_scan_ = time;
  const PolicyDecision decision = policy_.update(step);
  if (decision.restart) tracker_->reset();
  if (decision.alarm) ROS_ERROR_THROTTLE(kQuiet, "%s", decision.message.c_str());
  publish(time, decision, odom_from_base);
  publishStatus(time, statusOf(step.belief, decision));
}

std::optional<MotionIncrement> LocalizationNode::motionSinceLastScan(
    const std::optional<TPose2D>& odom_from_base)
{
  const std::optional<TPose2D> before = std::exchange(odometry_of_last_scan_, odom_from_base);
  if (!before || !odom_from_base) return std::nullopt;
  const mrpt::poses::CPose2D increment =
      mrpt::poses::CPose2D(*odom_from_base) - mrpt::poses::CPose2D(*before);
  return detail::toMotionIncrement(detail::motionFromOdometry(increment));
}

std::optional<TPose2D> LocalizationNode::odometryAt(const ros::Time& time)
{
  if (!parameters_.odom_topic.empty())
  {
    return odometry_.at(time.toSec(), parameters_.transform_tolerance);
  }
  if (parameters_.odom_frame.empty()) return std::nullopt;
  const ros::Duration patience(parameters_.transform_tolerance);
  const auto transform =
      transforms_.lookupTransform(parameters_.odom_frame, parameters_.base_frame, time, patience);
  return planar(poseOf(transform.transform));
}

/// Where another node, such as AMCL, says that the robot is.
std::optional<TPose2D> LocalizationNode::filterPoseAt(const ros::Time& time) const
{
  if (parameters_.publish_tf) return std::nullopt;  // then the transform is our own
  if (!transforms_.canTransform(parameters_.map_frame, parameters_.base_frame, time))
  {
    return std::nullopt;
  }
  return planar(poseOf(
      transforms_.lookupTransform(parameters_.map_frame, parameters_.base_frame, time).transform));
}

void LocalizationNode::publish(const ros::Time& time, const PolicyDecision& decision,
                               const std::optional<TPose2D>& odom_from_base)
{
  geometry_msgs::PoseArray hypotheses = hypothesesOf(tracker_->belief());
  hypotheses.header.stamp = time;
  hypotheses.header.frame_id = parameters_.map_frame;
  hypotheses_.publish(hypotheses);
  if (!decision.pose) return;

  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = hypotheses.header;
  pose.pose = poseMessageOf(*decision.pose);
  pose_.publish(pose);
  if (!parameters_.publish_tf)
  {
    if (decision.announce) initial_pose_.publish(pose);
    return;
  }
  if (!odom_from_base) return;
  geometry_msgs::TransformStamped map_from_odom;
  map_from_odom.header.stamp = time + ros::Duration(parameters_.transform_tolerance);
  map_from_odom.header.frame_id = parameters_.map_frame;
  map_from_odom.child_frame_id = parameters_.odom_frame;
  map_from_odom.transform = transformOf(decision.pose->mean + (TPose2D() - *odom_from_base));
  broadcaster_.sendTransform(map_from_odom);
}

void LocalizationNode::publishStatus(const ros::Time& time,
                                     const diagnostic_msgs::DiagnosticStatus& status)
{
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = time;
  message.status = {status};
  diagnostics_.publish(message);
}
}  // namespace sigloc::ros1
