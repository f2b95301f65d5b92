# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds a lost robot in a known map from what its laser sees, and tracks it.

    map = sigloc.Map.load("office.yaml")
    localizer = sigloc.Localizer(map)
    answer = localizer.localize(sigloc.Scan(ranges, angle_min, angle_increment))
    if answer.verdict == sigloc.Verdict.LOCALIZED:
        x, y, heading = answer.hypotheses[0].pose

A Tracker does the same over time, and a Policy says when a robot may use its pose. Angles are in radians and counter-clockwise, everything else is in
SI units. Poses are those of the robot in the map's frame. Same input, same answer. Bad values raise
ValueError and files that cannot be used OSError, with the reason in one line. Nothing is printed.
"""
from ._sigloc import (
    Answer,
    Decision,
    Hypothesis,
    Landmarks,
    Localizer,
    Log,
    Map,
    Policy,
    Region,
    Scan,
    Step,
    Tracker,
    Verdict,
    __version__,
    write_log,
)

__all__ = [
    "Answer",
    "Decision",
    "Hypothesis",
    "Landmarks",
    "Localizer",
    "Log",
    "Map",
    "Policy",
    "Region",
    "Scan",
    "Step",
    "Tracker",
    "Verdict",
    "__version__",
    "write_log",
]
