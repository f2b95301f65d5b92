// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Transform.h>
#include <mrpt/poses/CPose3D.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>

#include <string>

#include "localize/RelocalizationPolicy.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc::ros1
{
// Messages of ROS 1 from and to what the library takes and gives. Frames are left to the caller.

/// Throws std::invalid_argument with the reason for a grid or a scan that cannot be used.
FeatureMap mapOf(const nav_msgs::OccupancyGrid& message);
LaserScan scanOf(const sensor_msgs::LaserScan& message,
                 const mrpt::poses::CPose3D& base_from_laser);

mrpt::poses::CPose3D poseOf(const geometry_msgs::Transform& transform);
geometry_msgs::Transform transformOf(const mrpt::math::TPose2D& pose);
geometry_msgs::Pose poseMessageOf(const mrpt::math::TPose2D& pose);
geometry_msgs::PoseWithCovariance poseMessageOf(const GaussianPose& pose);

/// All hypotheses, the most probable first.
geometry_msgs::PoseArray hypothesesOf(const Belief& belief);

/// Verdict, probability, state and reason: OK while the pose is known, ERROR where it is given up.
diagnostic_msgs::DiagnosticStatus statusOf(const Belief& belief, const PolicyDecision& decision);

/// An error that keeps the node from its work.
diagnostic_msgs::DiagnosticStatus statusOf(const std::string& error);
}  // namespace sigloc::ros1
