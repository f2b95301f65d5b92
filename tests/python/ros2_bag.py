# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a .db3 as rosbag2 does: its tables, its topics, and messages in CDR by the layouts of ROS 2."""
import contextlib
import math
import sqlite3
import struct


class Cdr:
    def __init__(self, order="<"):
        self.order = order
        self.body = b""

    def number(self, kind, value):
        size = struct.calcsize("=" + kind)
        self.body += bytes(-len(self.body) % size) + struct.pack(self.order + kind, value)
        return self

    def numbers(self, kind, values):
        for value in values:
            self.number(kind, value)
        return self

    def text(self, text):
        data = text.encode() + b"\0"
        self.number("I", len(data))
        self.body += data
        return self

    def header(self, time, frame):
        seconds = math.floor(time)
        return self.number("i", seconds).number("I", round((time - seconds) * 1e9)).text(frame)

    def pose(self, pose):
        x, y, heading = pose
        return self.numbers("d", [x, y, 0, 0, 0, math.sin(heading / 2), math.cos(heading / 2)])

    def data(self):
        return (b"\0\1\0\0" if self.order == "<" else b"\0\0\0\0") + self.body


def laser_scan(time, frame, scan, order="<"):
    message = Cdr(order).header(time, frame)
    last = scan.angle_min + (len(scan) - 1) * scan.angle_increment
    message.numbers("f", [scan.angle_min, last, scan.angle_increment, 0, 0.1, 0, scan.range_max])
    ranges = [float("inf") if r != r else float(r) for r in scan.ranges]
    message.number("I", len(ranges)).numbers("f", ranges)
    return message.number("I", 0).data()  # no intensities


def odometry(time, parent, child, pose, order="<"):
    message = Cdr(order).header(time, parent).text(child).pose(pose)
    return message.numbers("d", [0] * 36).numbers("d", [0] * 6).numbers("d", [0] * 36).data()


def transforms(time, parent, child, pose, order="<"):
    return Cdr(order).number("I", 1).header(time, parent).text(child).pose(pose).data()


def write(path, messages):
    """messages: (topic, type, time, data)."""
    with contextlib.closing(sqlite3.connect(path)) as database:
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                         "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")  # fmt: skip
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
                         "timestamp INTEGER NOT NULL, data BLOB NOT NULL)")  # fmt: skip
        ids = {}
        for topic, kind, time, data in messages:
            if topic not in ids:
                ids[topic] = len(ids) + 1
                row = (ids[topic], topic, kind, "cdr", "")
                database.execute("INSERT INTO topics VALUES (?, ?, ?, ?, ?)", row)
            row = (ids[topic], int(time * 1e9), data)
            database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", row)
        database.commit()
