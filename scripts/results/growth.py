# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What growing maps cost, and how well a robot knows that it is lost."""
from results.numbers import Z, exponent, number, share, times
from results.page import Section, Table

GROWTH = "Growth, maps of landmarks"
AREA = "Growth, offices side by side"
LOST = "Am I lost?"
METHODS = ("signature", "signature-anchors", "jcbb")


def curve(bench, method, over_observed=False):
    """Rows of a method as the map grows, or as what is seen does; [] without the run."""
    return [row for row in bench.rows("growth", "results.csv")
            if row["method"] == method and (int(row["wanted"]) > 0) == over_observed]  # fmt: skip


def points(rows, x):
    return [(float(row[x]), float(row["time_ms_median"])) for row in rows]


def growth(bench):
    sizes = sorted({int(row["map_features"]) for row in curve(bench, "signature")})
    if not sizes:
        return Section(GROWTH, Table("method"))
    low, high = sizes[0], sizes[-1]
    table = Table("method", f"right, {high} points", f"ms, {low} points", f"ms, {high} points",
                  "ratio", "exponent of time in the map's size",
                  "exponent of time in what is seen")  # fmt: skip
    for method in METHODS:
        rows = curve(bench, method)
        of_size = {int(row["map_features"]): row for row in rows}
        if low not in of_size or high not in of_size:
            continue
        first, last = (float(of_size[size]["time_ms_median"]) for size in (low, high))
        table.add(method, share(int(of_size[high]["success"]), int(of_size[high]["cases"])),
                  number(first, 3), number(last, 3), times(last / first),
                  exponent(points(rows, "map_features")),
                  exponent(points(curve(bench, method, True), "observed")))  # fmt: skip
    text = (
        "Asked: how does the time of one answer grow with the map, and with what is seen?",
        f"Points at constant density, {len(sizes)} sizes; 30 % of about 25 observations are spurious.",
        "Exponents are slopes between logarithms; with so few rows Student's t makes wide intervals.",
        f"From {low} to {high} points our time grows {table.cell('signature', 'ratio')} times, that of "
        f"`jcbb` {table.cell('jcbb', 'ratio')} times.",
        "Walls are not varied. Few points in view leave many look-alikes: a negative slope says that.",
    )
    return Section(GROWTH, table, text, "growth.png")


def area(bench):
    rows = [row for row in bench.rows("growth-area", "results.csv") if row["method"] == "signature"]
    table = Table("area m²", "features", "recall@1", "ms median", "ms 95 %", "map built in s")
    for row in rows:
        table.add(number(float(row["area_m2"]), 0), row["map_features"],
                  share(int(row["success"]), int(row["cases"])),
                  number(float(row["time_ms_median"]), 3), number(float(row["time_ms_p95"]), 3),
                  number(float(row["map_build_s"]), 1))  # fmt: skip
    if not rows:
        return Section(AREA, table)
    building = [(float(row["area_m2"]), float(row["map_build_s"])) for row in rows]
    text = (
        "Asked: what does one scan cost, and how often is it right, as more buildings are mapped?",
        "Offices of 48 m × 15 m, each of its own seed; rooms stay as large as they are.",
        f"Exponent of the median time in the area: {exponent(points(rows, 'area_m2'))}.",
        f"Exponent of the time of building the map: {exponent(building)}.",
    )
    return Section(AREA, table, text)


def lost(bench):
    clutter = (bench.summary("reliability") or {}).get("clutter", {})
    table = Table("measure", *(f"{100 * float(share_of):.0f} % clutter" for share_of in clutter))
    for measure, name in (("signature", "signature"), ("mrpt", "MRPT")):
        cells = []
        for judged in clutter.values():
            area, half = judged[measure]["auc"], Z * judged[measure]["auc_sigma"]
            cells.append(f"{area:.3f} ({area - half:.3f}-{min(1, area + half):.3f})")
        if cells:
            table.add(name, *cells)
    text = (
        "Asked: does a tracked pose look right or wrong from one scan?",
        "Area under the ROC curve of right poses against look-alikes, simulated (1 is perfect).",
        "MRPT's measure is its own reliability of a scan in a grid map.",
        lost_said(table),
    )
    return Section(LOST, table, text)


def lost_said(table):
    if not table.rows:
        return ""
    ahead = sum(ours > other for ours, other in zip(*table.rows.values()))
    return f"Ours is ahead at {ahead} of {len(table.head) - 1} shares of clutter."
