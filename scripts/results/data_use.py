# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Which data something was fitted to or chosen on. docs/lab-notes/choices-and-data.md has the sources."""
from results.page import Section, Table

DATA = "Data"
# Recorded sets that (7.1) and (7.2) were fitted to: TRAIN_RECORDED of scripts/fit_verdict.
TRAINED = ("aces", "freiburg-101", "intel")
REPEATED = ("city",)  # its scans are those of other sets
TRAINED_MARK = ", trained on"

NONE = "nothing"
# Set, what was fitted to it, what was chosen or kept with it in view.
USES = (
    ("aces", "(7.1), (7.2)", "ridges (6.12), σ (6.14), the claim of `mcl-best`"),
    ("freiburg-101", "(7.1), (7.2)", "ridges (6.12), steps of the last refinement"),
    ("intel", "(7.2)", "(4.11), (6.12), (6.14), search budgets, what the search drops, σ_turn, the filter's noise; by its wake-ups, kidnapped "
     "ones too, the tracker's rules"),
    ("campus", NONE, "(6.14), (7.7), search budgets, what the search drops, σ_turn, walls slid; by its wake-ups the tracker's rules"),
    ("fhw", NONE, "(4.11), `X` in (7.2), (6.14), walls slid, what the search drops; by its wake-ups the prior and the tracker's rules"),
    ("acapulco", NONE, "walls slid, `X` in (7.2), (6.14); by its wake-ups the prior and the tracker's rules"),
    ("infinite-corridor", NONE, "the sharp likelihood in (6.8), (6.14), the form of (7.8), walls slid, what the search drops; by its wake-ups the "
     "prior and the tracker's rules"),
    ("orebro", NONE, "walls slid, (6.14), what the search drops"),
    ("uwb", NONE, "(7.6)"),
    ("dlr", NONE, "rules of tracking by landmarks, which numbers (8.23) takes"),
    ("victoria-park", NONE, "posts in the open, rules of tracking by landmarks; its map is of the same log"),
    ("lab", NONE, "it was looked at; no choice is on record"),
    ("city", "as intel and aces", "the form of (7.8), walls slid, what the search drops; its scans are those of intel, aces, fhw, acapulco, "
     "infinite-corridor and orebro"),
)  # fmt: skip


def is_trained_pair(pair):
    """Whether "A-in-B" names two buildings that (7.2) was fitted to, with scans of one in the other."""
    return all(place in TRAINED for place in pair.split("-in-"))


def place_of(name):
    """The data set of a run's or row's name: "fhw-reversed", "intel, reversed" and "lab" are of one each."""
    return name.removesuffix("-reversed").split(",")[0].split(" ")[0]


def is_new(name):
    """Whether the verdict was not fitted to a set, and no other row has its scans."""
    return place_of(name) not in TRAINED + REPEATED


def data(_bench):
    table = Table("data", "fitted to it", "chosen or kept with it in view")
    for row in USES:
        table.add(*row)
    text = (
        "Numbers in brackets are equations of [algorithm.md](../algorithm.md).",
        "**No recorded set is wholly untouched**: with each in view something was chosen, or it was looked at.",
        "(7.2) was fitted to foreign pairs of its three sets, too, and to simulated seeds 7301 to 7303.",
        "(7.8) was fitted to simulated offices and corridors of seeds 5431 and 5481 to 5485.",
        "(8.22) was fitted to simulated seeds 7100 to 7108, (8.23) to 7200 to 7204.",
        "Choices were made with seeds below 928, 4102 to 4417, 8100 to 8508, 9101 to 9326, 9917 and 95001 to 95019 in view.",
        "The form of (8.22) was last chosen on 95001 to 95019, its prior on those and the recorded wake-ups named below.",
        "Seeds 5701 to 5714 and 57102 to 57449 were first asked by this bench.",
    )
    return Section(DATA, table, text)
