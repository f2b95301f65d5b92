# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The node for ROS 2 with stand-ins for ROS: what it makes of messages, and what it publishes."""
import pathlib
import subprocess
import sys
from types import SimpleNamespace as Space

import numpy as np
import pytest

import sigloc
from sigloc import ros2_node

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRUTH = np.loadtxt(ROOT / "rawlogs/office-truth.txt")
STEPS = 60
OK, WARN, ERROR = b"\0", b"\1", b"\2"


class TransformException(Exception):
    pass


class Time:
    """A time of ROS, in nanoseconds. As a stamp it has seconds and nanoseconds."""

    def __init__(self, nanoseconds):
        self.nanoseconds = nanoseconds

    @staticmethod
    def from_msg(stamp):
        return Time(stamp.sec * 10**9 + stamp.nanosec)

    def to_msg(self):
        return Space(sec=self.nanoseconds // 10**9, nanosec=self.nanoseconds % 10**9)

    def __add__(self, duration):
        return Time(self.nanoseconds + duration.nanoseconds)


def stamp_of(seconds):
    return Time(round(seconds * 1e9)).to_msg()


def header():
    return Space(stamp=None, frame_id="")


def pose():
    return Space(position=Space(x=0.0, y=0.0, z=0.0), orientation=Space(x=0.0, y=0.0, z=0.0, w=1.0))


def transform():
    return Space(translation=Space(x=0.0, y=0.0, z=0.0), rotation=Space(x=0.0, y=0.0, z=0.0, w=1.0))


ROS = ros2_node.Ros(
    diagnostics=Space(
        DiagnosticArray=lambda: Space(header=header(), status=[]),
        DiagnosticStatus=lambda: Space(level=OK, name="", message="", values=[]),
        KeyValue=lambda: Space(key="", value=""),
    ),
    geometry=Space(
        Pose=pose,
        PoseArray=lambda: Space(header=header(), poses=[]),
        PoseWithCovarianceStamped=lambda: Space(header=header(), pose=Space(pose=pose(), covariance=[])),
        TransformStamped=lambda: Space(header=header(), child_frame_id="", transform=transform()),
    ),
    nav=Space(OccupancyGrid=None),
    sensor=Space(LaserScan=None),
    services=Space(Empty=None),
    qos=Space(
        QoSProfile=lambda **keys: keys,
        DurabilityPolicy=Space(TRANSIENT_LOCAL="latched"),
        qos_profile_sensor_data="sensor",
    ),
    time=Space(Time=Time),
    duration=Space(Duration=lambda seconds: Space(nanoseconds=round(seconds * 1e9))),
    tf2=Space(TransformException=TransformException),
)


class Robot:
    """The node's ROS: a node, the transforms, and all that was published."""

    def __init__(self, **parameters):
        self.parameters = parameters
        self.published = {}
        self.subscriptions, self.services, self.logged = {}, {}, []
        self.frames = {}  # (parent, child) -> pose; nothing tells time
        self.cleared = 0
        self.sent = []
        self.node = ros2_node.LocalizationNode(self, ROS, self, Space(sendTransform=self.sent.append))

    def has_parameter(self, key):
        return key in self.parameters

    def get_parameter(self, key):
        return Space(value=self.parameters[key])

    def get_parameters_by_prefix(self, prefix):
        begin = prefix + "."
        return {k[len(begin):]: Space(value=v) for k, v in self.parameters.items() if k.startswith(begin)}  # fmt: skip

    def create_publisher(self, _kind, topic, _depth):
        self.published[topic] = []
        return Space(publish=self.published[topic].append)

    def create_subscription(self, _kind, topic, callback, qos):
        self.subscriptions[topic] = callback, qos

    def create_service(self, _kind, name, callback):
        self.services[name] = callback

    def get_logger(self):
        log = lambda text, **_: self.logged.append(text)
        return Space(error=log, warning=log)

    def can_transform(self, target, source, _time):
        return (target, source) in self.frames

    def lookup_transform(self, target, source, _time, _patience):
        if not self.can_transform(target, source, None):
            raise TransformException(f"no transform from {source} to {target}")
        x, y, heading = self.frames[target, source]
        moved = transform()
        moved.translation.x, moved.translation.y = x, y
        moved.rotation.z, moved.rotation.w = np.sin(heading / 2), np.cos(heading / 2)
        return Space(transform=moved)

    def clear(self):
        self.cleared += 1

    def send(self, topic, message):
        self.subscriptions[topic][0](message)
        return self.published["diagnostics"][-1].status[0]

    def drive(self, steps=STEPS, shift=0.0):
        """Sends the office's log. Returns the statuses."""
        statuses = []
        odom = (3.0, -2.0, 1.0)
        for k, step in enumerate(sigloc.Log(ROOT / "rawlogs/office.rawlog")):
            if k == steps:
                break
            (scan,) = step.observations
            if step.motion is not None:
                odom = compose(odom, step.motion)
            self.frames["base_link", "laser"] = tuple(scan.pose)
            self.frames["odom", "base_link"] = odom
            statuses.append(self.send("scan", scan_message(scan, step.time + shift)))
        return statuses


def compose(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]


def scan_message(scan, seconds):
    return Space(
        header=Space(stamp=stamp_of(seconds), frame_id="laser"), angle_min=scan.angle_min,
        angle_increment=scan.angle_increment, range_min=0.0, range_max=scan.range_max,
        ranges=np.where(np.isfinite(scan.ranges), scan.ranges, np.inf).tolist(),
    )  # fmt: skip


def map_message():
    map_ = sigloc.Map.load(ROOT / "maps/office.gridmap.gz")
    origin = pose()
    origin.position.x, origin.position.y = map_.origin
    height, width = map_.grid.shape
    info = Space(resolution=map_.resolution, height=height, width=width, origin=origin)
    return Space(header=Space(stamp=stamp_of(1)), info=info, data=map_.grid.ravel().tolist())


def values(status):
    return {value.key: value.value for value in status.values}


def planar(message):
    turn = message.orientation
    return message.position.x, message.position.y, 2 * np.arctan2(turn.z, turn.w)


def assert_right(stamp, found, within=0.1):
    seconds = stamp.sec + 1e-9 * stamp.nanosec
    truth = TRUTH[np.argmin(abs(TRUTH[:, 0] - seconds))]
    assert np.hypot(found[0] - truth[1], found[1] - truth[2]) < within
    assert abs(np.angle(np.exp(1j * (found[2] - truth[3])))) < np.radians(2)


def test_finds_the_robot_and_says_so_once():
    robot = Robot()
    assert robot.subscriptions["map"][1] == {"depth": 1, "durability": "latched"}
    assert robot.subscriptions["scan"][1] == "sensor"
    robot.subscriptions["map"][0](map_message())
    statuses = robot.drive()
    states = [values(status)["state"] for status in statuses]
    known = states.index("known")
    assert [values(s)["verdict"] for s in statuses][known - 2 : known + 1] == ["localized"] * 3
    assert [s.level for s in statuses] == [OK if state == "known" else WARN for state in states]
    (first,) = robot.published["initialpose"]
    poses = robot.published["sigloc_pose"]
    assert len(poses) == states.count("known") and poses[0] is first
    assert first.header.frame_id == "map"
    for message in poses:
        assert_right(message.header.stamp, planar(message.pose.pose), within=0.15)
    covariance = np.array(first.pose.covariance).reshape(6, 6)
    assert (np.diag(covariance)[[0, 1, 5]] > 0).all() and (np.diag(covariance)[2:5] == 0).all()
    for array, status in zip(robot.published["hypotheses"], statuses):
        assert str(len(array.poses)) == values(status)["hypotheses"]
    assert not robot.sent, "who gives initialpose out leaves the transform to the filter"


def test_publishes_the_transform_only_while_the_pose_is_known():
    robot = Robot(map_file=str(ROOT / "maps/office.simplemap"), publish_tf=True, transform_tolerance=0.3)
    assert "map" not in robot.subscriptions
    statuses = robot.drive()
    assert len(robot.sent) == sum(values(s)["state"] == "known" for s in statuses) > 0
    assert not robot.published["initialpose"]
    last = robot.sent[-1]
    assert (last.header.frame_id, last.child_frame_id) == ("map", "odom")
    moved = last.transform
    map_from_odom = moved.translation.x, moved.translation.y, 2 * np.arctan2(moved.rotation.z, moved.rotation.w)
    seconds = last.header.stamp.sec + 1e-9 * last.header.stamp.nanosec - 0.3
    assert seconds == pytest.approx(TRUTH[STEPS - 1, 0], abs=0.01)
    assert_right(stamp_of(seconds), compose(map_from_odom, robot.frames["odom", "base_link"]), within=0.15)


def test_sets_a_filter_again_that_stays_away():
    robot = Robot(map_file=str(ROOT / "maps/office.simplemap"))
    robot.frames["map", "base_link"] = (50.0, 50.0, 0.0)
    robot.drive()
    assert len(robot.published["initialpose"]) > 1


def test_searches_anew_on_request():
    robot = Robot(map_file=str(ROOT / "maps/office.simplemap"))
    assert values(robot.drive()[-1])["state"] == "known"
    response = object()
    assert robot.services["global_localization"](None, response) is response
    again = robot.drive(shift=TRUTH[STEPS, 0] - TRUTH[0, 0])
    assert values(again[0])["state"] == "searching" and "asked for" in again[0].message


def test_time_that_goes_back_forgets_everything():
    robot = Robot(map_file=str(ROOT / "maps/office.simplemap"))
    robot.drive()
    again = robot.drive()
    assert robot.cleared == 1
    assert values(again[0])["state"] in ("searching", "confirming")
    assert values(again[-1])["state"] == "known"


def test_says_what_it_misses():
    robot = Robot()
    scan = next(sigloc.Log(ROOT / "rawlogs/office.rawlog")).observations[0]
    status = robot.send("scan", scan_message(scan, 5))
    assert (status.level, status.message) == (ERROR, "no map yet")
    bad = map_message()
    bad.data = [0] * len(bad.data)
    status = robot.send("map", bad)
    assert (status.level, status.message) == (ERROR, "map: the grid has no wall")
    robot.subscriptions["map"][0](map_message())
    status = robot.send("scan", scan_message(scan, 6))
    assert status.level == ERROR and "no transform from laser" in status.message
    robot.frames["base_link", "laser"] = robot.frames["odom", "base_link"] = (0.0, 0.0, 0.0)
    empty = scan_message(scan, 7)
    empty.ranges = []
    status = robot.send("scan", empty)
    assert status.level == ERROR and "at least two beams" in status.message
    robot.frames["base_link", "laser"] = (0.0, 0.0, np.nan)
    status = robot.send("scan", scan_message(scan, 8))
    assert status.level == ERROR and "scan left out" in status.message


@pytest.mark.parametrize(
    "parameters, reason",
    [
        ({"map_file": "/nowhere/a.yaml"}, "/nowhere/a.yaml: no such file"),
        ({"publish_tf": "often"}, "publish_tf is of another type"),
        ({"transform_tolerance": -1}, "transform_tolerance"),
        ({"policy.confirm_steps": 0}, "confirm_steps"),
        ({"policy.confirm_stebs": 3}, "did you mean 'confirm_steps'"),
        ({"map_file": str(ROOT / "maps/office.simplemap"), "tracker.suspicion": 7.0}, "suspicion"),
        ({"map_file": str(ROOT / "maps/office.simplemap"), "reading.hights": 7.0}, "reading.hights"),
    ],
)
def test_refuses_parameters_that_cannot_be_used(parameters, reason):
    with pytest.raises((OSError, ValueError, TypeError), match=reason):
        Robot(**parameters)


def test_says_that_ros_is_not_there():
    done = subprocess.run([sys.executable, "-m", "sigloc.ros2_node"], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "rclpy" in done.stderr and done.stderr.count("\n") == 1
