# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of ROS 1 and ROS 2 become rawlogs that are localized as the log they were made from."""
import bz2
import os
import pathlib
import struct
import subprocess
import sys

import numpy as np
import pytest
import ros2_bag

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOG = ROOT / "rawlogs/office.rawlog"
MOUNT = (0.2, -0.1, 0.3)  # of the laser, which is at the robot's origin in the log
SCAN, ODOMETRY, TRANSFORMS = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


def compose(a, b):
    c, s = np.cos(a[2]), np.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2])


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "sigloc.bag2rawlog", *map(str, arguments)],
                          capture_output=True, text=True, check=False)  # fmt: skip


def refused(*arguments):
    done = run(*arguments)
    assert done.returncode == 1 and done.stdout == "", done
    assert done.stderr.startswith("sigloc-bag2rawlog: ") and done.stderr.count("\n") == 1, done.stderr
    return done.stderr


@pytest.fixture(scope="module")
def drive():
    """The office's steps with the robot's pose by odometry at each."""
    pose, found = (3.0, -2.0, 1.0), []
    for k, step in enumerate(sigloc.Log(LOG)):
        pose = compose(pose, step.motion) if k else pose
        found.append((step.time, step.observations[0], pose, step))
    return found


def ros2_messages(drive, odometry=True, transform=True, order="<"):
    time = drive[0][0]
    # base_link -> tower -> laser; a robot's frames may begin with a slash.
    yield "/tf_static", TRANSFORMS, time, ros2_bag.transforms(time, "base_link", "tower", (0.2, -0.1, 0.0), order)
    yield "/tf_static", TRANSFORMS, time, ros2_bag.transforms(time, "/tower", "/laser", (0, 0, 0.3), order)
    yield "/chatter", "std_msgs/msg/String", time, ros2_bag.Cdr().text("hello").data()
    for time, scan, pose, _ in drive:
        if odometry:
            yield "/odom", ODOMETRY, time, ros2_bag.odometry(time, "odom", "base_link", pose, order)
        if transform:
            yield "/tf", TRANSFORMS, time, ros2_bag.transforms(time, "odom", "base_link", pose, order)
        yield "/scan", SCAN, time, ros2_bag.laser_scan(time, "laser", scan, order)


def assert_same_drive(path, drive, mount=MOUNT):
    steps = list(sigloc.Log(path))
    assert len(steps) == len(drive)
    for found, (time, scan, _, step) in zip(steps, drive):
        assert abs(found.time - time) < 1e-3
        (seen,) = found.observations
        returned = np.isfinite(scan.ranges) & (scan.ranges >= 0.1)
        assert np.array_equal(seen.ranges[returned], scan.ranges[returned])
        assert np.isnan(seen.ranges[~returned]).all()
        assert seen.angle_min + seen.pose[2] == pytest.approx(scan.angle_min + mount[2], abs=1e-5)
        assert seen.pose[:2] == pytest.approx(mount[:2], abs=1e-6)
        if found is not steps[0]:
            assert found.motion == pytest.approx(step.motion, abs=1e-5)


@pytest.mark.parametrize("how", [{}, {"transform": False}, {"odometry": False}, {"order": ">"}])
def test_a_db3_of_ros_2(drive, tmp_path, how):
    bag = tmp_path / "office.db3"
    ros2_bag.write(bag, ros2_messages(drive, **how))
    done = run(bag)
    assert (done.returncode, done.stderr) == (0, "")
    assert f"office.rawlog: {len(drive)} scans, {len(drive)} readings of odometry" in done.stdout
    assert_same_drive(tmp_path / "office.rawlog", drive)


def test_a_folder_of_ros_2_in_parts(drive, tmp_path):
    messages = list(ros2_messages(drive))
    bag = tmp_path / "office"
    bag.mkdir()
    (bag / "metadata.yaml").write_text("rosbag2_bagfile_information:\n")
    ros2_bag.write(bag / "office_0.db3", messages[:300])
    ros2_bag.write(bag / "office_1.db3", messages[300:])
    out = tmp_path / "out.rawlog"
    assert run(bag, "-o", out).returncode == 0
    assert_same_drive(out, drive)


def test_the_drive_is_localized_as_the_log_itself(drive, tmp_path):
    bag = tmp_path / "office.db3"
    scans = [(time, scan, pose, step) for time, scan, pose, step in drive]
    ros2_bag.write(bag, ros2_messages(scans))
    assert run(bag, "--mount", "0,0,0").returncode == 0
    tracker = sigloc.Tracker(sigloc.Localizer(sigloc.Map.load(ROOT / "maps/office.simplemap")))
    for step in sigloc.Log(tmp_path / "office.rawlog"):
        answer = tracker.step(step.observations, step.motion)
    truth = np.loadtxt(ROOT / "rawlogs/office-truth.txt")[-1]
    assert answer.verdict == sigloc.Verdict.LOCALIZED
    assert answer.hypotheses[0].pose[:2] == pytest.approx(truth[1:3], abs=0.1)


