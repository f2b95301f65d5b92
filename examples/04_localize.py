#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Follows every pose that is possible along a log, and draws where the robot may be.

    04_localize.py [--map MAP] [--log RAWLOG] [--picture out.png]
"""
from __future__ import annotations

import argparse
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import sigloc


def show(count: int, answer: sigloc.Answer) -> None:
    line = f"step {count}: {answer.verdict} ({sigloc.probability_text(answer.probability)})"
    if answer.hypotheses:
        x, y, heading = answer.hypotheses[0].pose
        line += f", best at ({x:.2f} m, {y:.2f} m, {math.degrees(heading):.1f} deg)"
    print(f"{line}: {answer.reason}" if answer.reason else line)


def draw(map_: sigloc.Map, scan: sigloc.Scan, answer: sigloc.Answer, picture: str) -> None:
    figure, axes = plt.subplots(figsize=(8, 6))
    if map_.grid is not None and map_.origin is not None and map_.resolution is not None:
        height, width = map_.grid.shape
        x, y = map_.origin
        extent = (x, x + width * map_.resolution, y, y + height * map_.resolution)
        shades = np.choose(map_.grid.clip(-1, 1) + 1, (0.8, 1.0, 0.4))  # unknown, free, wall
        axes.imshow(shades, cmap="gray", vmin=0, vmax=1, origin="lower", extent=extent)
    for x1, y1, x2, y2 in map_.walls:
        axes.plot((x1, x2), (y1, y2), color="tab:blue", linewidth=1)
    for hypothesis in answer.hypotheses:
        x, y, heading = hypothesis.pose
        axes.quiver(x, y, math.cos(heading), math.sin(heading), color="tab:pink",
                    alpha=0.2 + 0.8 * hypothesis.probability)  # fmt: skip
    if answer.hypotheses:
        x, y, heading = answer.hypotheses[0].pose
        turn = np.array([[math.cos(heading), -math.sin(heading)], [math.sin(heading), math.cos(heading)]])
        axes.plot(*((x, y) + scan.points @ turn.T).T, ".", color="tab:red", markersize=2)
    title = f"{answer.verdict} ({sigloc.probability_text(answer.probability)})"
    axes.set(title=title, xlabel="x [m]", ylabel="y [m]", aspect="equal")
    figure.savefig(picture)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--map", default="maps/office.simplemap")
    parser.add_argument("--log", default="rawlogs/office.rawlog")
    parser.add_argument("--picture", help="a .png or .pdf file to draw the last step into")
    arguments = parser.parse_args()
    try:
        map_ = sigloc.Map.load(arguments.map)
        tracker = sigloc.Tracker(sigloc.Localizer(map_))
        count = 0
        for count, step in enumerate(sigloc.Log(arguments.log), 1):
            answer = tracker.step(step.observations, step.motion, step.motion_covariance)
            if count % 20 == 1:
                show(count, answer)
        show(count, answer)
        scans = [seen for seen in step.observations if isinstance(seen, sigloc.Scan)]
        if arguments.picture and scans:
            draw(map_, scans[0], answer, arguments.picture)
    except OSError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
