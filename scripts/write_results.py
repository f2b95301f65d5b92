#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes RESULTS.md and its plots from the runs of one scripts/bench.

  scripts/write_results.py BENCH_OUT FOLDER

Everything comes from the summaries and tables in BENCH_OUT, which must be of one clean commit. Runs
that were not asked for leave their rows out; a quick bench is written into its own folder only.
"""
import argparse
import pathlib
import sys

from results import data_use, drives, growth, integrity, opponents, plots, scans, shortcomings, simulated
from results.page import bullets, paragraph
from results.runs import BadInput, Bench

MAX_LINES = 380


def introduction(bench):
    made = bench.provenance
    mrpt = made["mrpt"].removeprefix("MRPT").strip()
    minutes = sum(bench.seconds.values()) / 60
    text = [
        f"Written by one run of `{bench.command}` with the programs of commit {made['commit']}.",
        f"It is sigloc {made['version']}, MRPT {mrpt}, g++ {made['compiler']},",
        f"{made['processors']} cores ({made['processor']}), shared, {minutes:.0f} minutes.",
        "Times are CPU time of one thread, and ratios of times are of one run: quote the ratios.",
        "Brackets hold 95 % intervals, Wilson's for shares.",
        "**Right** is within 0.5 m and 10 degrees of the truth.",
        "On victoria-park it is within 1 m and 10 degrees on drives, 1 m and 3 degrees for single answers.",
        "**Wrong** is *localized* and more than 1 m or 20 degrees off; in simulation, *localized* and not right.",
        "A column with % gives the count, the share in per cent and its interval.",
    ]
    if bench.is_quick:
        text.insert(0, "**A quick trial with few questions: quote nothing.**")
    return ["# Results", ""] + paragraph(text) + [""]


def page(bench, drawn):
    makers = (data_use.data, scans.one_scan, opponents.opponents, opponents.cbgl, scans.foreign,
              drives.wake_ups, drives.scans_alone, drives.particle_filter,
              integrity.misleading, integrity.apart, integrity.coverage, integrity.reliability,
              drives.landmarks, simulated.wake_ups, simulated.foreign, simulated.sweeps,
              growth.growth, growth.area, growth.lost)  # fmt: skip
    sections = [maker(bench) for maker in makers]
    short = bullets(shortcomings.shortcomings({part.title: part.table for part in sections}))
    lines = introduction(bench) + ["## Where sigloc falls short"] + short + [""]
    for section in sections:
        if section.plot not in drawn:
            section.plot = None
        if not section.is_empty():
            lines += section.lines()
    while not lines[-1]:
        lines.pop()
    if len(lines) > MAX_LINES:
        raise BadInput(f"RESULTS.md would have {len(lines)} lines, more than {MAX_LINES}")
    return "\n".join(lines) + "\n"


def write(out, folder):
    bench = Bench(out)
    if bench.is_quick and folder.resolve() != out.resolve():
        raise BadInput(f"{out}: a quick bench is written into its own folder only, not {folder}")
    drawn = plots.all_plots(bench)
    text = page(bench, drawn)
    try:
        images = folder / "images"
        images.mkdir(parents=True, exist_ok=True)
        for name, png in drawn.items():
            (images / name).write_bytes(png)
        (folder / "RESULTS.md").write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{error.filename}: {error.strerror}") from None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path, help="folder that scripts/bench wrote")
    parser.add_argument("folder", type=pathlib.Path, help="gets RESULTS.md and images/")
    arguments = parser.parse_args()
    try:
        write(arguments.out, arguments.folder)
    except BadInput as error:
        print(f"write_results.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