def test_messages_out_of_order_are_put_in_order(drive, tmp_path):
    bag = tmp_path / "office.db3"
    messages = list(ros2_messages(drive))
    mixed = messages[:3] + [m for pair in zip(messages[4::2], messages[3::2]) for m in pair] + messages[-1:]
    # rosbag2 keeps the time of arrival.
    start = drive[0][0]
    ros2_bag.write(bag, [(t, k, start + 1e-3 * n, d) for n, (t, k, _, d) in enumerate(mixed)])
    assert run(bag).returncode == 0
    times = [step.time for step in sigloc.Log(tmp_path / "office.rawlog")]
    assert times == sorted(times) and len(times) >= len(drive)


def test_options_choose_topics_and_frames(drive, tmp_path):
    bag = tmp_path / "office.db3"
    ros2_bag.write(bag, ros2_messages(drive))
    out = tmp_path / "out.rawlog"
    assert "odom" in run(bag, "-o", out, "--odom", "odom", "--scan", "scan").stdout
    assert_same_drive(out, drive)
    assert run(bag, "-o", out, "--base", "tower").returncode == 0
    (seen,) = next(sigloc.Log(out)).observations
    assert seen.pose == pytest.approx((0, 0, 0.3), abs=1e-6)
    assert "no LaserScan on back; there are: /scan" in refused(bag, "--scan", "back")
    assert "no transform from wheel to laser" in refused(bag, "--base", "wheel")
    assert "is the input" in refused(bag, "-o", bag)


def test_recordings_that_cannot_be_used(drive, tmp_path):
    bag = tmp_path / "a.db3"
    assert "no such file" in refused(bag)
    os.mkfifo(tmp_path / "pipe.bag")
    assert "is no regular file" in refused(tmp_path / "pipe.bag")
    bag.write_bytes(b"")
    refused(bag)
    bag.write_bytes(b"SQLite format 3\0 and then nothing that is one")
    assert "damaged" in refused(bag)
    bag.unlink()
    ros2_bag.write(bag, list(ros2_messages(drive[:3]))[:3])
    assert "no LaserScan in it; it holds String, TFMessage" in refused(bag)
    for name in ("a.bag", "a.mcap"):
        (tmp_path / name).write_bytes(b"%PDF-1.4\n")
    assert "not a bag of ROS 1" in refused(tmp_path / "a.bag")
    (tmp_path / "a.rawlog").write_bytes(b"no bag")
    assert "a rawlog is read as it is" in refused(tmp_path / "a.rawlog", "-o", tmp_path / "b.rawlog")
    (tmp_path / "a.rawlog").unlink()
    assert "ros2 bag convert" in refused(tmp_path / "a.mcap")
    (tmp_path / "folder").mkdir()
    assert "no .db3" in refused(tmp_path / "folder")
    bag.unlink()
    ros2_bag.write(bag, ros2_messages(drive[:3]))
    assert "cannot be written" in refused(bag, "-o", tmp_path / "nowhere" / "a.rawlog")
    assert not list(tmp_path.glob("*.rawlog*"))


def record(fields, data=b""):
    """A record of a bag of ROS 1."""
    header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def test_chunks_that_are_not_what_they_tell(tmp_path):
    bag = tmp_path / "a.bag"
    bomb = bz2.compress(bytes(50_000_000))
    for way, data in ((b"bz2", bomb), (b"bz2", b"nothing"), (b"bz2", bomb[:40]), (b"bz2", b""),
                      (b"lz4", b"nothing"), (b"lz4", b""), (b"zip", b"")):  # fmt: skip
        for size in (b"size=" + struct.pack("<I", 100), b"size=" + struct.pack("<I", 0xFFFFFFFF), b"size=1", b"other=1"):
            chunk = record([b"op=\5", b"compression=" + way, size], data)
            bag.write_bytes(b"#ROSBAG V2.0\n" + record([b"op=\3"]) + chunk)
            assert str(bag) in refused(bag)
    assert [path.name for path in tmp_path.iterdir()] == ["a.bag"]


@pytest.mark.parametrize("data", ["text", 10**12, 1.5])
def test_messages_that_are_not_of_bytes(drive, tmp_path, data):
    bag = tmp_path / "a.db3"
    messages = list(ros2_messages(drive[:3]))
    ros2_bag.write(bag, [*messages, ("/scan", SCAN, drive[3][0], data)])
    assert f"{bag}: damaged: a message is not of bytes" in refused(bag)


def test_names_of_files_are_no_addresses(drive, tmp_path):
    for name in ("a#1.db3", "a?b.db3", "a%20b.db3", "a b.db3"):
        ros2_bag.write(tmp_path / name, ros2_messages(drive[:3]))
        done = run(tmp_path / name)
        assert (done.returncode, done.stderr) == (0, ""), name


