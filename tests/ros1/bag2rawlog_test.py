# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Bags that ROS 1 itself has written become rawlogs."""
import subprocess
import sys

import numpy as np
import office_bag
import pytest
import rosbag

import sigloc

STEPS = 60


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "sigloc.bag2rawlog", *map(str, arguments)],
                          capture_output=True, text=True, check=False)  # fmt: skip


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "office.bag"
    office_bag.write(path, steps=STEPS)
    return path


def assert_is_the_office(path, steps=STEPS):
    found = list(sigloc.Log(path))
    assert len(found) == steps
    for step, original in zip(found, sigloc.Log(office_bag.ROOT / "rawlogs/office.rawlog")):
        (seen,), (scan,) = step.observations, original.observations
        assert np.array_equal(seen.ranges, scan.ranges, equal_nan=True)
        assert seen.pose == pytest.approx(scan.pose, abs=1e-6)
        assert seen.angle_min == pytest.approx(scan.angle_min, abs=1e-5)
        if step is not found[0]:
            assert step.motion == pytest.approx(original.motion, abs=1e-5)


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
@pytest.mark.parametrize("source", [[], ["--odom", "/odom"]])
def test_bags_of_each_compression(bag, tmp_path, compression, source):
    packed = tmp_path / "packed.bag"
    with rosbag.Bag(str(bag)) as given, rosbag.Bag(str(packed), "w", compression=compression) as out:
        for topic, message, time in given.read_messages():
            out.write(topic, message, time)
    done = run(packed, *source)
    assert (done.returncode, done.stderr) == (0, "")
    assert ("/odom" if source else "transform from odom to base_link") in done.stdout
    assert_is_the_office(tmp_path / "packed.rawlog")


def test_a_bag_that_is_cut_off(bag, tmp_path):
    cut = tmp_path / "cut.bag"
    # A chunk is whole or not there. A long recording has many, and the map is in the first.
    with rosbag.Bag(str(bag)) as given, rosbag.Bag(str(cut), "w", chunk_threshold=10000) as out:
        for topic, message, time in given.read_messages():
            out.write(topic, message, time)
    cut.write_bytes(cut.read_bytes()[: cut.stat().st_size * 4 // 5])
    done = run(cut)
    assert done.returncode == 2
    assert done.stderr == f"sigloc-bag2rawlog: {cut}: cut off; all before is converted\n"
    steps = sum(1 for _ in sigloc.Log(tmp_path / "cut.rawlog"))
    assert 10 < steps < STEPS
    assert_is_the_office(tmp_path / "cut.rawlog", steps)


def test_bags_with_changed_bytes_never_end_in_a_traceback(bag, tmp_path):
    good = bag.read_bytes()
    random = np.random.default_rng(3)
    codes = set()
    for k in range(25):
        spoilt = bytearray(good)
        # Headers are the weak places: most changes go there.
        begin = len(good) * 9 // 10 if k % 2 else 13
        for at in random.integers(begin, min(len(good), begin + 20000), 20):
            spoilt[at] = random.integers(256)
        path = tmp_path / f"{k}.bag"
        path.write_bytes(spoilt)
        done = run(path)
        codes.add(done.returncode)
        assert done.returncode in (0, 1, 2) and "Traceback" not in done.stderr, done.stderr
        assert done.stderr.count("\n") <= 2
        if done.returncode == 1:
            assert not path.with_suffix(".rawlog").exists()
    assert 1 in codes
