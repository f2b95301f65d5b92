# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What single scans give."""
from results import data_use
from results.numbers import number, rare, share, times
from results.page import Section, Table

ONE_SCAN = "One scan, whole map"
FOREIGN = "Scans and drives in maps of other buildings"

FEATURES = ", features alone"
SCANS = ("lab", "uwb", "campus", "intel", "aces", "freiburg-101", "fhw-reversed",
         "acapulco-reversed", "infinite-corridor-reversed", "orebro", "city")  # fmt: skip


def label(run):
    return run.replace("-reversed", " reversed")


def one_scan(bench):
    table = Table("data", "scans", "right@1", "right@10", "localized, right", "localized, wrong",
                  "localized, between", "median ms", "exhaustive right@1", "exhaustive takes",
                  "lattice takes")  # fmt: skip
    runs = [(label(name), f"scan-{name}") for name in SCANS]
    runs += [(name + FEATURES, f"features-{name}") for name in ("campus", "intel")]
    everything, new, alone = Claims(), Claims(), Claims()
    for name, run in runs:
        method = bench.method(run)
        if method is None:
            continue
        median = method["time_ms"]["median"]
        others = [bench.method(run, other) for other in ("exhaustive", "lattice")]
        ratios = [times(other and other["time_ms"]["median"] / median) for other in others]
        table.add(name, method["queries"], share(*method["recall_at_1_counts"]),
                  number(method["recall_at_10"], 3), method["confident_right"],
                  method["confidently_wrong"], method["inaccurate"], number(median, 2),
                  share(*others[0]["recall_at_1_counts"]) if others[0] else "-",
                  *ratios)  # fmt: skip
        if name.endswith(FEATURES):
            alone.add(method)
        else:
            everything.add(method)
            if data_use.is_new(name):
                new.add(method)
    low = table.extreme("right@1", whole_scans(table))
    text = (
        "Asked: where in the map was one scan taken, at which heading?",
        "`exhaustive` scores every free pose 0.2 m and 3 degrees apart by 50 returns, and refines the best 400.",
        "It does so in a raster of 0.1 m, or in the map's own cells (campus, uwb).",
        "`lattice` gives sigloc's judgement every free pose 0.4 m and 6 degrees apart.",
        "*Takes* is the ratio of median times in the same run.",
        f"*Localized* are, of the sets that the verdict was not fitted to, without city, {new.said()}.",
        f"Of all scans it is {everything.said()}, and by features alone {alone.said()}.",
        f"The first answer is right least often on {low}: {table.cell(low, 'right@1')}.",
        "*Between* is neither right nor wrong.",
        "*Features alone* (`--no-dense`) uses only walls, corners and pillars, as in maps of landmarks.",
        "Scans of one log overlap, so that the intervals are somewhat too narrow.",
    )
    return Section(ONE_SCAN, table, text)


class Claims:
    """How many scans were asked, claimed, and claimed wrongly."""

    def __init__(self):
        self.asked = self.claimed = self.wrong = 0

    def add(self, method):
        self.asked += method["queries"]
        self.claimed += method["confident"]
        self.wrong += method["confidently_wrong"]

    def said(self):
        return f"{self.claimed} of {self.asked}, {self.wrong} wrongly"


def whole_scans(table):
    """The rows that are not of features alone."""
    return [name for name in table.rows if not name.endswith(FEATURES)]


def foreign(bench):
    table = Table("of ... in the map of", "scans", "scans claimed %", "drives",
                  "drives claimed at some step %")  # fmt: skip
    pairs = dict.fromkeys(run.split("-", 1)[1] for kind in ("scans-", "drives-")
                          for run in bench.named(kind))  # fmt: skip
    sums = [0, 0, 0, 0]
    for pair in pairs:
        found = [bench.method(f"{kind}-{pair}") for kind in ("scans", "drives")]
        counts = []
        for method, key in zip(found, ("confident", "confidently_wrong")):
            counts += [method[key], method["queries"]] if method else [0, 0]
        is_trained = data_use.is_trained_pair(pair)
        name = pair.replace("-in-", " in ") + (data_use.TRAINED_MARK if is_trained else "")
        table.add(name, *cells(counts))
        if not is_trained:
            sums = [a + b for a, b in zip(sums, counts)]
    if pairs:
        table.add("all but those trained on", *cells(sums))
    text = (
        "Asked: is a scan of another building claimed, or any step of a drive of 15 m? Every claim is wrong.",
        f"Of {sums[1]} scans {sums[0]} are claimed, of {sums[3]} drives {sums[2]}, of pairs not trained on.",
        "(7.2) was fitted to scans of the pairs *trained on*; the last row leaves their drives out, too.",
        "It keeps intel in campus, though intel was trained on in other maps.",
        "The prior of (8.22) was chosen with drives of acapulco, fhw and infinite-corridor in view, foreign ones too.",
        "Scans and starts of one log overlap and are not independent.",
    )
    return Section(FOREIGN, table, text)


def cells(counts):
    claimed, scans, wrong, drives = counts
    return (scans or "-", rare(claimed, scans), drives or "-", rare(wrong, drives))
