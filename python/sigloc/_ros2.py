# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the node for ROS 2 does with messages. It imports nothing of ROS: any object with the fields will do."""
from __future__ import annotations

import math
from typing import Any, NamedTuple, Optional

import numpy
import numpy.typing

import sigloc

from ._messages import matrix_of

_Array = numpy.typing.NDArray[Any]
_Pose = tuple[float, float, float]

OK, WARN, ERROR = 0, 1, 2  # as diagnostic_msgs/DiagnosticStatus numbers them
NAME = "sigloc: localization"


class Outcome(NamedTuple):
    """What there is to publish after a scan."""

    level: int  # OK, WARN or ERROR
    message: str  # one line for people
    values: dict[str, str]  # for the diagnostics
    hypotheses: list[_Pose]  # the most probable first
    pose: Optional[_Pose] = None  # of the robot in the map; only while it is known
    covariance: Optional[_Array] = None  # (3, 3), of the pose
    announce: bool = False  # the pose is to be given to the filter


def failure(message: str) -> Outcome:
    return Outcome(ERROR, message, {}, [])


def seconds(stamp: Any) -> float:
    return float(stamp.sec) + 1e-9 * float(stamp.nanosec)


def matrix_of_transform(transform: Any) -> _Array:
    """Returns the 4x4 matrix of a geometry_msgs/Transform. Raises ValueError for one that is none."""
    shift, turn = transform.translation, transform.rotation
    return matrix_of((shift.x, shift.y, shift.z), (turn.x, turn.y, turn.z, turn.w))


def planar(matrix: _Array) -> _Pose:
    return float(matrix[0, 3]), float(matrix[1, 3]), math.atan2(matrix[1, 0], matrix[0, 0])


def pose6(matrix: _Array) -> tuple[float, ...]:
    """Returns x, y, z, yaw, pitch and roll of a 4x4 matrix [m, rad]."""
    pitch = math.atan2(-matrix[2, 0], math.hypot(matrix[0, 0], matrix[1, 0]))
    roll = math.atan2(matrix[2, 1], matrix[2, 2])
    x, y, z = (float(value) for value in matrix[:3, 3])
    return x, y, z, planar(matrix)[2], pitch, roll


def compose(a: _Pose, b: _Pose) -> _Pose:
    c, s = math.cos(a[2]), math.sin(a[2])
    heading = math.remainder(a[2] + b[2], 2 * math.pi)
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], heading


def inverse(a: _Pose) -> _Pose:
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]


def half_turn(heading: float) -> tuple[float, float]:
    """Returns z and w of the quaternion of a heading."""
    return math.sin(heading / 2), math.cos(heading / 2)


def map_of(message: Any) -> sigloc.Map:
    """Builds the map of a nav_msgs/OccupancyGrid. Raises ValueError with the reason."""
    info = message.info
    cells = numpy.asarray(message.data, numpy.int8).reshape(info.height, info.width)
    at, turn = info.origin.position, info.origin.orientation
    origin = planar(matrix_of((at.x, at.y, 0.0), (turn.x, turn.y, turn.z, turn.w)))
    return sigloc.Map.from_grid(cells, info.resolution, origin)


def scan_of(message: Any, base_from_laser: _Array) -> sigloc.Scan:
    """Returns the scan of a sensor_msgs/LaserScan. Raises ValueError with the reason."""
    return sigloc.Scan(
        message.ranges, message.angle_min, message.angle_increment, range_min=message.range_min,
        range_max=message.range_max, pose=pose6(base_from_laser),
    )  # fmt: skip


class Follower:
    """Follows the robot from scan to scan, and decides what of it may be used."""

    def __init__(self, tracker: dict[str, Any], policy: dict[str, Any]) -> None:
        self._options = tracker, policy
        self._localizer: Optional[sigloc.Localizer] = None
        self.time: Optional[float] = None  # of the last scan [s]
        self.start_anew()

    def use_map(self, map_: sigloc.Map) -> None:
        self._localizer = sigloc.Localizer(map_)
        self.start_anew()

    def start_anew(self) -> None:
        """Forgets all scans. Raises ValueError or TypeError for options that cannot be used."""
        tracker, policy = self._options
        if self._localizer is not None:
            self._tracker = sigloc.Tracker(self._localizer, **tracker)
        self._policy = sigloc.Policy(**policy)
        self._odom_from_base: Optional[_Pose] = None
        self.time = None

    @property
    def has_map(self) -> bool:
        return self._localizer is not None

    def request_restart(self) -> None:
        self._policy.request_restart()

    def step(
        self, time: float, scan: sigloc.Scan, odom_from_base: Optional[_Pose], filter_pose: Optional[_Pose]
    ) -> Outcome:
        """Takes a scan at a time [s] that is not before the last. There must be a map."""
        localizer: Any = self._localizer
        assert localizer is not None

        def alone() -> sigloc.Answer:
            return localizer.localize(scan)

        before = self._odom_from_base
        motion = compose(inverse(before), odom_from_base) if before and odom_from_base else None
        answer = self._tracker.step(scan, motion)
        self._odom_from_base, self.time = odom_from_base, time
        decision = self._policy.update(time, answer, motion, filter_pose, alone)
        if decision.restart:
            self._tracker.reset()
        return _outcome(answer, decision)


def _outcome(answer: sigloc.Answer, decision: sigloc.Decision) -> Outcome:
    first = answer.hypotheses[0].probability if answer.hypotheses else 0.0
    values = {
        "verdict": str(answer.verdict),
        "probability of the first pose": sigloc.probability_text(first, 4),
        "probability of elsewhere": f"{answer.elsewhere:.4f}",
        "hypotheses": str(len(answer.hypotheses)),
        "reason": answer.reason,
        "state": decision.state,
    }
    level = ERROR if decision.alarm else OK if decision.state == "known" else WARN
    poses = [(float(x), float(y), float(heading)) for x, y, heading in answer.poses]
    known = decision.pose
    pose = None if known is None else (float(known[0]), float(known[1]), float(known[2]))
    return Outcome(level, decision.message, values, poses, pose, decision.covariance, decision.announce)
