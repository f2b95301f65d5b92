# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""A node for ROS 2 that finds a lost robot in its map, of rclpy and the module sigloc.

    python3 -m sigloc.ros2_node --ros-args -p map_file:=my_map.yaml -p base_frame:=base_link

Topics and parameters are in ros/README.md. Its handling of messages is tested with stand-ins for ROS;
it was never run on ROS 2 itself.
"""
from __future__ import annotations

import importlib
import sys
from typing import Any, NamedTuple

import sigloc

from . import _ros2
from ._ros2 import Outcome

_OPTIONS = ("reading", "tracker", "policy")  # parameters with a name of two parts
_QUIET = 5.0  # [s] between two lines on the same trouble


class Parameters(NamedTuple):
    """The parameters of the node."""

    map_file: str = ""  # empty: the topic `map`
    map_frame: str = "map"
    odom_frame: str = "odom"  # empty: no odometry
    base_frame: str = "base_link"
    publish_tf: bool = False  # the transform from map to odometry, else `initialpose`
    transform_tolerance: float = 0.5  # [s] that a transform is dated ahead, and waited for
    reading: dict[str, Any] = {}
    tracker: dict[str, Any] = {}
    policy: dict[str, Any] = {}


class Ros(NamedTuple):
    """What the node uses of ROS 2: modules, or what stands in for them."""

    diagnostics: Any  # diagnostic_msgs.msg
    geometry: Any  # geometry_msgs.msg
    nav: Any  # nav_msgs.msg
    sensor: Any  # sensor_msgs.msg
    services: Any  # std_srvs.srv
    qos: Any  # rclpy.qos
    time: Any  # rclpy.time
    duration: Any  # rclpy.duration
    tf2: Any  # tf2_ros


def parameters_of(node: Any) -> Parameters:
    """Reads them from a node that declares what it is given. Raises ValueError naming a wrong one."""
    values: dict[str, Any] = {}
    for key, default in Parameters._field_defaults.items():
        if key in _OPTIONS:
            values[key] = {name: p.value for name, p in node.get_parameters_by_prefix(key).items()}
        elif node.has_parameter(key):
            value = node.get_parameter(key).value
            if type(default) is float and type(value) is int:
                value = float(value)
            if type(value) is not type(default):
                raise ValueError(f"parameter {key} is of another type")
            values[key] = value
    parameters = Parameters(**values)
    if not 0 <= parameters.transform_tolerance <= 10:
        raise ValueError("parameter transform_tolerance is not within [0, 10] s")
    return parameters


def load_map(parameters: Parameters) -> sigloc.Map:
    """Reads the map that the parameters name. Raises OSError or ValueError with the reason."""
    reading = dict(parameters.reading)
    low, high = reading.pop("min_height", 0.2), reading.pop("max_height", 1.5)
    resolution = reading.pop("image_resolution", 0.0)
    if reading:
        raise ValueError(f"no such parameter: reading.{next(iter(reading))}")
    return sigloc.Map.load(parameters.map_file, resolution=resolution, heights=(low, high))


class LocalizationNode:
    """Subscribes, follows the robot and publishes, all in callbacks of one thread."""

    def __init__(self, node: Any, ros: Ros, transforms: Any, broadcaster: Any) -> None:
        """Raises OSError, ValueError or TypeError for parameters or a map that cannot be used."""
        self._node, self._ros = node, ros
        self._transforms, self._broadcaster = transforms, broadcaster
        self._parameters = parameters_of(node)
        self._follower = _ros2.Follower(self._parameters.tracker, self._parameters.policy)
        if self._parameters.map_file:
            self._follower.use_map(load_map(self._parameters))
        self._advertise()
        self._subscribe()

    def _advertise(self) -> None:
        pose, poses = self._ros.geometry.PoseWithCovarianceStamped, self._ros.geometry.PoseArray
        self._initial_pose = self._node.create_publisher(pose, "initialpose", 1)
        self._pose = self._node.create_publisher(pose, "sigloc_pose", 10)
        self._hypotheses = self._node.create_publisher(poses, "hypotheses", 10)
        self._diagnostics = self._node.create_publisher(self._ros.diagnostics.DiagnosticArray, "diagnostics", 10)

    def _subscribe(self) -> None:
        qos = self._ros.qos
        if not self._parameters.map_file:
            # As map servers publish it: once, for all who come later.
            latched = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
            self._node.create_subscription(self._ros.nav.OccupancyGrid, "map", self.take_map, latched)
        self._node.create_subscription(
            self._ros.sensor.LaserScan, "scan", self.take_scan, qos.qos_profile_sensor_data
        )
        self._node.create_service(self._ros.services.Empty, "global_localization", self.take_request)

    def take_map(self, message: Any) -> None:
        try:
            map_ = _ros2.map_of(message)
        except (ValueError, TypeError) as error:
            self._node.get_logger().error(f"map: {error}")
            self._publish_status(message.header.stamp, _ros2.failure(f"map: {error}"))
            return
        if map_.warning:
            self._node.get_logger().warning(f"map: {map_.warning}")
        self._follower.use_map(map_)

    def take_request(self, _request: Any, response: Any) -> Any:
        self._follower.request_restart()
        return response

    def take_scan(self, message: Any) -> None:
        stamp = message.header.stamp
        if not self._follower.has_map:
            self._publish_status(stamp, _ros2.failure("no map yet"))
            return
        time, last = _ros2.seconds(stamp), self._follower.time
        if time == last:
            return
        if last is not None and time < last:  # a recording that is played again
            self._node.get_logger().warning("time went back: everything before is forgotten")
            self._transforms.clear()
            self._follower.start_anew()
        try:
            self._localize(message, time)
        except (ValueError, TypeError, self._ros.tf2.TransformException) as error:
            reason = f"scan left out: {error}"
            self._node.get_logger().warning(reason, throttle_duration_sec=_QUIET)
            self._publish_status(stamp, _ros2.failure(reason))

    def _localize(self, message: Any, time: float) -> None:
        stamp, p = message.header.stamp, self._parameters
        scan = _ros2.scan_of(message, self._lookup(p.base_frame, message.header.frame_id, stamp))
        odom_from_base = None
        if p.odom_frame:
            odom_from_base = _ros2.planar(self._lookup(p.odom_frame, p.base_frame, stamp))
        outcome = self._follower.step(time, scan, odom_from_base, self._filter_pose(stamp))
        if outcome.level == _ros2.ERROR:
            self._node.get_logger().error(outcome.message, throttle_duration_sec=_QUIET)
        self._publish(stamp, outcome, odom_from_base)
        self._publish_status(stamp, outcome)

    def _lookup(self, target: str, source: str, stamp: Any) -> Any:
        patience = self._ros.duration.Duration(seconds=self._parameters.transform_tolerance)
        when = self._ros.time.Time.from_msg(stamp)
        found = self._transforms.lookup_transform(target, source, when, patience)
        return _ros2.matrix_of_transform(found.transform)

    def _filter_pose(self, stamp: Any) -> Any:
        """Where another node, such as AMCL, says that the robot is."""
        p = self._parameters
        when = self._ros.time.Time.from_msg(stamp)
        # With publish_tf the transform is our own.
        if p.publish_tf or not self._transforms.can_transform(p.map_frame, p.base_frame, when):
            return None
        return _ros2.planar(self._lookup(p.map_frame, p.base_frame, stamp))

    def _publish(self, stamp: Any, outcome: Outcome, odom_from_base: Any) -> None:
        hypotheses = self._ros.geometry.PoseArray()
        self._set_header(hypotheses, stamp)
        hypotheses.poses = [self._pose_message(pose) for pose in outcome.hypotheses]
        self._hypotheses.publish(hypotheses)
        if outcome.pose is None:
            return
        message = self._ros.geometry.PoseWithCovarianceStamped()
        self._set_header(message, stamp)
        message.pose.pose = self._pose_message(outcome.pose)
        message.pose.covariance = _covariance36(outcome.covariance)
        self._pose.publish(message)
        if not self._parameters.publish_tf:
            if outcome.announce:
                self._initial_pose.publish(message)
        elif odom_from_base is not None:
            map_from_odom = _ros2.compose(outcome.pose, _ros2.inverse(odom_from_base))
            self._broadcaster.sendTransform(self._transform_message(stamp, map_from_odom))

    def _set_header(self, message: Any, stamp: Any) -> None:
        message.header.stamp = stamp
        message.header.frame_id = self._parameters.map_frame

    def _pose_message(self, pose: Any) -> Any:
        message = self._ros.geometry.Pose()
        message.position.x, message.position.y = pose[:2]
        _set_heading(message.orientation, pose[2])
        return message

    def _transform_message(self, stamp: Any, pose: Any) -> Any:
        message = self._ros.geometry.TransformStamped()
        ahead = self._ros.duration.Duration(seconds=self._parameters.transform_tolerance)
        self._set_header(message, (self._ros.time.Time.from_msg(stamp) + ahead).to_msg())
        message.child_frame_id = self._parameters.odom_frame
        message.transform.translation.x, message.transform.translation.y = pose[:2]
        _set_heading(message.transform.rotation, pose[2])
        return message

    def _publish_status(self, stamp: Any, outcome: Outcome) -> None:
        status = self._ros.diagnostics.DiagnosticStatus()
        status.level = bytes([outcome.level])  # a field of type byte
        status.name, status.message = _ros2.NAME, outcome.message
        for key, value in outcome.values.items():
            entry = self._ros.diagnostics.KeyValue()
            entry.key, entry.value = key, value
            status.values.append(entry)
        message = self._ros.diagnostics.DiagnosticArray()
        message.header.stamp = stamp
        message.status = [status]
        self._diagnostics.publish(message)


def _set_heading(rotation: Any, heading: float) -> None:
    rotation.z, rotation.w = _ros2.half_turn(heading)


def _covariance36(covariance: Any) -> list[float]:
    """Returns the covariance of x, y, z, roll, pitch and yaw of that of x, y and heading."""
    flat = [0.0] * 36
    planar = (0, 1, 5)
    for r, row in enumerate(planar):
        for c, column in enumerate(planar):
            flat[6 * row + column] = float(covariance[r, c])
    return flat


def import_ros() -> Ros:
    """Raises ImportError where ROS 2 is not there."""
    names = (
        "diagnostic_msgs.msg", "geometry_msgs.msg", "nav_msgs.msg", "sensor_msgs.msg",
        "std_srvs.srv", "rclpy.qos", "rclpy.time", "rclpy.duration", "tf2_ros",
    )  # fmt: skip
    return Ros(*[importlib.import_module(name) for name in names])


def main() -> int:
    try:
        rclpy: Any = importlib.import_module("rclpy")
        ros = import_ros()
    except ImportError as error:
        print(f"sigloc: {error}; source the setup file of ROS 2 first", file=sys.stderr)
        return 1
    rclpy.init()
    try:
        node = rclpy.create_node("sigloc", automatically_declare_parameters_from_overrides=True)
        transforms = ros.tf2.Buffer()
        # A node and a thread of its own take transforms while a callback waits for one.
        listening = rclpy.create_node("sigloc_transforms")
        _listener = ros.tf2.TransformListener(transforms, listening, spin_thread=True)
        _localization = LocalizationNode(node, ros, transforms, ros.tf2.TransformBroadcaster(node))
        rclpy.spin(node)
    except (OSError, ValueError, TypeError) as error:
        print(f"sigloc: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        pass
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
