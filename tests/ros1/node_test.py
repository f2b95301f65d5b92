# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The node for ROS 1 with a real roscore: the office's bag is played, message by message."""
import os
import pathlib
import queue
import signal
import socket
import subprocess
import time

import numpy as np
import office_bag
import pytest
import rosbag
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

import sigloc

NODE = os.environ["SIGLOC_ROS1_NODE"]
TRUTH = np.loadtxt(office_bag.ROOT / "rawlogs/office-truth.txt")
PATIENCE = 120  # [s], for a busy machine; nothing waits that long otherwise
TOLERANCE = 10.0  # [s], the most that a node takes: it waits so long for a transform, for a busy machine too
TYPES = {"/map": OccupancyGrid, "/tf_static": TFMessage, "/tf": TFMessage, "/odom": Odometry, "/scan": LaserScan}
WARN, ERROR = 1, 2


def eventually(condition, what):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"waited in vain for {what}"
        time.sleep(0.02)


def start_roscore():
    """Starts a roscore on a port that is free, which is then ROS_MASTER_URI."""
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"
    return subprocess.Popen(["roscore", "-p", str(port)], stdout=subprocess.DEVNULL)


@pytest.fixture(scope="session")
def master(tmp_path_factory):
    """A roscore of our own, in which this process is a node."""
    os.environ["ROS_HOSTNAME"] = "localhost"
    os.environ["ROS_HOME"] = str(tmp_path_factory.mktemp("ros"))
    roscore = start_roscore()
    try:
        eventually(lambda: roscore.poll() is not None or rosgraph.is_master_online(), "the master")
        if roscore.poll() is not None:  # another program has taken the port meanwhile
            roscore = start_roscore()
            eventually(rosgraph.is_master_online, "the master")
        rospy.init_node("player", disable_signals=True)
        yield
    finally:
        rospy.signal_shutdown("done")
        roscore.terminate()
        roscore.wait()


@pytest.fixture(scope="session")
def bag(tmp_path_factory, master):
    path = tmp_path_factory.mktemp("bag") / "office.bag"
    office_bag.write(path, steps=60)
    return path


class Player:
    """Plays bags to the node and gathers what it publishes."""

    def __init__(self):
        # Without a queue each message is sent before the next is: with one, a thread for each topic sends, and on a
        # busy machine a scan overtakes its transform.
        self.publishers = {
            topic: rospy.Publisher(topic, kind, queue_size=None, latch=topic in ("/map", "/tf_static"))
            for topic, kind in TYPES.items()
        }
        self.status = queue.Queue()
        self.initial_poses, self.poses, self.hypotheses, self.transforms = [], [], [], []
        gather = [
            ("/diagnostics", DiagnosticArray, self.status.put),
            ("/initialpose", PoseWithCovarianceStamped, self.initial_poses.append),
            ("/sigloc_pose", PoseWithCovarianceStamped, self.poses.append),
            ("/hypotheses", PoseArray, self.hypotheses.append),
            ("/tf", TFMessage, self.take_transforms),
        ]
        self.subscribers = [rospy.Subscriber(*rest, queue_size=1000) for rest in gather]

    def take_transforms(self, message):
        self.transforms += [t for t in message.transforms if t.header.frame_id == "map"]

    def wait_for_node(self, topics):
        """Waits until the node hears these topics, and we all of its own. Of /tf, both are publisher and subscriber."""
        both = ("/tf",)
        for topic in topics:
            eventually(lambda: self.publishers[topic].get_num_connections() > (topic in both), f"who hears {topic}")
        for subscriber in self.subscribers:
            eventually(lambda: subscriber.get_num_connections() > (subscriber.resolved_name in both),
                       f"who publishes {subscriber.resolved_name}")  # fmt: skip

    def play(self, path, topics=tuple(TYPES), shift=0.0, scans=None):
        """Plays each message once the node has answered to the scan before, up to a number of scans. Returns the
        statuses."""
        found = []
        with rosbag.Bag(str(path)) as bag:
            for topic, message, _ in bag.read_messages(topics=list(topics)):
                if hasattr(message, "transforms"):
                    for moved in message.transforms:
                        moved.header.stamp += rospy.Duration.from_sec(shift)
                else:
                    message.header.stamp += rospy.Duration.from_sec(shift)
                self.publishers[topic].publish(TYPES[topic](*[getattr(message, s) for s in TYPES[topic].__slots__]))
                if topic == "/scan":
                    found.append(self.answer_to(message.header.stamp))
                if len(found) == scans:
                    break
        return found

    def answer_to(self, stamp):
        while True:
            message = self.status.get(timeout=PATIENCE)
            if message.header.stamp == stamp:
                (status,) = message.status
                return status

    def close(self):
        for thing in [*self.publishers.values(), *self.subscribers]:
            thing.unregister()


