# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""How often a claim misleads, in the figures that safety cases are made of."""
from results import data_use, drives, simulated
from results.numbers import NONE, bootstrap, number, share, upper_bound
from results.page import Section, Table

MISLEADING = "How often a claim misleads"
COVERAGE = "Risk against coverage, one scan"
RELIABILITY = "What the published probability is worth"

METHOD = "signature"
APART = "Recorded wake-ups that do not overlap"
MADE = ("fhw", "acapulco", "infinite-corridor", "orebro")  # odometry from corrected poses; not trained on
# Run, name of its row, whether the odometry was recorded.
LOGS_APART = (
    ("apart-campus", "campus", True),
    ("apart-uwb", "uwb", True),
    *((f"apart-{place}{part}", place + part.replace("-", ", "), recorded)
      for place, recorded in (("intel", True), ("aces", True), ("freiburg-101", False),
                              *((place, False) for place in MADE))
      for part in ("", "-reversed")),
)
LANDMARKS_APART = (("apart-dlr", "dlr, landmarks"), ("apart-victoria-park", "victoria-park, landmarks"))
FULLY_MAPPED = ("sim-mapped", "sim-moved", "sim-clutter")
RIGHT_METRES, RIGHT_DEGREES = 0.5, 10
THRESHOLDS = (0.0, 0.5, 0.7, 0.9, 0.95, 0.99)
RECORDED, SIMULATED = "recorded", "simulated, whole map"
WEIGHTS = (0.5, 0.7, 0.9, 0.97, 0.99, 1.0)


def runs_at_home(bench):
    """Runs of recorded drives with a laser in their own map, none of which repeats another's start."""
    return [run for run, name, _ in drives.DRIVES
            if not name.endswith("landmarks") and run != drives.KIDNAPPED and bench.method(run)]  # fmt: skip


def foreign_drives(bench, trained):
    return [run for run in bench.named("drives-")
            if data_use.is_trained_pair(run.removeprefix("drives-")) == trained]  # fmt: skip


class Exposure:
    """Wake-ups of some runs: how many misled, and how far and long they drove."""

    def __init__(self):
        self.wake_ups = self.misled = self.metres = self.seconds = 0
        self.claims = self.judged = 0  # steps, and those of them with a truth

    def add(self, bench, run, group=None):
        """Adds the drives of a run: all, or those of one kind of world."""
        steps = [row for row in bench.rows(run, "results.csv") if row["method"] == METHOD]
        chosen = {}
        for row in bench.rows(run):
            if row["method"] == METHOD and group in (None, row["group"]):
                chosen[row["start"]] = int(row["wrong_steps"]) > 0
        self.wake_ups += len(chosen)
        self.misled += sum(chosen.values())
        claims = [row for row in steps if row["start"] in chosen and row["confident"] == "1"]
        self.claims += len(claims)
        self.judged += sum(row["error_m"] != "" for row in claims)
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
    rows = [("recorded drives, own map", runs_at_home(bench)),
            ("the same starts of intel, kidnapped after 15 m", [drives.KIDNAPPED]),
            ("the same starts without odometry", [run for run, *_ in drives.DRIVES_ALONE]),
            ("recorded drives, own map, no two overlapping", [run for run, *_ in LOGS_APART]),
            ("recorded drives, another building's map", foreign_drives(bench, False)),
            ("recorded drives, another building's map" + data_use.TRAINED_MARK,
             foreign_drives(bench, True))]  # fmt: skip
    rows = [(name, [(run, None) for run in runs if bench.method(run)]) for name, runs in rows]
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
        "Every start counts once: kidnapped robots have a row of their own.",
        "Drives that share a log or a world are not independent, so the bounds are somewhat too low.",
    )
    return Section(MISLEADING, table, text, "integrity.png")


def rows_apart(bench):
    """Each row of the table of drives that do not overlap: its name and its runs."""
    logs = [entry for entry in LOGS_APART if bench.method(entry[0])]
    rows = [(name, [run]) for run, name, *_ in logs]
    if logs:
        rows += [("all with lasers", [run for run, *_ in logs]),
                 ("of them, odometry recorded", [run for run, _, recorded in logs if recorded]),
                 (f"of them, {', '.join(MADE)}",
                  [run for run, name, _ in logs if data_use.place_of(name) in MADE])]  # fmt: skip
    rows += [(name, [run]) for run, name in LANDMARKS_APART if bench.method(run)]
    return [(name, runs) for name, runs in rows if runs]


def ends(bench, run):
    """How many drives of a run end right, and how many there are."""
    return bench.method(run, METHOD)["right_at_end_counts"]


def by_log(bench, runs):
    """The counts of right ends of each log: the two cuts of one are a block."""
    blocks = {}
    for run in runs:
        right, cases = ends(bench, run)
        block = blocks.setdefault(data_use.place_of(run.removeprefix("apart-")), [0, 0])
        block[0] += right
        block[1] += cases
    return list(blocks.values())


