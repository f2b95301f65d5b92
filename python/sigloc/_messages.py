# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What recorded messages of ROS say: scans, odometry and transforms, in the form of ROS 1 and of ROS 2."""
from __future__ import annotations

import struct
from typing import Any, NamedTuple

import numpy
import numpy.typing

_Array = numpy.typing.NDArray[Any]


class Header(NamedTuple):
    time: float  # [s]
    frame: str


class LaserScan(NamedTuple):
    header: Header
    angle_min: float  # [rad]
    angle_increment: float  # [rad]
    range_min: float  # [m]
    range_max: float  # [m]
    ranges: _Array  # (N,) float32 [m]


class Transform(NamedTuple):
    header: Header  # its frame is the parent
    child: str
    matrix: _Array  # (4, 4), parent_from_child


class Fields:
    """Reads the fields of a message one after the other. Raises ValueError where it is cut off."""

    aligned = False  # numbers begin at a multiple of their size
    sequenced = True  # a header begins with a number
    terminated = False  # texts end with a zero

    def __init__(self, data: bytes, begin: int = 0, order: str = "<") -> None:
        self.data, self.begin, self.at, self.order = data, begin, begin, order

    def take(self, size: int, alignment: int) -> bytes:
        if self.aligned:
            self.at += -(self.at - self.begin) % alignment
        end = self.at + size
        if end > len(self.data):
            raise ValueError("a message is cut off")
        taken, self.at = self.data[self.at : end], end
        return taken

    def number(self, kind: str) -> Any:
        size = struct.calcsize(f"={kind}")
        return struct.unpack(self.order + kind, self.take(size, size))[0]

    def doubles(self, count: int) -> tuple[float, ...]:
        return tuple(self.number("d") for _ in range(count))

    def text(self) -> str:
        taken = self.take(self.number("I"), 1)
        return taken.rstrip(b"\0").decode("utf-8", "replace") if self.terminated else taken.decode("utf-8", "replace")

    def floats(self) -> _Array:
        count = self.number("I")
        return numpy.frombuffer(self.take(4 * count, 4), self.order + "f4").astype(numpy.float32)

    def time(self) -> float:
        seconds, nanoseconds = self.number("i" if self.aligned else "I"), self.number("I")
        return float(seconds) + 1e-9 * float(nanoseconds)

    def header(self) -> Header:
        if self.sequenced:
            self.number("I")
        return Header(self.time(), self.text())


class CdrFields(Fields):
    """The form of ROS 2: Common Data Representation."""

    aligned, sequenced, terminated = True, False, True

    def __init__(self, data: bytes) -> None:
        if len(data) < 4 or data[0] != 0 or data[1] > 1:
            raise ValueError("a message is not in plain CDR")
        super().__init__(data, begin=4, order="<" if data[1] == 1 else ">")


def matrix_of(position: tuple[float, ...], turn: tuple[float, ...]) -> _Array:
    """Returns the 4x4 matrix of a position [m] and a quaternion (x, y, z, w)."""
    norm = float(numpy.linalg.norm(turn))
    if not abs(norm - 1) < 0.01 or not numpy.isfinite(position).all():
        raise ValueError("a pose is no number, or its quaternion not of length 1")
    x, y, z, w = (value / norm for value in turn)
    matrix = numpy.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = position
    return matrix


def laser_scan(fields: Fields) -> LaserScan:
    header = fields.header()
    angle_min, _angle_max, angle_increment = (fields.number("f") for _ in range(3))
    _time_increment, _scan_time, range_min, range_max = (fields.number("f") for _ in range(4))
    return LaserScan(header, angle_min, angle_increment, range_min, range_max, fields.floats())


def odometry(fields: Fields) -> Transform:
    header = fields.header()
    child = fields.text()
    position = fields.doubles(3)
    return Transform(header, child, matrix_of(position, fields.doubles(4)))


def transforms(fields: Fields) -> list[Transform]:
    found = []
    for _ in range(fields.number("I")):
        header = fields.header()
        child = fields.text()
        position = fields.doubles(3)
        found.append(Transform(header, child, matrix_of(position, fields.doubles(4))))
    return found
