# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the folder that scripts/bench writes: its list of runs, their summaries and tables."""
import csv
import json
import pathlib


class BadInput(Exception):
    """What is wrong with an input, in one line."""


def read_text(path):
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "no UTF-8 text"
        raise BadInput(f"{path}: {reason}") from None


class Bench:
    """The runs of one bench; a run that was not asked for is None wherever it is asked about."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.command = read_text(self.folder / "command").strip()
        rows = list(csv.DictReader(read_text(self.folder / "runs.csv").splitlines()))
        if not rows or set(rows[0]) != {"run", "seconds"}:
            raise BadInput(f"{self.folder / 'runs.csv'}: lists no runs")
        self.seconds = {row["run"]: int(row["seconds"]) for row in rows}
        self.summaries = {name: self._read_summary(name) for name in self.seconds}
        self.provenance = self._check_provenance()

    @property
    def is_quick(self):
        return "--quick" in self.command.split()

    def _read_summary(self, name):
        path = self.folder / name / "summary.json"
        try:
            summary = json.loads(read_text(path))
            summary["provenance"]["commit"]  # pylint: disable=pointless-statement
        except (json.JSONDecodeError, KeyError, TypeError):
            raise BadInput(f"{path}: no summary of sigloc-eval") from None
        return summary

    def _check_provenance(self):
        """All runs must be of one clean commit; returns the first run's provenance."""
        runs_of = {}
        for name, summary in self.summaries.items():
            runs_of.setdefault(summary["provenance"]["commit"], []).append(name)
        if len(runs_of) > 1:
            listed = ", ".join(f"{commit} ({names[0]})" for commit, names in runs_of.items())
            raise BadInput(f"{self.folder}: runs of different commits: {listed}")
        commit = next(iter(runs_of))
        if commit == "unknown" or commit.endswith("-dirty"):
            raise BadInput(f"{self.folder}: built from '{commit}', which is no clean commit")
        return next(iter(self.summaries.values()))["provenance"]

    def summary(self, run):
        return self.summaries.get(run)

    def method(self, run, method="signature"):
        """The summary of a method in a run, or None."""
        return (self.summary(run) or {}).get("methods", {}).get(method)

    def rows(self, run, file="runs.csv"):
        """The rows of a run's table; [] for a run that was not asked for."""
        if run not in self.summaries:
            return []
        path = self.folder / run / file
        return list(csv.DictReader(read_text(path).splitlines()))

    def named(self, prefix):
        """Names of the runs that begin so, in the order they were made."""
        return [name for name in self.seconds if name.startswith(prefix)]
