# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the recordings of ROS, without ROS: bags of ROS 1, and the .db3 of rosbag2."""
from __future__ import annotations

import bz2
import contextlib
import io
import pathlib
import sqlite3
import struct
import urllib.parse
from collections.abc import Iterator
from typing import Any, NamedTuple

from ._messages import CdrFields, Fields

_MAGIC = b"#ROSBAG V2.0\n"
_MESSAGE, _CHUNK, _CONNECTION = 2, 5, 7  # kinds of records that matter here
_LARGEST = 1 << 30  # bytes of a record; no recorder writes such


class Recorded(NamedTuple):
    topic: str
    kind: str  # "LaserScan", "Odometry", "TFMessage" or another
    data: bytes
    is_cdr: bool

    def fields(self) -> Fields:
        return CdrFields(self.data) if self.is_cdr else Fields(self.data)


class CutOff(Exception):
    """The recording ends within a record: all before it is good."""


class Ros1Bag:
    """The messages of a bag of ROS 1, in the order in which they were recorded."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path = path
        self.connections: dict[int, tuple[str, str]] = {}
        with open(path, "rb") as file:
            if file.read(len(_MAGIC)) != _MAGIC:
                hint = "; a rawlog is read as it is" if path.suffix == ".rawlog" else ""
                raise OSError(f"{path}: not a bag of ROS 1 (version 2.0){hint}")

    def messages(self) -> Iterator[Recorded]:
        with open(self.path, "rb") as file:
            file.seek(len(_MAGIC))
            for fields, data in _records(file):
                if _kind_of(fields) != _CHUNK:
                    yield from self._take(fields, data)
                    continue
                for inner, inner_data in _records_of(self._decompressed(fields, data)):
                    yield from self._take(inner, inner_data)

    def _take(self, fields: dict[bytes, bytes], data: bytes) -> Iterator[Recorded]:
        kind = _kind_of(fields)
        if kind not in (_CONNECTION, _MESSAGE):
            return
        (connection,) = struct.unpack("<I", fields[b"conn"])
        if kind == _CONNECTION:
            described = dict(_fields_of(data))
            name = described[b"type"].decode().rpartition("/")[2]
            self.connections[connection] = fields[b"topic"].decode(), name
        else:
            topic, name = self.connections[connection]
            yield Recorded(topic, name, data, is_cdr=False)

    def _decompressed(self, fields: dict[bytes, bytes], data: bytes) -> bytes:
        way = fields[b"compression"]
        if way == b"none":
            return data
        (size,) = struct.unpack("<I", fields[b"size"])
        if size > _LARGEST:
            raise ValueError("a chunk is damaged")
        decompressor = self._decompressor(way)
        try:
            # No more than is told: a few bytes may stand for gigabytes.
            plain = decompressor.decompress(data, max_length=size + 1)
        except (OSError, RuntimeError, EOFError) as error:
            raise ValueError(f"a chunk is damaged: {error}") from error
        if len(plain) != size:
            raise ValueError("a chunk is damaged")
        return bytes(plain)

    def _decompressor(self, way: bytes) -> Any:
        if way == b"bz2":
            return bz2.BZ2Decompressor()
        if way != b"lz4":
            raise ValueError(f"compressed by {way.decode()}, which is not known")
        try:
            import lz4.frame  # type: ignore[import]
        except ImportError:
            raise OSError(f"{self.path}: compressed by lz4: install python3-lz4, or `rosbag decompress` it") from None
        return lz4.frame.LZ4FrameDecompressor()


def _kind_of(fields: dict[bytes, bytes]) -> int:
    return fields[b"op"][0]


def _fields_of(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = 0
    while at < len(data):
        (size,) = struct.unpack_from("<I", data, at)
        name, separator, value = data[at + 4 : at + 4 + size].partition(b"=")
        if not separator or at + 4 + size > len(data):
            raise ValueError("a record's header is damaged")
        yield name, value
        at += 4 + size


def _sized(file: io.BufferedReader) -> bytes:
    head = file.read(4)
    if len(head) < 4:
        raise CutOff
    (size,) = struct.unpack("<I", head)
    if size > _LARGEST:
        raise ValueError("a record is damaged")
    data = file.read(size)
    if len(data) < size:
        raise CutOff
    return data


def _records(file: io.BufferedReader) -> Iterator[tuple[dict[bytes, bytes], bytes]]:
    while file.peek(1):
        yield dict(_fields_of(_sized(file))), _sized(file)


def _records_of(data: bytes) -> Iterator[tuple[dict[bytes, bytes], bytes]]:
    at = 0
    while at < len(data):
        parts = []
        for _ in range(2):
            (size,) = struct.unpack_from("<I", data, at)
            parts.append(data[at + 4 : at + 4 + size])
            at += 4 + size
        if at > len(data):
            raise ValueError("a chunk is damaged")
        yield dict(_fields_of(parts[0])), parts[1]


class Ros2Bag:
    """The messages of a .db3, or of the .db3 files of a folder, in the order of time."""

    def __init__(self, path: pathlib.Path) -> None:
        self.files = sorted(path.glob("*.db3")) if path.is_dir() else [path]
        if not self.files:
            raise OSError(f"{path}: no .db3 in this folder{_other_recordings(path)}")

    def messages(self) -> Iterator[Recorded]:
        for file in self.files:
            address = f"file:{urllib.parse.quote(str(file))}?mode=ro"
            with contextlib.closing(sqlite3.connect(address, uri=True)) as database:
                topics = {
                    row[0]: (str(row[1]), str(row[2]).rpartition("/")[2])
                    for row in database.execute("SELECT id, name, type FROM topics")
                }
                rows: Any = database.execute("SELECT topic_id, data FROM messages ORDER BY timestamp, id")
                for topic_id, data in rows:
                    topic, kind = topics[topic_id]
                    if not isinstance(data, bytes):
                        raise ValueError("a message is not of bytes")
                    yield Recorded(topic, kind, data, is_cdr=True)


def _other_recordings(folder: pathlib.Path) -> str:
    if any(folder.glob("*.db3.zstd")):
        return "; decompress its .db3.zstd with zstd -d"
    return "; convert its .mcap with `ros2 bag convert`" if any(folder.glob("*.mcap")) else ""