def test_a_transform_that_is_none_is_left_out(drive, tmp_path):
    bag = tmp_path / "a.db3"
    time = drive[0][0]
    turn = ros2_bag.Cdr().number("I", 1).header(time, "map").text("odom").numbers("d", [0] * 7).data()
    ros2_bag.write(bag, [("/tf", TRANSFORMS, time, turn), *ros2_messages(drive[:5])])
    done = run(bag)
    assert done.returncode == 0
    assert done.stderr == "sigloc-bag2rawlog: 1 messages left out: a pose is no number, or its quaternion not of length 1\n"


def test_without_a_scan_of_use_nothing_is_written(drive, tmp_path):
    bag = tmp_path / "a.db3"
    messages = [(topic, kind, time, data[:30] if topic == "/scan" else data)
                for topic, kind, time, data in ros2_messages(drive[:5])]  # fmt: skip
    ros2_bag.write(bag, messages)
    assert f"{bag}: no scan in it can be used: a message is cut off" in refused(bag)
    ros2_bag.write(tmp_path / "b.db3", ros2_messages(drive[:5]))
    assert "no scan in it can be used" in refused(tmp_path / "b.db3", "--mount", "nan,0,0")
    assert not list(tmp_path.glob("*.rawlog*"))


def test_wrong_use_is_told_in_one_line(tmp_path):
    assert "required: BAG" in refused()
    assert "--mount" in refused("a.bag", "--mount", "a,b")
    assert "--nonsense" in refused("a.bag", "--nonsense")


def test_messages_that_cannot_be_used_are_left_out(drive, tmp_path):
    bag = tmp_path / "a.db3"
    messages = list(ros2_messages(drive[:20]))
    for k in (-1, -4):
        topic, kind, time, data = messages[k]
        assert topic == "/scan"
        messages[k] = topic, kind, time, data[: len(data) // 2]
    ros2_bag.write(bag, messages)
    done = run(bag)
    assert done.returncode == 0
    assert done.stderr == "sigloc-bag2rawlog: 2 messages left out: a message is cut off\n"
    assert sum(1 for _ in sigloc.Log(tmp_path / "a.rawlog")) == 18


def test_a_scan_to_one_side_keeps_its_points(tmp_path):
    ranges = [1.0, 2.0, float("nan"), 3.0, 4.0]
    for begin, step in ((-0.3, 0.2), (1.0, -0.4)):
        scan = sigloc.Scan(ranges, begin, step, range_max=10, pose=(1, 2, 0.5))
        sigloc.write_log(tmp_path / "a.rawlog", [(1, scan, "laser")])
        (seen,) = next(sigloc.Log(tmp_path / "a.rawlog")).observations
        assert seen.points == pytest.approx(scan.points, abs=1e-5)
        assert np.array_equal(seen.ranges, scan.ranges, equal_nan=True)


def test_the_script_is_the_module(drive, tmp_path):
    bag = tmp_path / "a.db3"
    ros2_bag.write(bag, ros2_messages(drive[:5]))
    build = pathlib.Path(sigloc.__file__).parents[2]
    done = subprocess.run([ROOT / "scripts/bag2rawlog", bag], capture_output=True, text=True, check=False,
                          env={**os.environ, "SIGLOC_BUILD": str(build)})  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "") and "5 scans" in done.stdout


def test_write_log_refuses_what_is_no_entry(tmp_path):
    path = tmp_path / "a.rawlog"
    scan = sigloc.Scan([1.0, 2.0], 0, 0.1)
    for entry in [(float("nan"), scan, "a"), (-1, scan, "a"), (1, (0, 0), "a"), (1, (0, 0, float("inf")), "a")]:
        with pytest.raises(ValueError):
            sigloc.write_log(path, [(1, scan, "a"), entry])
    with pytest.raises((TypeError, RuntimeError)):
        sigloc.write_log(path, [(1, scan)])

    def entries():
        yield 1, scan, "a"
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        sigloc.write_log(path, entries())
    assert not list(tmp_path.iterdir())
    assert sigloc.write_log(path, [(1, scan, "a"), (2, (1, 2, 3), "b")]) == (1, 1)


def test_a_missing_numpy_is_told_at_once(tmp_path):
    (tmp_path / "numpy.py").write_text("raise ImportError(\"No module named 'numpy'\")\n")
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ['PYTHONPATH']}"}
    program = pathlib.Path(sigloc.__file__).parents[2] / "bin/sigloc-bag2rawlog"
    for command in ([program, "--help"], ["-c", "import sigloc; print('late')"]):
        done = subprocess.run([sys.executable, *command], capture_output=True, text=True, check=False,
                              env=environment)  # fmt: skip
        assert done.returncode == 1 and done.stdout == "", done
        told = done.stderr.splitlines()[-1]
        assert "sigloc needs numpy (Debian: python3-numpy)" in told
        if command[0] == program:
            assert done.stderr.count("\n") == 1, done.stderr


def test_out_is_the_same_as_output(tmp_path):
    for name in ("-o", "--out", "--output"):
        assert "no such file" in refused(tmp_path / "none.bag", name, tmp_path / "a.rawlog")


def test_a_probability_is_never_rounded_up():
    assert sigloc.probability_text(0.9896) == "0.989"
    assert sigloc.probability_text(0.99996, digits=4) == "0.9999"
