# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Landmarks without identities, in a map of them."""
import numpy as np
import pytest

import sigloc


@pytest.fixture(scope="module")
def places():
    return np.random.default_rng(5).uniform(0, 40, (60, 2))


@pytest.fixture(scope="module")
def map_(places, tmp_path_factory):
    path = tmp_path_factory.mktemp("map") / "reflectors.csv"
    np.savetxt(path, places, delimiter=",", header="x,y", comments="")
    return sigloc.Map.load(path)


def seen_from(places, pose):
    x, y, heading = pose
    c, s = np.cos(heading), np.sin(heading)
    seen = (places - (x, y)) @ np.array([[c, -s], [s, c]])
    return seen[np.hypot(*seen.T) < 15]


def test_landmarks_are_recognised(map_, places):
    assert map_.grid is None and map_.resolution is None and map_.origin is None
    assert len(map_) == 60 and map_.walls.shape == (0, 4)
    truth = (20.0, 15.0, 0.7)
    landmarks = sigloc.Landmarks(seen_from(places, truth), sigma=0.02)
    assert len(landmarks) >= 8
    answer = sigloc.Localizer(map_).localize(landmarks)
    assert answer.poses[0] == pytest.approx(truth, abs=0.05)


@pytest.mark.parametrize(
    "positions, sigma",
    [([1.0, 2.0], 0.05), ([[1.0, 2.0, 3.0]], 0.05), ([[float("nan"), 0]], 0.05), ([[0, 0]], 0), ([[0, 0]], -1)],
)
def test_landmarks_that_cannot_be_used(positions, sigma):
    with pytest.raises(ValueError) as error:
        sigloc.Landmarks(positions, sigma=sigma)
    assert "\n" not in str(error.value)


def test_landmarks_too_far_are_refused(map_):
    with pytest.raises(ValueError):
        sigloc.Localizer(map_).localize(sigloc.Landmarks([[1e9, 0], [0, 1e9]]))
