# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""What simulated robots give, kind of world by kind of world."""
from results.numbers import number, rare, share
from results.page import Section, Table
from results.runs import BadInput

WAKE_UPS = "Simulated wake-ups"
FOREIGN = "Simulated drives in foreign maps"
SWEEPS = "Harder worlds, one scan"

OTHER_KIND = "of another kind"
SAME_KIND = "of the same kind"
SAME_SIZE = "of the same kind and outer size"
CLUTTER = "20 % of the beams end early"

KINDS = ("office", "corridor", "hall")
DRIVES_PER_WORLD = 2
# Run, name of its rows.
CONDITIONS = (
    ("sim-mapped", "as mapped"),
    ("sim-moved", "half of the furniture moved"),
    ("sim-clutter", "30 % of the beams end early"),
    ("sim-half", "half of the world mapped"),
    ("sim-no-odometry", "no odometry"),
)
SWEPT = ("noise", "clutter", "fov", "range", "map-noise", "furniture", "unmapped", "doors",
         "repeats")  # fmt: skip
# The value that is easiest for each quantity; the last one or the first is the hardest.
HARDEST_FIRST = {"fov", "range"}


def wake_ups(bench):
    table = Table("world", "drives", "right at the end", "wrong at some step %",
                  "metres to settle")  # fmt: skip
    for run, name in CONDITIONS:
        method = bench.method(run)
        if method is None:
            continue
        groups = method["groups"]
        for kind in (k for k in KINDS if k in groups):
            group = groups[kind]
            table.add(f"{name}: {kind}", group["queries"], *cells(group))
        table.add(f"{name}: all", method["queries"], *cells(method))
    text = (
        "Asked: a simulated robot wakes up lost and drives 20 m; does it end right, is it ever wrong?",
        "Every world has its own size, furniture and laser; two drives share it.",
        "Halls hold no furniture: *half of the furniture moved* leaves them out, in the pooled row, too.",
        "Simulated odometry and ranges err as the tracker is told: real ones can be worse.",
        f"As mapped {table.cell('as mapped: all', 'right at the end')} end right; "
        f"fewest do with {table.extreme('right at the end')}.",
    )
    return Section(WAKE_UPS, table, text, "simulated.png")


def cells(part):
    return (share(*part["right_at_end_counts"]),
            rare(part["confidently_wrong"], part["queries"]),
            number(part["distance_to_settled_m"]["median"], 1))  # fmt: skip


class Claims:
    """Drives in foreign maps and those that were claimed, of worlds that several drives share."""

    def __init__(self):
        self.drives = {}

    def add(self, world, wrong):
        self.drives.setdefault(world, []).append(wrong)

    def join(self, other):
        self.drives.update(other.drives)

    def cell(self):
        drives = [wrong for world in self.drives.values() for wrong in world]
        return rare(sum(drives), len(drives)).replace(" =", f" of {len(drives)} =", 1)

    def worlds(self):
        return f"{sum(any(world) for world in self.drives.values())} of {len(self.drives)}"


