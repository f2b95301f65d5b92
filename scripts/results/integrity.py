# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""How often a claim misleads, in the figures that safety cases are made of."""
from results import drives, simulated
from results.numbers import NONE, bootstrap, number, share, upper_bound
from results.page import Section, Table

MISLEADING = "How often a claim misleads"
COVERAGE = "Risk against coverage, one scan"
RELIABILITY = "What the published probability is worth"

METHOD = "signature"
APART = "Recorded wake-ups that do not overlap"
# Run, name of its row, whether the odometry was recorded, whether nothing was fitted to the building.
LOGS_APART = (
    ("apart-campus", "campus", True, False),
    ("apart-uwb", "uwb", True, False),
    *((f"apart-{place}{part}", place + part.replace("-", ", "), recorded, is_new)
      for place, recorded, is_new in (
          ("intel", True, False), ("aces", True, False), ("freiburg-101", False, False),
          ("fhw", False, True), ("acapulco", False, True), ("infinite-corridor", False, True),
          ("orebro", False, True))
      for part in ("", "-reversed")),
)
LANDMARKS_APART = (("apart-dlr", "dlr, landmarks"), ("apart-victoria-park", "victoria-park, landmarks"))
FULLY_MAPPED = ("sim-mapped", "sim-moved", "sim-clutter")
RIGHT_METRES, RIGHT_DEGREES = 0.5, 10
THRESHOLDS = (0.0, 0.5, 0.7, 0.9, 0.95, 0.99)
WEIGHTS = (0.5, 0.7, 0.9, 0.97, 0.99, 1.0)


def laser_drives():
    return [run for run, name, _ in drives.DRIVES if not name.endswith("landmarks")]


def runs_at_home(bench):
    """Names of the runs of recorded drives with a laser in their own map."""
    return [run for run in laser_drives() if bench.method(run, METHOD)]


class Exposure:
    """Wake-ups of some runs: how many misled, and how far and long they drove."""

    def __init__(self):
        self.wake_ups = self.misled = self.metres = self.seconds = 0

    def add(self, bench, run, group=None):
        """Adds the drives of a run: all, or those of one kind of world."""
        steps = [row for row in bench.rows(run, "results.csv") if row["method"] == METHOD]
        chosen = {}
        for row in bench.rows(run):
            if row["method"] == METHOD and group in (None, row["group"]):
                chosen[row["start"]] = int(row["wrong_steps"]) > 0
        self.wake_ups += len(chosen)
        self.misled += sum(chosen.values())
        last = {row["start"]: row for row in steps if row["start"] in chosen}
        self.metres += sum(float(row["travelled_m"]) for row in last.values())
        self.seconds += sum(float(row["seconds"] or 0) for row in last.values())

    def cells(self):
        per_cent = 100 * self.misled / self.wake_ups
        most = 100 * upper_bound(self.misled, self.wake_ups)
        return (self.wake_ups, self.misled, number(per_cent, 2), number(most, 2),
                number(self.metres / 1000, 2), number(self.seconds / 3600, 2))  # fmt: skip


def exposures(bench):
    """Each row's name with its runs and the kind of world, None for all."""
    rows = [("recorded drives, own map", [(run, None) for run in runs_at_home(bench)]),
            ("recorded drives, own map, no two overlapping",
             [(run, None) for run, *_ in LOGS_APART if bench.method(run)]),
            ("recorded drives, another building's map",
             [(run, None) for run in bench.named("drives-")])]  # fmt: skip
    for kind in simulated.KINDS:
        parts = [(run, kind) for run in FULLY_MAPPED if bench.method(run)]
        rows.append((f"simulated {kind}, whole map", parts))
    for run, name in simulated.CONDITIONS:
        if run not in FULLY_MAPPED and bench.method(run):
            rows.append((f"simulated, {name}", [(run, None)]))
    for kind in simulated.KINDS:
        run = f"sim-foreign-{kind}"
        rows.append((f"simulated {kind}, another one's map", [(run, None)] if bench.method(run) else []))
    return rows


def misleading(bench):
    table = Table("world", "wake-ups", "misled", "per cent", "at most, 95 %", "km", "hours")
    for name, parts in exposures(bench):
        exposure = Exposure()
        for run, group in parts:
            exposure.add(bench, run, group)
        if exposure.wake_ups:
            table.add(name, *exposure.cells())
    text = (
        "Asked: what is the probability of hazardously misleading information, for one wake-up?",
        "A wake-up *misled* when any step of its drive was wrong.",
        "*At most* is the exact one-sided 95 % bound of Clopper and Pearson, in per cent.",
        "*Whole map* pools the simulated drives as mapped, with moved furniture and with clutter.",
        "Drives that share a log or a world are not independent, so the bounds are somewhat too low.",
    )
    return Section(MISLEADING, table, text, "integrity.png")


def rows_apart(bench):
    """Each row of the table of drives that do not overlap: its name and its runs."""
    logs = [entry for entry in LOGS_APART if bench.method(entry[0])]
    rows = [(name, [run]) for run, name, *_ in logs]
    if logs:
        rows += [("all with lasers", [run for run, *_ in logs]),
                 ("of them, odometry recorded", [run for run, _, recorded, _ in logs if recorded]),
                 ("of them, fhw, acapulco, infinite-corridor, orebro",
                  [run for run, _, _, is_new in logs if is_new])]  # fmt: skip
    rows += [(name, [run]) for run, name in LANDMARKS_APART if bench.method(run)]
    return [(name, runs) for name, runs in rows if runs]