class Node:
    def __init__(self, tmp_path, **parameters):
        words = [f"_{key}:={value}" for key, value in parameters.items()]
        self.log = tmp_path / "node.log"
        with open(self.log, "w") as log:
            self.process = subprocess.Popen([NODE, "__name:=sigloc", *words], stdout=log, stderr=log)

    def close(self):
        self.process.send_signal(signal.SIGINT)  # as Ctrl-C and roslaunch do
        assert self.process.wait(timeout=PATIENCE) == 0, self.log.read_text()


@pytest.fixture
def start(master, tmp_path):
    """Starts a node with parameters and returns what plays to it."""
    running = []

    def begin(**parameters):
        running.append(Node(tmp_path, **{"transform_tolerance": TOLERANCE, **parameters}))
        running.append(Player())
        heard = ["/tf_static", "/tf", "/scan"]
        heard += ["/odom"] if "odom_topic" in parameters else []
        heard += [] if "map_file" in parameters else ["/map"]
        running[-1].wait_for_node(heard)
        return running[-1]

    yield begin
    for thing in running:
        thing.close()
    master_ = rosgraph.Master("/player")
    for name in rospy.get_param_names():
        if name.startswith("/sigloc"):
            master_.deleteParam(name)


def values(status):
    return {value.key: value.value for value in status.values}


def planar(pose):
    return pose.position.x, pose.position.y, 2 * np.arctan2(pose.orientation.z, pose.orientation.w)


def error_at(stamp, pose):
    """Returns how far a pose is from the truth at a time [m, rad]."""
    truth = TRUTH[np.argmin(abs(TRUTH[:, 0] - stamp.to_sec()))]
    assert abs(truth[0] - stamp.to_sec()) < 0.01
    x, y, heading = pose
    return np.hypot(x - truth[1], y - truth[2]), abs(np.angle(np.exp(1j * (heading - truth[3]))))


def assert_right(stamp, pose, within=0.1):
    metres, radians = error_at(stamp, pose)
    assert metres < within and radians < np.radians(2)


def driven_to(step):
    """Returns the metres driven up to a step, counted from 0."""
    return np.hypot(*np.diff(TRUTH[: step + 1, 1:3], axis=0).T).sum()


def test_finds_the_robot_and_says_so_once(start, bag):
    player = start()
    statuses = player.play(bag)
    verdicts = [values(status)["verdict"] for status in statuses]
    states = [values(status)["state"] for status in statuses]
    assert driven_to(verdicts.index("localized")) < 1
    known = states.index("known")
    # Three steps that agree over a second.
    assert verdicts[known - 2 : known + 1] == ["localized"] * 3
    eventually(lambda: len(player.poses) == states.count("known"), "every pose")
    assert len(player.initial_poses) == 1
    first = player.initial_poses[0]
    assert first.header.frame_id == "map"
    assert first.header.stamp == player.poses[0].header.stamp
    assert abs(first.header.stamp.to_sec() - TRUTH[known, 0]) < 0.01
    assert_right(first.header.stamp, planar(first.pose.pose))
    for pose in player.poses:
        assert_right(pose.header.stamp, planar(pose.pose.pose), within=0.15)
    covariance = np.array(first.pose.covariance).reshape(6, 6)
    assert (np.diag(covariance)[[0, 1, 5]] > 0).all() and (np.diag(covariance)[2:5] == 0).all()
    for status, state in zip(statuses, states):
        assert status.level == (0 if state == "known" else WARN)
    assert values(statuses[0])["reason"]
    # All hypotheses, at each step.
    eventually(lambda: len(player.hypotheses) == len(statuses), "every hypothesis")
    for array, status in zip(player.hypotheses, statuses):
        assert array.header.frame_id == "map"
        assert str(len(array.poses)) == values(status)["hypotheses"]
    assert not player.transforms, "who gives initialpose out leaves the transform to the filter"


