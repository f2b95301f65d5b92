# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What Python answers is what C++ answers, to the last bit."""
import os
import pathlib
import subprocess
import threading

import numpy as np
import pytest

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAP = ROOT / "maps/office.simplemap"
LOG = ROOT / "rawlogs/office.rawlog"
TRUTH = ROOT / "rawlogs/office-truth.txt"


def bits(number):
    """Returns a float as C's %a writes it, whatever the number of digits."""
    return float(number).hex()


def line_of(answer):
    words = [f"{answer.verdict}:", bits(answer.probability), bits(answer.elsewhere)]
    for hypothesis in answer.hypotheses:
        numbers = [hypothesis.probability, *hypothesis.pose, *hypothesis.covariance.ravel()]
        words += map(bits, numbers)
    return " ".join(words) + (f" {answer.reason}" if answer.reason else "")


def spelt_alike(line):
    """Returns a line of print_answers with its numbers spelt as Python does."""
    words = line.strip().split(" ")
    return " ".join(bits(float.fromhex(w)) if "0x" in w else w for w in words)


@pytest.fixture(scope="module")
def localizer():
    return sigloc.Localizer(sigloc.Map.load(MAP))


@pytest.fixture(scope="module")
def expected():
    printed = subprocess.run(
        [os.environ["SIGLOC_PRINT_ANSWERS"], MAP, LOG], capture_output=True, text=True, check=True
    )
    return [spelt_alike(line) for line in printed.stdout.splitlines()]


def test_every_step_of_the_office(localizer, expected):
    tracker = sigloc.Tracker(localizer)
    lines = []
    for step in sigloc.Log(LOG):
        lines.append(line_of(localizer.localize(step.observations)))
        answer = tracker.step(step.observations, step.motion, step.motion_covariance)
        assert line_of(answer) == line_of(tracker.answer)
        lines.append(line_of(answer))
    assert len(lines) == 404
    assert lines == expected


def test_scans_and_motions_that_went_through_numpy(localizer, expected):
    tracker = sigloc.Tracker(localizer)
    lines = []
    for step in sigloc.Log(LOG):
        scans = [
            sigloc.Scan(
                scan.ranges.astype(float), scan.angle_min, scan.angle_increment, range_max=scan.range_max,
                pose=scan.pose, sigma=scan.sigma,
            )
            for scan in step.observations
        ]  # fmt: skip
        lines.append(line_of(localizer.localize(scans[0])))
        covariance = step.motion_covariance.tolist()
        lines.append(line_of(tracker.step(tuple(scans), step.motion.tolist(), covariance)))
    assert lines == expected


def test_the_office_is_localized_at_the_true_pose(localizer):
    tracker = sigloc.Tracker(localizer)
    for step in sigloc.Log(LOG):
        answer = tracker.step(step.observations, step.motion)
    assert answer.verdict == sigloc.Verdict.LOCALIZED
    assert str(answer.verdict) == "localized"
    assert answer.hypotheses[0].id is not None
    x, y, heading = answer.hypotheses[0].pose
    truth = np.loadtxt(TRUTH)[-1]
    assert np.hypot(x - truth[1], y - truth[2]) < 0.1
    assert abs(np.angle(np.exp(1j * (heading - truth[3])))) < np.radians(1)


def test_arrays_have_the_shapes_that_are_told(localizer):
    step = next(sigloc.Log(LOG))
    answer = localizer.localize(step.observations)
    count = len(answer.hypotheses)
    assert count >= 1
    assert answer.poses.shape == (count, 3)
    assert answer.covariances.shape == (count, 3, 3)
    assert answer.probabilities.shape == (count,)
    assert answer.hypotheses[0].pose.dtype == np.float64
    assert answer.probabilities.sum() + answer.elsewhere == pytest.approx(1)
    assert np.array_equal(answer.covariances[0], answer.hypotheses[0].covariance)
    assert np.array_equal(answer.poses[0], answer.hypotheses[0].pose)
    assert answer.hypotheses[0].id is None
    (scan,) = step.observations
    assert scan.ranges.shape == (len(scan),)
    assert scan.points.shape == (np.isfinite(scan.ranges).sum(), 2)


def test_a_clockwise_scan_is_the_same_scan(localizer):
    (scan,) = next(sigloc.Log(LOG)).observations
    last = scan.angle_min + (len(scan) - 1) * scan.angle_increment
    clockwise = sigloc.Scan(scan.ranges[::-1], last, -scan.angle_increment,
                            range_max=scan.range_max, pose=scan.pose)  # fmt: skip
    assert np.array_equal(clockwise.ranges, scan.ranges, equal_nan=True)
    assert clockwise.angle_min == pytest.approx(scan.angle_min)
    # Upside down, the beams of a counter-clockwise scan turn clockwise seen from above.
    x, y, heading = scan.pose
    upside_down = sigloc.Scan(scan.ranges[::-1], -last, scan.angle_increment,
                              range_max=scan.range_max, pose=(x, y, 0, heading, 0, np.pi))  # fmt: skip
    assert upside_down.points == pytest.approx(scan.points, abs=1e-9)


def test_a_region_limits_where_the_robot_may_be(localizer):
    observations = next(sigloc.Log(LOG)).observations
    x, y, heading = localizer.localize(observations).poses[0]
    region = sigloc.Region(x - 1, x + 1, y - 1, y + 1, heading, 0.5)
    for pose in localizer.localize(observations, region).poses:
        assert np.hypot(*(pose[:2] - (x, y))) < 1.5
    tracker = sigloc.Tracker(localizer)
    tracker.step(observations)
    tracker.reset(sigloc.Region(x + 5, x + 6, y, y + 1))
    assert tracker.answer.hypotheses == []
    assert tracker.step(observations).verdict != sigloc.Verdict.LOCALIZED


def test_options_reach_the_localizer(localizer):
    map_ = sigloc.Map.load(MAP)
    observations = next(sigloc.Log(LOG)).observations
    assert sigloc.Localizer(map_, min_beams=1000).localize(observations).verdict == (
        sigloc.Verdict.TOO_LITTLE_SEEN
    )
    assert len(sigloc.Localizer(map_, max_candidates=1).localize(observations).hypotheses) == 1
    with pytest.raises(ValueError, match="max_candidates.*outside"):
        sigloc.Localizer(map_, max_candidates=0)
    with pytest.raises(TypeError, match="did you mean 'min_beams'"):
        sigloc.Localizer(map_, min_beam=3)
    with pytest.raises(TypeError, match="'seed'"):
        sigloc.Localizer(map_, seed="one")
    with pytest.raises(ValueError, match="suspicion"):
        sigloc.Tracker(localizer, suspicion=2.0)


def test_threads_may_share_a_localizer_and_a_tracker(localizer):
    steps = list(sigloc.Log(LOG))[:20]
    expected = [line_of(localizer.localize(step.observations)) for step in steps]
    tracker = sigloc.Tracker(localizer)
    found = {}

    def work(thread):
        found[thread] = [line_of(localizer.localize(step.observations)) for step in steps]
        for step in steps:
            tracker.step(step.observations, (0, 0, 0))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [found[k] for k in range(3)] == [expected] * 3
    assert tracker.answer.probabilities.sum() + tracker.answer.elsewhere == pytest.approx(1)
