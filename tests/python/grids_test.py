# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Maps from numpy arrays."""
import pathlib

import numpy as np
import pytest

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRID = ROOT / "maps/office.gridmap.gz"
LOG = ROOT / "rawlogs/office.rawlog"


@pytest.fixture(scope="module")
def office():
    return sigloc.Map.load(GRID)


def first_pose(map_):
    observations = next(sigloc.Log(LOG)).observations
    return sigloc.Localizer(map_).localize(observations).poses[0]


def room(rows=60, columns=100):
    """A room of 5 m x 3 m."""
    grid = np.zeros((rows, columns), np.int8)
    grid[[0, -1], :] = 100
    grid[:, [0, -1]] = 100
    return grid


def test_the_grid_of_a_map_makes_that_map_again(office):
    again = sigloc.Map.from_grid(office.grid, office.resolution, office.origin)
    assert np.array_equal(again.grid, office.grid)
    assert again.origin == office.origin
    assert again.resolution == office.resolution
    assert again.area == pytest.approx(office.area)
    assert first_pose(again) == pytest.approx(first_pose(office), abs=0.02)


def test_the_grid_of_scans_has_thin_walls():
    scans = sigloc.Map.load(ROOT / "maps/office.simplemap")
    grid = scans.grid
    assert set(np.unique(grid)) == {-1, 0, 50, 100}
    # Cells that noise spread the walls over are no walls of the grid's map.
    again = sigloc.Map.from_grid(grid, scans.resolution, scans.origin)
    assert np.array_equal(again.grid, np.where(grid == 50, -1, grid))
    assert first_pose(again) == pytest.approx(first_pose(scans), abs=0.03)


def test_probabilities_are_percents(office):
    percent = office.grid
    probability = np.where(percent < 0, np.nan, percent / 100.0)
    for dtype in (np.float32, np.float64):
        map_ = sigloc.Map.from_grid(probability.astype(dtype), office.resolution, office.origin)
        assert np.array_equal(map_.grid, percent)
    # Any memory layout will do.
    map_ = sigloc.Map.from_grid(np.asfortranarray(percent.astype(np.int64)), office.resolution, office.origin)
    assert np.array_equal(map_.grid, percent)


def test_a_turned_grid_turns_its_poses(office):
    turn = np.radians(30)
    map_ = sigloc.Map.from_grid(office.grid, office.resolution, (3.0, -2.0, turn))
    x, y, heading = first_pose(office)
    left, low = office.origin
    c, s = np.cos(turn), np.sin(turn)
    expected_x = 3.0 + c * (x - left) - s * (y - low)
    expected_y = -2.0 + s * (x - left) + c * (y - low)
    found_x, found_y, found_heading = first_pose(map_)
    assert np.hypot(found_x - expected_x, found_y - expected_y) < office.resolution
    assert abs(np.angle(np.exp(1j * (found_heading - heading - turn)))) < np.radians(1)


def test_rows_begin_at_the_bottom():
    grid = room()
    grid[:20, 40:60] = 100  # a block at the lower wall
    map_ = sigloc.Map.from_grid(grid, 0.05, (-1.0, 10.0))
    assert len(map_) >= 4
    assert map_.warning is None
    ends = map_.walls.reshape(-1, 2)
    assert ends[:, 0].min() == pytest.approx(-1, abs=0.1) and ends[:, 0].max() == pytest.approx(4, abs=0.1)
    assert ends[:, 1].min() == pytest.approx(10, abs=0.1) and ends[:, 1].max() == pytest.approx(13, abs=0.1)
    top_of_block = [wall for wall in map_.walls if abs(wall[1] - 11) < 0.1 and abs(wall[3] - 11) < 0.1]
    assert top_of_block, "no wall where the block ends, 1 m above the lower wall"