def ends(bench, run):
    """How many drives of a run end right, and how many there are."""
    return bench.method(run, METHOD)["right_at_end_counts"]


def apart(bench):
    table = Table("drive", "wake-ups", "right at the end", "resampled by logs", "misled",
                  "at most, 95 %", "km")  # fmt: skip
    for name, runs in rows_apart(bench):
        exposure = Exposure()
        for run in runs:
            exposure.add(bench, run)
        counts = [ends(bench, run) for run in runs]
        right = sum(count for count, _ in counts)
        resampled = NONE
        if len(counts) > 1:
            low, high = bootstrap(counts)
            resampled = f"{low:.2f}-{high:.2f}"
        _, misled, _, most, metres, _ = exposure.cells()
        table.add(name, exposure.wake_ups, share(right, exposure.wake_ups), resampled, misled, most, metres)
    text = (
        "Asked: the same, with no step of a log in two drives, nor in a map and a drive.",
        "Robots wake up on mapped area as often as 20 m of drive fit one behind another.",
        "60 % of a log are the map, the first or (*reversed*) the last; campus and uwb have maps of their own.",
        "From freiburg-101 on the odometry is made from corrected poses: 5 % of the way, 0.025 rad a metre and a radian.",
        "*Resampled by logs* is the 95 % interval of a bootstrap whose blocks are whole rows.",
        "It tells nothing about what never happened: *at most* is the exact bound.",
    )
    return Section(APART, table, text)


def first_answers(bench):
    """Probability of the first candidate and whether it is right, of every recorded scan."""
    answers = []
    for run in bench.named("scan-"):
        right = {row["query"]: row["rank_of_right"] == "1" for row in bench.rows(run, "results.csv")
                 if row["method"] == METHOD and row["rank_of_right"] != ""}  # fmt: skip
        first = {row["query"]: float(row["probability"])
                 for row in bench.rows(run, "candidates.csv")
                 if row["method"] == METHOD and row["rank"] == "1"}  # fmt: skip
        answers += [(first.get(query, 0.0), is_right) for query, is_right in right.items()]
    return answers


def covered(answers, threshold):
    """How many answers have at least this probability, and how many of those are not right."""
    chosen = [is_right for probability, is_right in answers if probability >= threshold]
    return len(chosen), len(chosen) - sum(chosen)


def coverage(bench):
    table = Table("answers of at least", "coverage", "not right", "risk %", "at most, 95 %")
    answers = first_answers(bench)
    for threshold in THRESHOLDS if answers else ():
        count, wrong = covered(answers, threshold)
        cells = (NONE, NONE)
        if count:
            cells = (number(100 * wrong / count, 2), number(100 * upper_bound(wrong, count), 2))
        table.add(f"{threshold:.2f}", share(count, len(answers)), f"{wrong} of {count}", *cells)
    text = (
        "Asked: who takes only first answers of some probability, how many does he get, how many are not right?",
        "*Not right* is stricter than wrong. The answers are those of the recorded scans in their own map.",
    )
    return Section(COVERAGE, table, text)


def weighed_steps(bench, runs):
    """Weight of the first hypothesis and whether it is right, None without truth, of every step."""
    steps = []
    for run in runs:
        for row in bench.rows(run, "results.csv"):
            if row["method"] != METHOD or row["weight"] == "":
                continue
            judged = None
            if row["error_m"] != "":
                judged = (float(row["error_m"]) <= RIGHT_METRES
                          and float(row["error_deg"]) <= RIGHT_DEGREES)  # fmt: skip
                if row["mapped"] != "1":
                    continue
            steps.append((float(row["weight"]), judged))
    return steps


def weight_bins():
    return list(zip((0.0,) + WEIGHTS[:-1], WEIGHTS))


def in_bin(steps, low, high):
    return [right for weight, right in steps
            if low <= weight and (weight < high or high == 1.0)]  # fmt: skip


def at_home_and_away(bench):
    """The steps of recorded drives, of simulated ones, and of all in another place's map."""
    at_home = [step for step in weighed_steps(bench, runs_at_home(bench)) if step[1] is not None]
    simulations = [run for run in FULLY_MAPPED if bench.method(run)]
    imitated = [step for step in weighed_steps(bench, simulations) if step[1] is not None]
    elsewhere = bench.named("drives-") + bench.named("sim-foreign-") + bench.named("same-size-")
    return at_home, imitated, weighed_steps(bench, elsewhere)


def reliability(bench):
    table = Table("weight of the first", "recorded: steps", "recorded: right", "simulated: steps",
                  "simulated: right", "another place's map: steps", "of all there %")  # fmt: skip
    at_home, imitated, away = at_home_and_away(bench)
    for low, high in weight_bins() if at_home or imitated else ():
        cells = []
        for steps in (at_home, imitated):
            right = in_bin(steps, low, high)
            cells += [len(right), number(sum(right) / len(right), 3) if right else NONE]
        count = len(in_bin(away, low, high))
        table.add(f"{low:.2f}-{high:.2f}", *cells, count,
                  number(100 * count / len(away), 2) if away else NONE)  # fmt: skip
    text = (
        "Asked: of the steps whose first pose had such a weight, how many were right?",
        "A perfect publisher is right as often as it says; in another place's map it never is.",
        "Steps of one drive hang together, so there are no intervals.",
    )
    return Section(RELIABILITY, table, text)
