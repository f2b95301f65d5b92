# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Turns a recording of ROS 1 (.bag) or ROS 2 (.db3, or its folder) into a rawlog. ROS is not needed.

    sigloc-bag2rawlog BAG [-o OUT.rawlog]

All laser scans and the odometry go into it: that of nav_msgs/Odometry, else of the transform from the frame odom.
Where a laser is on the robot is what the transforms say. The messages' own times count.
"""
from __future__ import annotations

import argparse
import contextlib
import heapq
import itertools
import math
import pathlib
import sqlite3
import struct
import sys
from collections.abc import Iterator
from typing import NamedTuple, Optional, Union

import numpy
import numpy.typing

import sigloc

from . import _messages
from ._bags import CutOff, Recorded, Ros1Bag, Ros2Bag
from ._manual import Parser

_Pose = tuple[float, float, float]
_Pose6 = tuple[float, float, float, float, float, float]
_Entry = tuple[float, Union[sigloc.Scan, _Pose], str]
_PROGRAM = "sigloc-bag2rawlog"
_REORDERED = 1000  # entries: recorders mix up messages of some moments


class Wanted(NamedTuple):
    """What is taken of a recording."""

    scans: list[str]  # topics; empty: all
    odometry: Optional[str]  # topic; None: the transform
    odom_frame: str
    base: str  # frame of the robot
    mount: Optional[_Pose]  # of every laser, where the transforms need not be asked


def open_bag(path: pathlib.Path) -> Union[Ros1Bag, Ros2Bag]:
    if not path.exists():
        raise OSError(f"{path}: no such file")
    if not path.is_dir() and not path.is_file():
        raise OSError(f"{path}: is no regular file")
    if path.is_dir() or path.suffix == ".db3":
        return Ros2Bag(path)
    if path.suffix == ".mcap":
        raise OSError(f"{path}: an .mcap is not read; `ros2 bag convert` makes a .db3 of it")
    return Ros1Bag(path)


def messages_of(path: pathlib.Path) -> Iterator[Recorded]:
    """Yields the messages of a recording. Its damage is told as an OSError that names it."""
    try:
        yield from open_bag(path).messages()
    except CutOff:
        raise
    except (ValueError, KeyError, IndexError, struct.error, EOFError, UnicodeError, sqlite3.Error) as error:
        raise OSError(f"{path}: damaged: {error}") from error


class Survey:
    """What there is in a recording, and how its frames hang together."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path = path
        self.kinds: dict[str, str] = {}
        self.children: dict[str, str] = {}  # of odometry topics
        self.parents: dict[str, tuple[str, numpy.typing.NDArray[numpy.float64]]] = {}
        self.cut_off = False
        try:
            for message in messages_of(path):
                with contextlib.suppress(ValueError):  # told of when it is converted
                    self._note(message)
        except CutOff:
            self.cut_off = True

    def _note(self, message: Recorded) -> None:
        self.kinds.setdefault(message.topic, message.kind)
        if message.kind == "TFMessage":
            for transform in _messages.transforms(message.fields()):
                # The first will do: what moves is not between a robot and its lasers.
                self.parents.setdefault(transform.child.lstrip("/"),
                                        (transform.header.frame.lstrip("/"), transform.matrix))  # fmt: skip
        elif message.kind == "Odometry" and message.topic not in self.children:
            self.children[message.topic] = _messages.odometry(message.fields()).child.lstrip("/")

    def topics(self, kind: str) -> list[str]:
        return [topic for topic, its in self.kinds.items() if its == kind]

    def topic(self, name: str, kind: str) -> str:
        """Returns the topic of this name, with or without its slash."""
        for topic in self.topics(kind):
            if topic.lstrip("/") == name.lstrip("/"):
                return topic
        there = ", ".join(self.topics(kind)) or "none"
        raise OSError(f"{self.path}: no {kind} on {name}; there are: {there}")

    def mount(self, base: str, frame: str) -> _Pose6:
        """Returns (x, y, z, yaw, pitch, roll) of a frame on the robot."""
        chain = numpy.eye(4)
        at, seen = frame, {frame}
        while at != base:
            if at not in self.parents:
                raise OSError(f"{self.path}: no transform from {base} to {frame}; "
                              "--base names another frame, --mount X,Y,DEG the pose")  # fmt: skip
            at, matrix = self.parents[at]
            if at in seen:
                raise OSError(f"{self.path}: the frame {at} is its own parent")
            seen.add(at)
            chain = matrix @ chain
        pitch = math.atan2(-chain[2, 0], math.hypot(chain[0, 0], chain[1, 0]))
        roll = math.atan2(chain[2, 1], chain[2, 2])
        return (chain[0, 3], chain[1, 3], chain[2, 3], heading_of(chain), pitch, roll)


def heading_of(matrix: numpy.typing.NDArray[numpy.float64]) -> float:
    return math.atan2(matrix[1, 0], matrix[0, 0])


