# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What other methods make of the same scans, and CBGL's experiment in our maps."""
from results.numbers import NONE, number, share, times
from results.page import Section, Table

OPPONENTS = "Other methods on the same scans"
CBGL = "CBGL's noise and gates"

OURS = "signature"
METHODS = ("exhaustive-fine", "branch-and-bound", "branch-and-bound-1", "jcbb", "jcbb-greedy",
           "jcbb-0.35", "jcbb-0.25")  # fmt: skip
PLACES = ("campus", "intel", "fhw-reversed", "acapulco-reversed", "infinite-corridor-reversed")
DLR = "landmarks-dlr"
CBGL_PLACES = ("intel", "aces", "campus")
VIEWS = (360, 270)


def columns_of(bench):
    """Each column's head, with the share of right answers and median time [ms] of each method."""
    columns = []
    for place in PLACES:
        found = {name: bench.method(f"opponents-{place}", name) for name in (OURS, *METHODS)}
        if not found[OURS]:
            continue
        answers = {name: (method["recall_at_1_counts"], method["time_ms"]["median"])
                   for name, method in found.items() if method}  # fmt: skip
        label = place.replace("-reversed", " reversed")
        columns.append((f"{label}, {found[OURS]['queries']} scans", answers))
    rows = {name: (bench.method(DLR, name) or {}).get("rows", ()) for name in (OURS, *METHODS)}
    for i, ours in enumerate(rows[OURS] if rows["jcbb-greedy"] else ()):
        answers = {name: (entries[i]["recall_at_1_counts"], entries[i]["time_ms"]["median"])
                   for name, entries in rows.items() if entries}  # fmt: skip
        steps = ours["local_map_steps"]
        columns.append((f"dlr, {steps} step{'' if steps == 1 else 's'}", answers))
    return columns


def cell(answers, name):
    if name not in answers:
        return NONE
    (right, asked), median = answers[name]
    ours = answers[OURS][1]
    cost = f"{number(median, 2)} ms" if name == OURS else f"{times(median / ours)} times"
    return f"{share(right, asked)}, {cost}"


def opponents(bench):
    columns = columns_of(bench)
    table = Table("method", *(head for head, _ in columns))
    for name in (OURS, *METHODS) if columns else ():
        table.add(name, *(cell(answers, name) for _, answers in columns))
    text = (
        "Asked: is the first answer of one scan right, and how many times our median time does it take?",
        "Evenly chosen scans of those above, in one run a place; on dlr local maps of landmarks.",
        "`exhaustive-fine` searches the raster that sigloc uses, of 5 cm where scans made the map.",
        "`branch-and-bound` refines its best ten poses, `branch-and-bound-1` its best one.",
        "`jcbb` expects half of what is seen to be mapped, `jcbb-0.35` and `-0.25` less.",
        "`jcbb-greedy` completes without branch and bound.",
    )
    return Section(OPPONENTS, table, text)


def first_number(text):
    return None if text == NONE else float(text.split()[0])


def wins(head, rows):
    """Where another method's first answer is right more often than ours: the best one of each column.

    `rows` are lists of cells, the method's name first. Yields the column's head, the method, its
    share and ours, all as text.
    """
    by_name = {row[0]: row[1:] for row in rows}
    for i, place in enumerate(head[1:]):
        shares = {name: first_number(cells[i]) for name, cells in by_name.items()}
        best = max((name for name in shares if shares[name] is not None), key=shares.get)
        if shares[best] > shares[OURS]:
            yield place, best, by_name[best][i].split()[0], by_name[OURS][i].split()[0]


def cbgl(bench):
    table = Table("map, view", "scans", "right", "localized, right", "localized, wrong", "median ms",
                  "ms, 95 %")  # fmt: skip
    for place in CBGL_PLACES:
        for view in VIEWS:
            method = bench.method(f"cbgl-{place}-{view}")
            if method:
                table.add(f"{place}, {view} degrees", method["queries"],
                          share(*method["recall_at_1_tight_counts"]), method["confident_right"],
                          method["confidently_wrong"], number(method["time_ms"]["median"], 2),
                          number(method["time_ms"]["p95"], 2))  # fmt: skip
    text = (
        "Asked: how often is the first answer within 0.5 m and 3.6 degrees, as CBGL's authors count?",
        "Scans of one beam a degree are simulated in the map itself, at random free places.",
        "Ranges err by 0.03 m, the map by 0.05 m, common to 0.2 rad of a scan.",
        "The verdict was fitted to recorded scans of intel and aces, but to none of these.",
        "CBGL itself (arXiv 2307.14247) was not run.",
        "Its authors tell 99.1 % and 94.4 %, in 1.61 s, of a real laboratory of 180 m²: another experiment.",
    )
    return Section(CBGL, table, text)
