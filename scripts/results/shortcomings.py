# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Where the figures fall short: a sentence or two each, from the tables that are there."""
from results import drives, integrity, opponents, scans, simulated
from results.numbers import NONE


def shortcomings(tables):
    """Bullets from the page's tables by title."""
    makers = (one_scan, others_ahead, features, wrong_scans, filter_ahead, recorded, apart, landmark_tracking, moved, cluttered, half_mapped,
              no_odometry, foreign_kind, foreign_size, sweep)  # fmt: skip
    return [text for text in (maker(tables) for maker in makers) if text]


def one_scan(tables):
    table = tables[scans.ONE_SCAN]
    low = table.extreme("right@1", scans.whole_scans(table))
    return (f"**One scan**: on {low} the first answer is right in {table.cell(low, 'right@1')}, "
            f"among ten answers in {table.cell(low, 'right@10')}.")  # fmt: skip


def others_ahead(tables):
    """Where the search of every pose, or another method, finds more than sigloc."""
    table = tables[scans.ONE_SCAN]
    parts = []
    for name in table.rows:
        theirs, ours = (table.cell(name, column) for column in ("exhaustive right@1", "right@1"))
        if theirs != NONE and float(theirs.split()[0]) > float(ours.split()[0]):
            parts.append(f"On {name}, `exhaustive` {theirs.split()[0]}, sigloc {ours.split()[0]}.")
    table = tables[opponents.OPPONENTS]
    for place, method, theirs, ours in opponents.wins(table.head, table.named_cells()):
        parts.append(f"On {place}, `{method}` {theirs}, sigloc {ours}.")
    return f"**Other methods find more**: {' '.join(parts)}" if parts else None


def filter_ahead(tables):
    table = tables[drives.FILTER]
    parts = []
    for place in drives.FILTER_PLACES:
        names = [name for name in table.rows if name.startswith(f"{place}, ")]
        right = {name: float(table.cell(name, "right at the end").split()[0]) for name in names}
        best = max(names, key=right.get, default=None)
        if best and right[best] > right[names[0]]:
            parts.append(f"On {best} {right[best]:.3f}, sigloc {right[names[0]]:.3f}.")
    return f"**MRPT's filter ends right more often**: {' '.join(parts)}" if parts else None


def features(tables):
    table = tables[scans.ONE_SCAN]
    parts = [f"{table.cell(name, 'localized, right')} right and {table.cell(name, 'localized, wrong')} wrong of "
             f"{table.cell(name, 'scans')} on {name.split(',')[0]}"
             for name in table.rows if name.endswith(scans.FEATURES)]  # fmt: skip
    if not parts:
        return None
    return f"**Features alone claim little**: *localized* are {'; '.join(parts)}."


def wrong_scans(tables):
    """Every row of single scans at home that has a wrong claim."""
    parts = []
    for title in (scans.ONE_SCAN, opponents.CBGL):
        table = tables[title]
        for name in table.rows:
            right, wrong = (table.cell(name, f"localized, {kind}") for kind in ("right", "wrong"))
            if wrong:
                parts.append(f"{name} ({wrong}, {right} right)")
    return f"**Wrong claims of one scan**: {'; '.join(parts)}." if parts else None


def recorded_drives(table):
    """The drive of which the fewest starts end right, and every one with a wrong start."""
    rows = drives.laser_rows(table)
    low = table.extreme("right at the end", rows)
    wrong = [name for name in rows if table.cell(name, "wrong at some step")]
    text = f"fewest end right on {low}: {table.cell(low, 'right at the end')}."
    if wrong:
        counts = ", ".join(f"{name} ({table.cell(name, 'wrong at some step')} of "
                           f"{table.cell(name, 'starts')})" for name in wrong)  # fmt: skip
        text += f" Wrong at some step: {counts}."
    return text


def recorded(tables):
    return f"**Recorded drives**: {recorded_drives(tables[drives.WAKE_UPS])}"


def apart(tables):
    table = tables[integrity.APART]
    logs = [name for _, name, *_ in integrity.LOGS_APART + integrity.LANDMARKS_APART if name in table.rows]
    misled = [f"{name} ({table.cell(name, 'misled')} of {table.cell(name, 'wake-ups')})" for name in logs
              if table.cell(name, "misled")]  # fmt: skip
    return f"**Recorded drives that do not overlap**: misled are {', '.join(misled)}." if misled else None


def landmark_tracking(tables):
    table = tables[drives.WAKE_UPS]
    name = "dlr, landmarks"
    if name not in table.rows:
        return None
    return (f"**Tracking by landmarks**: on dlr {table.cell(name, 'right at the end')} of "
            f"{table.cell(name, 'starts')} starts end right, and "
            f"{table.cell(name, 'wrong at some step')} are wrong at some step.")  # fmt: skip


def simulated_row(tables, name, title, word):
    table = tables[simulated.WAKE_UPS]
    if name not in table.rows:
        return None
    return (f"**{title}**: {word} {table.cell(name, 'right at the end')} end right; wrong at some step "
            f"are {table.cell(name, 'wrong at some step %')}.")  # fmt: skip


def moved(tables):
    name = "half of the furniture moved: corridor"
    return simulated_row(tables, name, "Moved furniture", "in corridors")


def cluttered(tables):
    return simulated_row(tables, "30 % of the beams end early: all", "Clutter", "with 30 % of the beams lost")


def half_mapped(tables):
    name = "half of the world mapped: all"
    return simulated_row(tables, name, "Unmapped copies", "with half a map")


def no_odometry(tables):
    text = simulated_row(tables, "no odometry: all", "No odometry", "simulated,")
    table = tables[drives.SCANS_ALONE]
    if text is None or not table.rows:
        return text
    return f"{text} Recorded drives: {recorded_drives(table)}"


def foreign_row(tables, name, title):
    """The kinds of world with claims, in clear view and among clutter."""
    table = tables[simulated.FOREIGN]
    claims = []
    for row, among in ((name, ""), (f"{name}, {simulated.CLUTTER}", " under clutter")):
        cells = {kind: table.cell(row, kind) for kind in simulated.KINDS} if row in table.rows else {}
        claims += [f"in {kind}s{among} {cell}" for kind, cell in cells.items()
                   if cell != NONE and not cell.startswith("0 ")]  # fmt: skip
    return f"**{title}**: claimed at some step are, {'; '.join(claims)}." if claims else None


def foreign_kind(tables):
    return foreign_row(tables, simulated.SAME_KIND, "Another building of the same kind")


def foreign_size(tables):
    return foreign_row(tables, simulated.SAME_SIZE, "The same outer walls, other contents")


def sweep(tables):
    table = tables[simulated.SWEEPS]
    low = simulated.hardest(table)
    if low is None:
        return None
    value, rest = table.cell(low, "hardest: right@1").split(": ")
    wrong = [f"{table.cell(name, 'wrong claims of all')} over {name}" for name in table.rows
             if not table.cell(name, "wrong claims of all").startswith("0 ")]  # fmt: skip
    claims = f" Wrong claims: {'; '.join(wrong)}." if wrong else ""
    return f"**Harder worlds**: over {low}, at {value}, the first answer is right in {rest}.{claims}"