class Conversion:
    """Turns messages into the entries of a rawlog."""

    def __init__(self, survey: Survey, wanted: Wanted) -> None:
        self.survey, self.wanted = survey, wanted
        self.mounts: dict[str, _Pose6] = {}
        self.scans = 0
        self.left_out = 0
        self.reason = ""

    def entries(self) -> Iterator[_Entry]:
        """Yields them in the order of their own times, as far as the recorder kept that. Raises OSError where no scan
        can be used."""
        heap: list[tuple[float, int, _Entry]] = []
        counter = itertools.count()
        try:
            for message in messages_of(self.survey.path):
                for entry in self._entries_of(message):
                    heapq.heappush(heap, (entry[0], next(counter), entry))
                    if len(heap) > _REORDERED:
                        yield heapq.heappop(heap)[2]
        except CutOff:
            pass  # the survey has noted it
        while heap:
            yield heapq.heappop(heap)[2]
        if self.scans == 0:
            raise OSError(f"{self.survey.path}: no scan in it can be used: {self.reason or 'it is cut off before'}")

    def _entries_of(self, message: Recorded) -> Iterator[_Entry]:
        topic = message.topic
        try:
            if message.kind == "LaserScan" and (not self.wanted.scans or topic in self.wanted.scans):
                yield self._scan(topic, _messages.laser_scan(message.fields()))
            elif message.kind == "Odometry" and topic == self.wanted.odometry:
                yield self._odometry(_messages.odometry(message.fields()), topic)
            elif message.kind == "TFMessage" and self.wanted.odometry is None:
                for transform in _messages.transforms(message.fields()):
                    frames = transform.header.frame.lstrip("/"), transform.child.lstrip("/")
                    if frames == (self.wanted.odom_frame, self.wanted.base):
                        yield self._odometry(transform, topic)
        except ValueError as error:
            self.left_out += 1
            self.reason = self.reason or str(error)

    def _scan(self, topic: str, scan: _messages.LaserScan) -> _Entry:
        frame = scan.header.frame.lstrip("/")
        if frame not in self.mounts:
            if self.wanted.mount:
                x, y, heading = self.wanted.mount
                self.mounts[frame] = (x, y, 0, heading, 0, 0)
            else:
                self.mounts[frame] = self.survey.mount(self.wanted.base, frame)
        seen = sigloc.Scan(scan.ranges, scan.angle_min, scan.angle_increment, range_min=scan.range_min,
                           range_max=scan.range_max, pose=self.mounts[frame])  # fmt: skip
        self.scans += 1
        return scan.header.time, seen, topic.lstrip("/")

    def _odometry(self, transform: _messages.Transform, topic: str) -> _Entry:
        matrix = transform.matrix
        return transform.header.time, (matrix[0, 3], matrix[1, 3], heading_of(matrix)), topic.lstrip("/")


def choose(survey: Survey, arguments: argparse.Namespace) -> Wanted:
    """Fills in what the command line leaves open."""
    scans = [survey.topic(name, "LaserScan") for name in arguments.scan]
    if not survey.topics("LaserScan"):
        kinds = ", ".join(sorted(set(survey.kinds.values()))) or "nothing"
        raise OSError(f"{survey.path}: no LaserScan in it; it holds {kinds}")
    odometry = survey.topic(arguments.odom, "Odometry") if arguments.odom else None
    moved = [child for child, (parent, _) in survey.parents.items() if parent == arguments.odom_frame]
    if odometry is None and not moved and survey.topics("Odometry"):
        odometry = survey.topics("Odometry")[0]
    base = arguments.base or (survey.children.get(odometry, "") if odometry else "")
    return Wanted(scans, odometry, arguments.odom_frame, base or (moved or ["base_link"])[0], arguments.mount)


def pose_of(text: str) -> _Pose:
    x, y, degrees = (float(word) for word in text.split(","))
    return x, y, math.radians(degrees)


def make_parser() -> Parser:
    parser = Parser(prog=_PROGRAM, description=(__doc__ or "").splitlines()[0])
    parser.add_argument("bag", type=pathlib.Path, metavar="BAG", help="the recording")
    parser.add_argument("-o", "--out", "--output", dest="output", type=pathlib.Path, metavar="RAWLOG",
                        help="the rawlog; default: the bag's name with .rawlog")  # fmt: skip
    parser.add_argument("--scan", action="append", default=[], metavar="TOPIC",
                        help="a LaserScan to take, may be repeated; default: every one")  # fmt: skip
    parser.add_argument("--odom", metavar="TOPIC", help="nav_msgs/Odometry to use instead of the transform")
    parser.add_argument("--odom-frame", default="odom", metavar="FRAME", help="the odometry's frame; default: odom")
    parser.add_argument("--base", metavar="FRAME", help="the robot's frame; default: the one that odometry moves")
    parser.add_argument("--mount", type=pose_of, metavar="X,Y,DEG",
                        help="where the laser is on the robot; default: what the transforms say")  # fmt: skip
    return parser


def convert(arguments: argparse.Namespace) -> int:
    output = arguments.output or arguments.bag.with_suffix(".rawlog")
    if output.exists() and arguments.bag.exists() and output.samefile(arguments.bag):
        raise OSError(f"{output}: is the input")
    survey = Survey(arguments.bag)
    wanted = choose(survey, arguments)
    conversion = Conversion(survey, wanted)
    scans, readings = sigloc.write_log(output, conversion.entries())
    source = wanted.odometry or f"transform from {wanted.odom_frame} to {wanted.base}"
    print(f"{output}: {scans} scans, {readings} readings of odometry ({source})")
    if conversion.left_out:
        print(f"{_PROGRAM}: {conversion.left_out} messages left out: {conversion.reason}", file=sys.stderr)
    if survey.cut_off:
        print(f"{_PROGRAM}: {arguments.bag}: cut off; all before is converted", file=sys.stderr)
    return 2 if survey.cut_off else 0


def main(words: Optional[list[str]] = None) -> int:
    try:
        parser = make_parser()
        if printed := parser.printed(words):
            print(printed, end="")
            return 0
        return convert(parser.parse_args(words))
    except (OSError, ValueError) as error:
        print(f"{_PROGRAM}: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
