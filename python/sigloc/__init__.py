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
# What is compiled would miss it only where the first array is made.
try:
    import numpy as _numpy
except ImportError as _error:
    raise ImportError(f"sigloc needs numpy (Debian: python3-numpy): {_error}") from None
del _numpy

from ._sigloc import (  # noqa: E402
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
    probability_text,
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
    "probability_text",
    "write_log",
]
