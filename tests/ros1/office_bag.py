# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The office's log as a ROS 1 bag, as a robot would have recorded it."""
import pathlib

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
ODOMETRY_STARTS_AT = (3.0, -2.0, 1.0)


def quaternion(heading):
    return Quaternion(0, 0, np.sin(heading / 2), np.cos(heading / 2))


def compose(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2])


def transform(parent, child, time, pose):
    message = TransformStamped()
    message.header.stamp = time
    message.header.frame_id = parent
    message.child_frame_id = child
    message.transform.translation.x, message.transform.translation.y = pose[:2]
    message.transform.rotation = quaternion(pose[2])
    return message


def map_message(map_):
    message = OccupancyGrid()
    message.header.frame_id = "map"
    message.info.resolution = map_.resolution
    message.info.height, message.info.width = map_.grid.shape
    message.info.origin.position.x, message.info.origin.position.y = map_.origin
    message.info.origin.orientation.w = 1
    message.data = map_.grid.ravel().tolist()
    return message


def scan_message(scan, time):
    message = LaserScan()
    message.header.stamp = time
    message.header.frame_id = "laser"
    message.angle_min = scan.angle_min
    message.angle_increment = scan.angle_increment
    message.angle_max = scan.angle_min + (len(scan) - 1) * scan.angle_increment
    message.range_max = scan.range_max
    message.ranges = np.where(np.isfinite(scan.ranges), scan.ranges, np.inf).tolist()
    return message


def odometry_messages(pose, time):
    odometry = Odometry()
    odometry.header.stamp = time
    odometry.header.frame_id = "odom"
    odometry.child_frame_id = "base_link"
    odometry.pose.pose.position.x, odometry.pose.pose.position.y = pose[:2]
    odometry.pose.pose.orientation = quaternion(pose[2])
    return odometry, TFMessage([transform("odom", "base_link", time, pose)])


def write(path, steps=None):
    """Writes a bag of the log's first steps: map, tf_static, tf, odom and scan."""
    odom_from_base = ODOMETRY_STARTS_AT
    with rosbag.Bag(str(path), "w") as bag:
        for k, step in enumerate(sigloc.Log(ROOT / "rawlogs/office.rawlog")):
            if k == steps:
                break
            time = rospy.Time.from_sec(step.time)
            (scan,) = step.observations
            if k == 0:
                static = transform("base_link", "laser", time, scan.pose)
                bag.write("/map", map_message(sigloc.Map.load(ROOT / "maps/office.gridmap.gz")), time)
                bag.write("/tf_static", TFMessage([static]), time)
            else:
                odom_from_base = compose(odom_from_base, step.motion)
            odometry, moved = odometry_messages(odom_from_base, time)
            bag.write("/tf", moved, time)
            bag.write("/odom", odometry, time)
            bag.write("/scan", scan_message(scan, time), time)