def test_a_map_is_saved_and_loaded(office, tmp_path):
    path = tmp_path / "office.sigmap"
    office.save(path)
    again = sigloc.Map.load(str(path))
    assert len(again) == len(office)
    assert np.array_equal(again.grid, office.grid)
    assert np.array_equal(first_pose(again), first_pose(office))


def write_points(path):
    """Writes two rooms as points, one inside the other: walls of 6 m x 4 m at 1 m, of 8 m x 6 m at 2.5 m."""
    rows = [
        f"{x:.2f} {y:.2f} {z}"
        for width, depth, z in ((6, 4, 1.0), (8, 6, 2.5))
        for k in np.linspace(-0.5, 0.5, 300)
        for x, y in ((k * width, depth / 2), (k * width, -depth / 2), (width / 2, k * depth), (-width / 2, k * depth))
    ]
    names = "".join(f"property float {axis}\n" for axis in "xyz")
    path.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{names}end_header\n" + "\n".join(rows) + "\n")


def test_heights_choose_the_points_of_a_map(tmp_path):
    path = tmp_path / "rooms.ply"
    write_points(path)
    for map_, width in ((sigloc.Map.load(path), 6), (sigloc.Map.load(path, heights=(2, 3)), 8)):
        assert np.ptp(map_.walls[:, [0, 2]]) == pytest.approx(width, abs=0.15)
    with pytest.raises(OSError, match="heights") as error:
        sigloc.Map.load(path, heights=(4, 5))
    assert "\n" not in str(error.value)


def test_heights_choose_the_points_of_a_log():
    path = ROOT / "tests/corpus/rawlog/good_point_cloud"
    assert any(step.observations for step in sigloc.Log(path))
    assert not any(step.observations for step in sigloc.Log(path, heights=(50, 60)))


NAN = float("nan")


@pytest.mark.parametrize("heights", [(1.5, 0.2), (1, 1), (NAN, 1), (0, NAN), (-1e9, 0)])
def test_heights_that_no_point_can_be_between(heights, tmp_path):
    path = tmp_path / "rooms.ply"
    write_points(path)
    with pytest.raises(ValueError, match="height"):
        sigloc.Map.load(path, heights=heights)
    with pytest.raises(ValueError, match="height"):
        sigloc.Log(LOG, heights=heights)


@pytest.mark.parametrize(
    "array, resolution, origin",
    [
        (np.zeros((0, 10), np.int8), 0.05, (0, 0)),
        (np.zeros(10, np.int8), 0.05, (0, 0)),
        (np.zeros((10, 10, 3), np.uint8), 0.05, (0, 0)),
        (np.zeros((10, 10), np.int8), 0.05, (0, 0)),
        (np.full((10, 10), 100, np.int8), 0.05, (0, 0)),
        (np.full((10, 10), 255, np.uint8), 0.05, (0, 0)),
        (np.full((10, 10), -2, np.int8), 0.05, (0, 0)),
        (np.full((10, 10), 1.5), 0.05, (0, 0)),
        (np.full((10, 10), -0.5), 0.05, (0, 0)),
        (np.full((10, 10), np.inf), 0.05, (0, 0)),
        (np.full((10, 10), NAN), 0.05, (0, 0)),
        (room() == 100, 0.05, (0, 0)),
        (room().astype(complex), 0.05, (0, 0)),
        (np.array([["a"]]), 0.05, (0, 0)),
        (room(), 0.0, (0, 0)),
        (room(), NAN, (0, 0)),
        (room(), 5.0, (0, 0)),
        (room(), 0.05, (0,)),
        (room(), 0.05, (0, 0, 0, 0)),
        (room(), 0.05, (NAN, 0)),
        (room(), 0.05, (0, 0, NAN)),
        (room(), 0.05, (2e5, 0)),
    ],
)
def test_grids_that_make_no_map(array, resolution, origin, capfd):
    with pytest.raises(ValueError) as error:
        sigloc.Map.from_grid(array, resolution, origin)
    assert str(error.value) and "\n" not in str(error.value)
    assert tuple(capfd.readouterr()) == ("", "")