def apart(bench):
    table = Table("drive", "wake-ups", "right at the end", "resampled by logs", "misled",
                  "at most, 95 %", "claimed steps with a truth", "km")  # fmt: skip
    for name, runs in rows_apart(bench):
        exposure = Exposure()
        for run in runs:
            exposure.add(bench, run)
        blocks = by_log(bench, runs)
        right = sum(count for count, _ in blocks)
        resampled = NONE
        if len(blocks) > 1:
            low, high = bootstrap(blocks)
            resampled = f"{low:.2f}-{high:.2f}"
        _, misled, _, most, metres, _ = exposure.cells()
        table.add(name, exposure.wake_ups, share(right, exposure.wake_ups), resampled, misled, most,
                  f"{exposure.judged} of {exposure.claims}", metres)
    text = (
        "Asked: the same, with no step of a log in two drives, nor in a map and a drive.",
        "Robots wake up on mapped area as often as 20 m of drive fit one behind another.",
        "60 % of a log are the map, the first or (*reversed*) the last; campus and uwb have maps of their own.",
        "From freiburg-101 on the odometry is made from corrected poses: 5 % of the way, 0.025 rad a metre and a radian.",
        "*Resampled by logs* is the 95 % interval of a bootstrap whose blocks are whole logs, both cuts together.",
        "It tells nothing about what never happened: *at most* is the exact bound.",
        "Some logs have a truth at few steps. A claim at another step is not judged: it could be wrong unseen.",
    )
    return Section(APART, table, text)


def first_answers(bench, only_new=False):
    """Probability of the first candidate and whether it is right, of every recorded scan.

    `only_new`: of the sets that the verdict was not fitted to and that repeat no other.
    """
    answers = []
    for run in bench.named("scan-"):
        if only_new and not data_use.is_new(run.removeprefix("scan-")):
            continue
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


def risk_cells(answers, threshold):
    count, wrong = covered(answers, threshold)
    cells = (NONE, NONE)
    if count:
        cells = (number(100 * wrong / count, 2), number(100 * upper_bound(wrong, count), 2))
    return (share(count, len(answers)), f"{wrong} of {count}", *cells)


def coverage(bench):
    head = ("coverage", "not right", "risk %", "at most, 95 %")
    table = Table("answers of at least", *head, *(f"all: {name}" for name in head))
    new, everything = first_answers(bench, only_new=True), first_answers(bench)
    for threshold in THRESHOLDS if everything else ():
        table.add(f"{threshold:.2f}", *risk_cells(new, threshold), *risk_cells(everything, threshold))
    text = (
        "Asked: who takes only first answers of some probability, how many does he get, how many are not right?",
        "*Not right* is stricter than wrong. The answers are those of the recorded scans in their own map.",
        "First come the sets that (7.1) and (7.2) were not fitted to; city is left out, since it repeats their scans.",
        f"*All* adds {', '.join(data_use.TRAINED)} and city: its bounds are too low.",
        "Scans of one log overlap, so both bounds are somewhat too low.",
    )
    return Section(COVERAGE, table, text)


def weighed_steps(bench, runs):
    """Of every step: the weight of the first hypothesis, whether it is right, and whether the robot is on mapped area.

    Whether it is right is None without truth.
    """
    steps = []
    for run in runs:
        for row in bench.rows(run, "results.csv"):
            if row["method"] != METHOD or row["weight"] == "":
                continue
            if run == drives.KIDNAPPED and row["kidnapped"] != "1":
                continue  # until then they drive as the robots of track-intel, step by step
            right = None
            if row["error_m"] != "":
                right = (float(row["error_m"]) <= RIGHT_METRES
                         and float(row["error_deg"]) <= RIGHT_DEGREES)  # fmt: skip
            steps.append((float(row["weight"]), right, row["mapped"] == "1"))
    return steps


def weight_bins():
    return list(zip((0.0,) + WEIGHTS[:-1], WEIGHTS))


def in_bin(steps, low, high):
    return [right for weight, right, _ in steps
            if low <= weight and (weight < high or high == 1.0)]  # fmt: skip


def steps_at_home(bench):
    """Steps with truth by where the robot is: each column of the table, in order."""
    def judged(runs):
        return [step for step in weighed_steps(bench, [run for run in runs if bench.method(run)])
                if step[1] is not None]  # fmt: skip

    recorded = judged(runs_at_home(bench) + [drives.KIDNAPPED])
    return {
        RECORDED: [step for step in recorded if step[2]],
        "recorded, off mapped area": [step for step in recorded if not step[2]],
        SIMULATED: judged(FULLY_MAPPED),
        "half of the world mapped": judged(["sim-half"]),
        "no odometry": judged(["sim-no-odometry"]),
    }


def steps_elsewhere(bench):
    """Steps of all drives in another place's map."""
    return weighed_steps(bench, [run for prefix in ("drives-", "sim-foreign-", "same-size-")
                                 for run in bench.named(prefix)])  # fmt: skip


def reliability(bench):
    at_home, away = steps_at_home(bench), steps_elsewhere(bench)
    table = Table("weight of the first", *at_home, "another place's map: steps", "of all there %")
    for low, high in weight_bins() if any(at_home.values()) else ():
        cells = []
        for steps in at_home.values():
            right = in_bin(steps, low, high)
            cells.append(f"{number(sum(right) / len(right), 3)} of {len(right)}" if right else NONE)
        count = len(in_bin(away, low, high))
        table.add(f"{low:.2f}-{high:.2f}", *cells, count,
                  number(100 * count / len(away), 2) if away else NONE)  # fmt: skip
    text = (
        "Asked: of the steps whose first pose had such a weight, how many were right? Cells give share and steps.",
        "A perfect publisher is right as often as it says; in another place's map it never is.",
        "*Recorded* are steps on mapped area. *Whole map* is as mapped, with moved furniture and with clutter.",
        "The reliability diagram above has *recorded* and *whole map*. In half-mapped worlds about half of the steps are off the mapped area.",
        "Steps without truth, drives by landmarks and those that do not overlap are in no column.",
        "Of kidnapped robots only the steps after the kidnapping count.",
        "Steps of one drive hang together, so there are no intervals.",
    )
    return Section(RELIABILITY, table, text)