def claims_by_kind(bench, run, kind_of):
    """Claims of a simulated run; kind_of(world, worlds, group) is None for what is left out."""
    rows = bench.rows(run)
    worlds = -(-len(rows) // DRIVES_PER_WORLD)
    claims = {}
    for row in rows:
        world = int(row["start"]) // DRIVES_PER_WORLD
        kind = kind_of(world, worlds, row["group"])
        if kind is not None:
            claims.setdefault(kind, Claims()).add((run, world), int(row["wrong_steps"]) > 0)
    return claims


def of_another_kind(world, worlds, group):
    """The kind driven, if the map is of another one.

    src/eval/wakeup/wakeup_simulated.cpp: worlds are of the three kinds in turn, and world i gets the map of
    world worlds + i + i / 3.
    """
    if KINDS[world % 3] != group:
        raise BadInput(f"sim-foreign-mixed: world {world} is of kind '{group}'")
    return None if (worlds + world + world // 3) % 3 == world % 3 else group


def of_the_kind_driven(_world, _worlds, group):
    return group


def same_size_claims(bench, name, kind):
    claims = Claims()
    for run in bench.named(f"same-size-{name}-"):
        for row in bench.rows(run):
            claims.add(run, int(row["wrong_steps"]) > 0)
    return {kind: claims} if claims.drives else {}


def foreign(bench):
    table = Table("map", *KINDS, "all", "worlds with a claim")
    same, size = {}, {}
    for kind in KINDS:
        same.update(claims_by_kind(bench, f"sim-foreign-{kind}", of_the_kind_driven))
        size.update(same_size_claims(bench, kind, kind))
    other = claims_by_kind(bench, "sim-foreign-mixed", of_another_kind)
    cluttered = claims_by_kind(bench, "sim-foreign-cluttered", of_the_kind_driven)
    add_claims(table, OTHER_KIND, other)
    add_claims(table, SAME_KIND, same)
    add_claims(table, SAME_SIZE, size)
    add_claims(table, f"{SAME_KIND}, {CLUTTER}", cluttered)
    add_claims(table, f"{SAME_SIZE}, {CLUTTER}", same_size_claims(bench, "cluttered", "hall"))
    said = [f"{table.cell(name, 'all').split(' =')[0]} {name}"
            for name in (OTHER_KIND, SAME_KIND, SAME_SIZE) if name in table.rows]  # fmt: skip
    text = (
        "Asked: is any step of a drive claimed in the map of another world? Every claim is wrong.",
        f"Claimed are {', '.join(said)}.",
        "Maps of another kind are easy: no row pools them with maps of the same kind.",
        "Two drives share a world; of the same outer size, four starts share a drive of 120 m and a map.",
        "The intervals treat drives as independent; only the worlds of the last column are.",
    )
    return Section(FOREIGN, table, text)


def add_claims(table, name, claims):
    """A row: the kinds, all of them, and the worlds with a claim."""
    if not claims:
        return
    pooled = Claims()
    for part in claims.values():
        pooled.join(part)
    parts = [claims[kind].cell() if kind in claims else "-" for kind in KINDS]
    table.add(name, *parts, pooled.cell() if len(claims) > 1 else "-", pooled.worlds())


def sweeps(bench):
    table = Table("what is varied", "easiest: right@1", "hardest: right@1",
                  "claims right, wrong at the hardest", "wrong claims of all")  # fmt: skip
    for over in SWEPT:
        summary = bench.summary(f"sweep-{over}")
        if summary is None:
            continue
        rows = sorted(summary["methods"]["signature"]["rows"], key=lambda row: row["value"],
                      reverse=over in HARDEST_FIRST)  # fmt: skip
        easy, hard = rows[0], rows[-1]
        claims = (sum(row["confident"] for row in rows), sum(row["confidently_wrong"] for row in rows))
        table.add(summary["label"], *(f"{row['value']:g}: {share(*row['recall_at_1_counts'])}"
                                      for row in (easy, hard)),
                  f"{hard['confident_right']}, {hard['confidently_wrong']} of {hard['queries']}",
                  f"{claims[1]} of {claims[0]}")  # fmt: skip
    text = (
        "Asked: how does one scan's first answer suffer when one thing gets harder and all else stays?",
        "The plot has the values between for two of them, beside the `exhaustive` search.",
        sweeps_said(table),
    )
    return Section(SWEEPS, table, text, "sweeps.png")


def hardest(table):
    """Where the first answer is right least often at the hardest value, None of an empty table."""
    column = "hardest: right@1"
    return min(table.rows, key=lambda name: float(table.cell(name, column).split()[1]),
               default=None)  # fmt: skip


def sweeps_said(table):
    low = hardest(table)
    if low is None:
        return ""
    wrong = sum(int(table.cell(name, "wrong claims of all").split()[0]) for name in table.rows)
    return f"Wrong are {wrong} claims of all; the first answer suffers most from the last value of: {low}."
