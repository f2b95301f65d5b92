# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What recorded drives give: wake-ups, MRPT's filter and landmarks."""
from results.numbers import number, share, times
from results.page import Section, Table

WAKE_UPS = "Wake-ups on recorded drives"
FILTER = "MRPT's particle filter on the same drives"
SCANS_ALONE = "Wake-ups on recorded drives without odometry"
LANDMARKS = "Single answers from landmarks"

FILTER_PLACES = ("campus", "intel")
FILTER_METHODS = ("signature", "mcl", "mcl-tuned", "mcl-best")

KIDNAPPED = "track-intel-kidnapped"
# Run, name of the row, metres driven.
DRIVES = (
    ("track-campus", "campus", 20),
    ("track-uwb", "uwb", 20),
    ("track-intel", "intel", 15),
    ("track-fhw", "fhw", 20),
    ("track-acapulco", "acapulco", 20),
    ("track-infinite-corridor", "infinite-corridor", 20),
    ("track-orebro", "orebro", 20),
    (KIDNAPPED, "intel, kidnapped half-way", 15),
    ("track-dlr", "dlr, landmarks", 20),
    ("track-victoria-park", "victoria-park, landmarks", 20),
)
# The same starts without the odometry of the log: run, name of the row, metres driven.
DRIVES_ALONE = tuple((run.replace("track-", "alone-"), name, metres) for run, name, metres in DRIVES
                     if run != KIDNAPPED and not name.endswith("landmarks"))  # fmt: skip


def settle(method):
    settled, runs = method["settled_counts"]
    return f"{number(method['distance_to_settled_m']['median'], 1)} ({settled} of {runs})"


def row(method):
    return (share(*method["right_at_end_counts"]), method["confidently_wrong"],
            method["confidently_wrong_mapped"], settle(method))  # fmt: skip


def wake_ups(bench):
    table = Table("drive", "metres", "starts", "right at the end", "wrong at some step",
                  "of them on mapped area", "metres to settle", "sure at the end, between",
                  "signature-mcl: right at the end", "signature-mcl: wrong")  # fmt: skip
    for run, name, metres in DRIVES:
        method = bench.method(run)
        if method is None:
            continue
        other = bench.method(run, "signature-mcl")
        others = ("-", "-")
        if other is not None:
            others = (share(*other["right_at_end_counts"]), other["confidently_wrong"])
        table.add(name, metres, method["queries"], *row(method), method["inaccurate"], *others)
    text = [
        "Asked: the robot wakes up lost at places along a drive and drives on; does it end right?",
        "The end is the last step within 1 m of a mapped pose.",
        lasers_said(table),
        "*Metres to settle* is the median of the runs that are sure from some step on, be it after the end.",
        "`signature-mcl` is MRPT's filter with particles where relocation proposes poses.",
        "Rules of the tracker were chosen with these drives in view, but for uwb's and orebro's: they are no test.",
        "The odometry of fhw, acapulco, infinite-corridor and orebro is made from corrected poses.",
        "Starts of one drive overlap: the intervals treat them as independent.",
    ]
    kidnapped = bench.method(KIDNAPPED)
    if kidnapped:
        noticed, cases = kidnapped["noticed_counts"]
        text += [
            f"The {cases} robots to be kidnapped start as those of intel do, and drive the same 15 m first.",
            f"Then they are carried away: {noticed} noticed. Wrong at some step: {kidnapped['confidently_wrong']}.",
            "One that was not sure before has noticed at once.",
        ]
    return Section(WAKE_UPS, table, text, "wake-ups.png")


def scans_alone(bench):
    table = Table("drive", "metres", "starts", "right at the end", "wrong at some step",
                  "of them on mapped area", "metres to settle", "median ms a step")  # fmt: skip
    for run, name, metres in DRIVES_ALONE:
        method = bench.method(run)
        if method is not None:
            table.add(name, metres, method["queries"], *row(method), number(method["step_ms"]["median"], 2))
    text = (
        "Asked: and if the odometry of the log is left out?",
        "Without odometry a track drives on as in its last step, with 0.3 m and 0.2 rad.",
        "Most steps of infinite-corridor and orebro are longer than that, and what such a step finds may be another place.",
        "Chosen with these drives in view: a track is doubted from its first step on, "
        "and returns in free space do not excuse a low score.",
    )
    return Section(SCANS_ALONE, table, text)


