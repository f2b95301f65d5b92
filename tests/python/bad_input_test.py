# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Bad input raises with its reason in one line, and nothing is printed or left half-written."""
import pathlib
import random

import numpy as np
import pytest

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAP = ROOT / "maps/office.simplemap"
LOG = ROOT / "rawlogs/office.rawlog"
NAN = float("nan")
INF = float("inf")
RANGES = [1.0, 2.0, 3.0]
EYE = np.eye(3)


@pytest.fixture(autouse=True)
def silence(capfd):
    yield
    assert tuple(capfd.readouterr()) == ("", "")


@pytest.fixture(scope="module")
def localizer():
    return sigloc.Localizer(sigloc.Map.load(MAP))


def assert_one_line(error, *parts):
    message = str(error.value)
    assert message and "\n" not in message
    for part in parts:
        assert str(part) in message


def bad_files(folder, model, name):
    """Yields bad files of this name: empty, truncated, foreign, random."""
    contents = {
        "empty": b"",
        "truncated": model.read_bytes()[: model.stat().st_size // 2],
        "foreign": b"%PDF-1.4\nnothing that MRPT would read\n",
        "random": random.Random(7).randbytes(5000),
    }
    for kind, content in contents.items():
        path = folder / kind / name
        path.parent.mkdir()
        path.write_bytes(content)
        yield path


@pytest.mark.parametrize("name", ["a.simplemap", "a.gridmap", "a.yaml", "a.csv", "a.sigmap", "a.log"])
def test_maps_that_are_none(tmp_path, name):
    for path in bad_files(tmp_path, MAP, name):
        with pytest.raises(OSError) as error:
            sigloc.Map.load(path)
        assert_one_line(error, path)
    with pytest.raises(FileNotFoundError) as error:
        sigloc.Map.load(tmp_path / name)
    assert_one_line(error, tmp_path / name)


def test_maps_of_unknown_kind(tmp_path):
    (tmp_path / "a.pdf").write_text("x")
    with pytest.raises(OSError) as error:
        sigloc.Map.load(str(tmp_path / "a.pdf"))
    assert_one_line(error, "unknown kind of map")


def test_a_yaml_without_its_image(tmp_path):
    path = tmp_path / "a.yaml"
    path.write_text("image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"
                    "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n")  # fmt: skip
    with pytest.raises(FileNotFoundError) as error:
        sigloc.Map.load(path)
    assert_one_line(error, "a.pgm")


def test_logs_that_are_none(tmp_path):
    for path in bad_files(tmp_path, MAP, "a.rawlog"):
        with pytest.raises(OSError) as error:
            sigloc.Log(path)
        assert_one_line(error, path)
    with pytest.raises(FileNotFoundError):
        sigloc.Log(tmp_path / "a.rawlog")


def test_a_truncated_log_ends_early(tmp_path):
    path = tmp_path / "a.rawlog"
    path.write_bytes(LOG.read_bytes()[: LOG.stat().st_size // 2])
    log = sigloc.Log(path)
    assert 10 < sum(1 for _ in log) < 201
    assert log.truncated


def test_a_map_that_cannot_be_saved(tmp_path, localizer):
    map_ = sigloc.Map.load(MAP)
    with pytest.raises(OSError) as error:
        map_.save(tmp_path / "missing" / "a.sigmap")
    assert_one_line(error, "a.sigmap")
    (tmp_path / "folder.sigmap").mkdir()
    with pytest.raises(OSError):
        map_.save(tmp_path / "folder.sigmap")
    assert [path.name for path in tmp_path.iterdir()] == ["folder.sigmap"]


@pytest.mark.parametrize(
    "arguments, keywords",
    [
        (([1.0], 0, 0.1), {}),
        (([], 0, 0.1), {}),
        (([RANGES], 0, 0.1), {}),
        ((RANGES, NAN, 0.1), {}),
        ((RANGES, 7.0, 0.1), {}),
        ((RANGES, 0, 0), {}),
        ((RANGES, 0, NAN), {}),
        ((RANGES, 0, 4.0), {}),
        ((RANGES, 0, 0.1), {"range_min": -1}),
        ((RANGES, 0, 0.1), {"range_min": 2, "range_max": 1}),
        ((RANGES, 0, 0.1), {"range_max": NAN}),
        ((RANGES, 0, 0.1), {"sigma": 0}),
        ((RANGES, 0, 0.1), {"sigma": INF}),
        ((RANGES, 0, 0.1), {"pose": (0, 0)}),
        ((RANGES, 0, 0.1), {"pose": (0, NAN, 0)}),
        ((RANGES, 0, 0.1), {"pose": (1e9, 0, 0)}),
        ((RANGES, 0, 0.1), {"pose": (0, 0, 0, 0, 0.5, 0)}),
    ],
)
def test_scans_that_cannot_be_used(arguments, keywords):
    with pytest.raises(ValueError) as error:
        sigloc.Scan(*arguments, **keywords)
    assert_one_line(error)


def test_beams_without_a_return_are_left_out():
    ranges = [NAN, INF, -INF, -1, 0, 0.04, 1.0, 29.0, 30.0, 1e30]
    scan = sigloc.Scan(ranges, -1, 0.1, range_min=0.05, range_max=30)
    assert np.flatnonzero(np.isfinite(scan.ranges)).tolist() == [6, 7]


def test_scenes_that_show_nothing(localizer):
    nothing = sigloc.Scan([NAN] * 100, -1, 0.02)
    for observations in ([], nothing, [nothing], sigloc.Landmarks(np.empty((0, 2)))):
        answer = localizer.localize(observations)
        assert answer.verdict == sigloc.Verdict.TOO_LITTLE_SEEN
        assert answer.poses.shape == (0, 3)
        assert answer.covariances.shape == (0, 3, 3)


@pytest.mark.parametrize(
    "motion, covariance",
    [
        ((0, 0), None),
        ((0, 0, NAN), None),
        ((INF, 0, 0), EYE),
        ((0, 0, 0), np.eye(2)),
        ((0, 0, 0), -EYE),
        ((0, 0, 0), EYE * NAN),
        (None, EYE),
    ],
)
def test_motions_that_cannot_be_used(localizer, motion, covariance):
    tracker = sigloc.Tracker(localizer)
    step = next(sigloc.Log(LOG))
    before = tracker.step(step.observations)
    with pytest.raises(ValueError) as error:
        tracker.step(step.observations, motion, covariance)
    assert_one_line(error)
    assert np.array_equal(tracker.answer.poses, before.poses)


def test_objects_of_another_type(localizer):
    for observations in (None, 3, "scan", [1, 2], [None]):
        with pytest.raises(TypeError):
            localizer.localize(observations)
    for make in (sigloc.Localizer, sigloc.Tracker):
        with pytest.raises(TypeError):
            make(None)
    with pytest.raises(TypeError):
        sigloc.Map.load(3)


@pytest.mark.parametrize(
    "box", [(1, 0, 0, 1), (0, 1, 1, 1), (NAN, 1, 0, 1), (0, 1, 0, 1, NAN), (0, 1, 0, 1, 0, 0)]
)
def test_regions_that_are_empty(box):
    with pytest.raises(ValueError) as error:
        sigloc.Region(*box)
    assert_one_line(error)