def test_a_map_file_and_messages_of_odometry_will_do(start, bag):
    player = start(map_file=office_bag.ROOT / "maps/office.simplemap", odom_topic="odom")
    statuses = player.play(bag, topics=("/tf_static", "/odom", "/scan"))
    assert driven_to([values(s)["verdict"] for s in statuses].index("localized")) < 1
    assert values(statuses[-1])["state"] == "known"
    assert_right(player.initial_poses[0].header.stamp, planar(player.initial_poses[0].pose.pose))


def write_image(path):
    """Writes the office's grid as an image alone. Returns where its lower left corner is in the map."""
    office = sigloc.Map.load(office_bag.ROOT / "maps/office.gridmap.gz")
    shades = np.choose(np.sign(office.grid.astype(int)) + 1, [205, 254, 0]).astype(np.uint8)
    height, width = shades.shape
    path.write_bytes(f"P5\n{width} {height}\n255\n".encode() + shades[::-1].tobytes())
    return office.origin


def test_an_image_with_its_resolution_is_a_map(start, bag, tmp_path):
    left, low = write_image(tmp_path / "office.pgm")
    player = start(map_file=tmp_path / "office.pgm", **{"reading/image_resolution": 0.05})
    assert values(player.play(bag, topics=("/tf_static", "/tf", "/scan"))[-1])["state"] == "known"
    x, y, heading = planar(player.initial_poses[0].pose.pose)
    assert_right(player.initial_poses[0].header.stamp, (x + left, y + low, heading))


def test_publishes_the_transform_only_while_the_pose_is_known(start, bag):
    player = start(publish_tf="true")
    statuses = player.play(bag)
    known = [k for k, status in enumerate(statuses) if values(status).get("state") == "known"]
    assert known
    eventually(lambda: len(player.transforms) == len(known), "every transform")
    assert not player.initial_poses
    moved = {t.header.stamp.to_sec(): t for t in odometry_of(bag)}
    for k, transform in zip(known, player.transforms):
        stamp = transform.header.stamp - rospy.Duration.from_sec(TOLERANCE)
        assert transform.child_frame_id == "odom"
        assert abs(stamp.to_sec() - TRUTH[k, 0]) < 0.01
        odometry = min(moved, key=lambda time_: abs(time_ - stamp.to_sec()))
        map_from_odom = planar_transform(transform.transform)
        assert_right(stamp, office_bag.compose(map_from_odom, planar_transform(moved[odometry].transform)), within=0.15)


def planar_transform(transform):
    turn = 2 * np.arctan2(transform.rotation.z, transform.rotation.w)
    return transform.translation.x, transform.translation.y, turn


def odometry_of(path):
    with rosbag.Bag(str(path)) as bag:
        return [message.transforms[0] for _, message, _ in bag.read_messages(topics=["/tf"])]


def test_searches_anew_on_request(start, bag):
    player = start()
    assert values(player.play(bag)[-1])["state"] == "known"
    rospy.ServiceProxy("global_localization", Empty)()
    duration = TRUTH[59, 0] - TRUTH[0, 0] + 1
    statuses = player.play(bag, topics=("/tf", "/scan"), shift=duration)
    states = [values(status)["state"] for status in statuses]
    assert states[0] == "searching" and "asked for" in statuses[0].message
    assert states[-1] == "known"
    eventually(lambda: len(player.initial_poses) == 2, "the second pose")