def laser_rows(table):
    return [name for name in table.rows if not name.endswith("landmarks")]


def lasers_said(table):
    low = table.extreme("right at the end", laser_rows(table))
    rows = [name for name in laser_rows(table) if "kidnapped" not in name]
    wrong = sum(table.cell(name, "wrong at some step") for name in rows)
    starts = sum(table.cell(name, "starts") for name in rows)
    return (f"With lasers {wrong} of {starts} not kidnapped are wrong at some step; "
            f"fewest end right on {low}.")  # fmt: skip


def particle_filter(bench):
    table = Table("drive, method", "starts", "right at the end", "wrong at some step",
                  "of them on mapped area", "metres to settle", "CPU s to settle",
                  "median ms a step")  # fmt: skip
    for place in FILTER_PLACES:
        for method in FILTER_METHODS:
            summary = bench.method(f"mcl-{place}", method)
            if summary is not None:
                table.add(f"{place}, {method}", summary["queries"], *row(summary),
                          number(summary["cpu_s_to_settled"]["median"], 3),
                          number(summary["step_ms"]["median"], 2))  # fmt: skip
    text = (
        "Asked: what does MRPT's own filter do from the same starts, in the same run?",
        "`mcl` is as pf-localization ships it; `mcl-tuned` starts with 200 particles a free square metre.",
        "Both use one beam in twenty, and make no claims: they count as sure while the cloud is tight for 5 steps.",
        "`mcl-best` uses all beams, tempered, and claims while MRPT's own measure of reliability is high, too.",
        "Exponent and threshold were chosen on aces (`scripts/choose_filter_claim`). Few starts: read the intervals.",
        *(filter_said(table, place) for place in FILTER_PLACES),
    )
    return Section(FILTER, table, text)


def filter_said(table, place):
    rows = [name for name in (f"{place}, {method}" for method in FILTER_METHODS) if name in table.rows]
    if not rows:
        return ""
    right = [table.cell(name, "right at the end").split()[0] for name in rows]
    wrong = [str(table.cell(name, "wrong at some step")) for name in rows]
    return (f"On {place} {right[0]} of ours end right, {' and '.join(right[1:])} of the filter's; "
            f"wrong at some step are {wrong[0]}, and {' and '.join(wrong[1:])}.")  # fmt: skip


def landmarks(bench):
    table = Table("data, local map", "queries", "right", "not judged", "firm", "firm and wrong",
                  "median ms", "jcbb: right", "jcbb: firm and wrong", "jcbb takes")  # fmt: skip
    for place in ("dlr", "victoria-park"):
        entries = (bench.method(f"landmarks-{place}") or {}).get("rows", ())
        others = (bench.method(f"landmarks-{place}", "jcbb") or {}).get("rows", ())
        for i, entry in enumerate(entries):
            steps = entry["local_map_steps"]
            steps = f"{steps} step{'' if steps == 1 else 's'}" if steps else "as needed"
            median = entry["time_ms"]["median"]
            other = ("-", "-", "-")
            if others:
                other = (share(*others[i]["recall_at_1_counts"]),
                         others[i]["firm_and_wrong_counts"][0],
                         times(others[i]["time_ms"]["median"] / median))  # fmt: skip
            table.add(f"{place}, {steps}", entry["queries"], share(*entry["recall_at_1_counts"]),
                      entry["not_judged"], share(*entry["firm_counts"]), entry["firm_and_wrong_counts"][0],
                      number(median, 2), *other)  # fmt: skip
    text = (
        "Asked: where is a local map of landmarks in the map, from one answer?",
        "*Firm* answers are significant and far ahead of the second; that is not the product's verdict.",
        "*Not judged* are not right by a truth that is itself unsure by more than 0.5 m, or jumps.",
        "They count as not right, and never as wrong, even where the answer is firm.",
        "On dlr only places with more than half of their discs mapped are asked.",
        "`jcbb` draws as if half of what is seen were mapped, and completes by branch and bound.",
        landmarks_said(table),
    )
    return Section(LANDMARKS, table, text)


def landmarks_said(table):
    rows = [name for name in table.rows if name.startswith("dlr")]
    if not rows:
        return ""
    shares = [table.cell(name, "right").split()[0] for name in (rows[0], rows[-1])]
    return f"On dlr one step alone is too little: {shares[0]} are right, with the longest local maps {shares[1]}."
