# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the page's plots with gnuplot; each returns the bytes of a PNG."""
import subprocess

from results import drives, growth, integrity, simulated
from results.numbers import wilson
from results.runs import BadInput

HEAD = """set encoding utf8
set terminal pngcairo size {size} noenhanced font "sans,10"
set grid
set key outside right top
"""
DRIVES = ("track-campus", "track-intel", "track-fhw", "track-acapulco", "track-infinite-corridor",
          "track-orebro")  # fmt: skip


def draw(script, size="800,360"):
    try:
        done = subprocess.run(["gnuplot"], input=(HEAD.format(size=size) + script).encode(),
                              capture_output=True, check=False)  # fmt: skip
    except OSError:
        raise BadInput("gnuplot is missing: install the packages of scripts/packages.txt") from None
    if done.returncode != 0 or not done.stdout.startswith(b"\x89PNG"):
        reason = " ".join(done.stderr.decode(errors="replace").split())
        raise BadInput(f"gnuplot failed: {reason}")
    return done.stdout


def block(name, rows):
    lines = [" ".join(str(value) for value in row) for row in rows]
    return f"${name} << END\n" + "\n".join(lines) + "\nEND\n"


def wake_ups(bench):
    """Share of the drives that have settled and end right, over the metres driven."""
    names = {run: name for run, name, _ in drives.DRIVES}
    data, parts = "", []
    for i, run in enumerate(DRIVES):
        rows = [row for row in bench.rows(run) if row["method"] == "signature"]
        if not rows:
            continue
        settled = sorted(float(row["settled_after_m"]) for row in rows
                         if row["settled_after_m"] and row["right_at_end"] == "1")  # fmt: skip
        steps = [(0, 0)] + [(m, (k + 1) / len(rows)) for k, m in enumerate(settled)]
        data += block(f"d{i}", steps + [(20, steps[-1][1])])
        parts.append(f'$d{i} using 1:2 with steps linewidth 2 title "{names[run]}"')
    if not parts:
        return None
    return draw(data + 'set xlabel "metres driven"\nset ylabel "share settled, right at the end"\n'
                "set yrange [0:1]\nset xrange [0:20]\nplot " + ", ".join(parts) + "\n")  # fmt: skip


def simulated_drives(bench):
    """Right at the end by condition and kind of world, with intervals."""
    data, parts, ticks = "", [], []
    for i, kind in enumerate(simulated.KINDS):
        rows = []
        for x, (run, name) in enumerate(simulated.CONDITIONS):
            method = bench.method(run)
            if method is None:
                continue
            if i == 0:
                ticks.append(f'"{name.replace("%", "%%")}" {x}')
            group = method["groups"].get(kind)
            if group:
                count, cases = group["right_at_end_counts"]
                rows.append((x + 0.15 * (i - 1), count / cases, *wilson(count, cases)))
        if rows:
            data += block(f"k{i}", rows)
            parts.append(f'$k{i} using 1:2:3:4 with yerrorbars linewidth 2 pointtype 7 title "{kind}"')
    if not parts:
        return None
    return draw(data + f"set xtics ({', '.join(ticks)}) rotate by 15 right\nset xrange [-0.5:4.5]\n"
                'set bmargin 6\nset lmargin 20\nset ylabel "right at the end"\nset yrange [:1]\n'
                "plot " + ", ".join(parts) + "\n")  # fmt: skip


def sweeps(bench):
    """First answers that are right, over clutter and over moved furniture."""
    script = "set multiplot layout 1,2\nset key inside left bottom\nset yrange [0:1]\n"
    drawn = False
    for over in ("clutter", "furniture"):
        summary = bench.summary(f"sweep-{over}")
        if summary is None:
            continue
        drawn = True
        parts = []
        for i, (method, found) in enumerate(summary["methods"].items()):
            rows = [(row["value"], row["recall_at_1"], *row["recall_at_1_interval"])
                    for row in found["rows"]]  # fmt: skip
            script += block(f"{over}{i}", rows)
            parts.append(f"${over}{i} using 1:2:3:4 with yerrorlines linewidth 2 pointtype 7 "
                         f'title "{method}"')  # fmt: skip
        script += f'set xlabel "{summary["label"]}"\nset ylabel "first answer right"\n'
        script += "plot " + ", ".join(parts) + "\n"
    return draw(script + "unset multiplot\n") if drawn else None


def growing_maps(bench):
    data, parts = "", []
    for i, method in enumerate(growth.METHODS):
        points = growth.points(growth.curve(bench, method), "map_features")
        if points:
            data += block(f"g{i}", points)
            parts.append(f'$g{i} using 1:2 with linespoints linewidth 2 pointtype 7 title "{method}"')
    if not parts:
        return None
    return draw(data + 'set logscale xy\nset xlabel "points in the map"\n'
                'set ylabel "median ms"\nplot ' + ", ".join(parts) + "\n")  # fmt: skip


def risks(answers):
    """Per cent of the answers taken, most probable first, and of these per cent that are not right."""
    wrong, rows = 0, []
    for k, (_, is_right) in enumerate(answers):
        wrong += not is_right
        rows.append((100 * (k + 1) / len(answers), 100 * wrong / (k + 1)))
    return rows


def misleading(bench):
    """Risk over coverage of single answers, and the share that is right over the weight published."""
    data, curves = "set multiplot layout 1,2\nset key inside left top\n", []
    for i, (name, only_new) in enumerate((("sets not trained on", True), ("all", False))):
        answers = sorted(integrity.first_answers(bench, only_new), reverse=True)
        if answers:
            data += block(f"risk{i}", risks(answers))
            curves.append(f'$risk{i} with lines linewidth 2 title "{name}"')
    data += 'set xlabel "coverage [%]"\nset ylabel "not right [%]"\nset xrange [0:100]\nset yrange [0:]\n'
    data += f"plot {', '.join(curves)}\n"
    at_home = integrity.steps_at_home(bench)
    parts = []
    for name in (integrity.RECORDED, integrity.SIMULATED):
        steps, rows = at_home[name], []
        for low, high in integrity.weight_bins():
            right = integrity.in_bin(steps, low, high)
            if right:
                rows.append(((low + high) / 2, sum(right) / len(right)))
        if rows:
            data += block(name.split(",", maxsplit=1)[0], rows)
            parts.append(f'${name.split(",", maxsplit=1)[0]} with linespoints linewidth 2 pointtype 7 title "{name}"')
    if not curves or not parts:
        return None
    data += 'set xlabel "weight of the first pose"\nset ylabel "share right"\nset key inside right bottom\n'
    data += "set xrange [0:1]\nset yrange [0:1]\nplot x with lines dashtype 2 notitle, "
    return draw(data + ", ".join(parts) + "\nunset multiplot\n")


def all_plots(bench):
    """The plots of what was run, by file name."""
    drawn = {
        "wake-ups.png": wake_ups(bench),
        "integrity.png": misleading(bench),
        "simulated.png": simulated_drives(bench),
        "sweeps.png": sweeps(bench),
        "growth.png": growing_maps(bench),
    }
    return {name: png for name, png in drawn.items() if png is not None}