def test_a_bag_that_is_played_again_starts_anew(start, bag):
    player = start()
    assert values(player.play(bag)[-1])["state"] == "known"
    # A transform of the past may come before the scan that shows that time went back, and is forgotten with the rest.
    (first,) = player.play(bag, topics=("/scan",), scans=1)
    assert first.level == ERROR and "scan left out" in first.message
    again = player.play(bag, topics=("/tf", "/scan"))
    assert values(again[0])["state"] in ("searching", "confirming")
    assert values(again[-1])["state"] == "known"
    eventually(lambda: len(player.initial_poses) == 2, "the second pose")
    assert_right(player.initial_poses[1].header.stamp, planar(player.initial_poses[1].pose.pose))


def test_says_what_it_misses(start, bag):
    player = start(odom_frame="wheels", transform_tolerance=0.01)
    (status,) = player.play(bag, topics=("/scan",), scans=1)
    assert status.level == ERROR and status.message == "no map yet"
    statuses = player.play(bag, topics=("/map", "/tf_static", "/tf", "/scan"))
    assert {status.level for status in statuses[1:]} == {ERROR}
    assert "wheels" in statuses[-1].message


def test_refuses_a_map_that_is_none(start, bag):
    player = start()
    grid = OccupancyGrid()
    grid.header.stamp = rospy.Time(7)
    grid.info.origin.orientation.w = 1
    grid.info.resolution = 0.05
    grid.info.width = grid.info.height = 20
    grid.data = [0] * 400
    player.publishers["/map"].publish(grid)
    status = player.answer_to(grid.header.stamp)
    assert status.level == ERROR and status.message == "map: the grid has no wall"
    assert values(player.play(bag)[-1])["state"] == "known", "a good map afterwards will do"


def test_leaves_out_what_cannot_be_used(start, bag):
    player = start()
    statuses = player.play(bag)
    with rosbag.Bag(str(bag)) as recorded:
        last = [message for _, message, _ in recorded.read_messages(topics=["/scan"])][-1]
    bad = LaserScan(*[getattr(last, slot) for slot in LaserScan.__slots__])
    bad.header.stamp = last.header.stamp + rospy.Duration(0, 1000)
    bad.ranges = []
    moved = odometry_of(bag)[-1]
    moved.header.stamp = bad.header.stamp
    player.publishers["/tf"].publish(TFMessage([moved]))
    player.publishers["/scan"].publish(bad)
    status = player.answer_to(bad.header.stamp)
    assert status.level == ERROR and "at least two beams" in status.message
    assert values(statuses[-1])["state"] == "known"


@pytest.mark.parametrize(
    "parameters, reason",
    [
        ({"map_file": "/nowhere/a.yaml"}, "/nowhere/a.yaml: no such file"),
        ({"map_file": "office.pgm"}, "office.pgm: an image alone does not tell"),
        ({"map_file": "office.pgm", "reading/image_resolution": 0.0001}, "office.pgm: "),
        ({"map_file": "office.pgm", "reading/image_resolution": 7.0}, "image_resolution"),
        ({"map_file": "office.pgm", "reading/image_resolution": "fine"}, "image_resolution is of another type"),
        ({"map_file": "office.pgm", "reading/min_height": 2.0}, "the lowest height"),
        ({"publish_tf": "often"}, "publish_tf is of another type"),
        ({"transform_tolerance": -1.0}, "transform_tolerance"),
        ({"policy/confirm_steps": 0}, "confirm_steps"),
        ({"policy/confirm_steps": -3}, "confirm_steps"),
        ({"tracker/suspicion": 7.0}, "suspicion"),
        ({"reading/min_height": 500.0}, "min_height"),
    ],
)
def test_ends_at_once_with_parameters_that_cannot_be_used(master, tmp_path, parameters, reason):
    write_image(tmp_path / "office.pgm")
    words = [f"_{key}:={value}" for key, value in parameters.items()]
    done = subprocess.run([NODE, "__name:=sigloc_bad", *words], capture_output=True, text=True,
                          timeout=PATIENCE, check=False, cwd=tmp_path)  # fmt: skip
    rospy.delete_param("/sigloc_bad")
    assert done.returncode == 1
    assert reason in done.stderr and done.stderr.count("\n") == 1
