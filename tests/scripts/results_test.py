#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/write_results.py and scripts/readme_numbers on a bench of made-up figures."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "scripts"))

from results import data_use, drives, integrity, numbers, runs, scans, simulated  # noqa: E402

COMMAND = "scripts/bench --data DIR"
KINDS = ("office", "corridor", "hall")
README = "# x\n<!-- results: old -->\nold\n<!-- /results -->\nafter\n"


def quantiles(value):
    return {"median": value, "p95": value, "mean": value}


def scan(right, queries, milliseconds, claimed=0, wrong=0):
    return {
        "queries": queries, "recall_at_1_counts": [right, queries], "recall_at_10": 1.0,
        "confident": claimed + wrong, "confident_right": claimed, "confidently_wrong": wrong,
        "recall_at_1_tight_counts": [right, queries], "inaccurate": 0, "time_ms": quantiles(milliseconds),
    }  # fmt: skip


def drive(right, runs, wrong=0):
    return {
        "queries": runs, "right_at_end_counts": [right, runs], "confidently_wrong": wrong,
        "confidently_wrong_mapped": wrong, "inaccurate": 0, "settled_counts": [right, runs],
        "distance_to_settled_m": quantiles(2.5), "cpu_s_to_settled": quantiles(0.1),
        "step_ms": quantiles(0.2),
    }  # fmt: skip


def simulated_drives(right, runs, kinds=KINDS):
    groups = {kind: drive(right, runs) for kind in kinds}
    return {**drive(right * len(kinds), runs * len(kinds)), "groups": groups}


class Bench:
    """Writes the folder that scripts/bench would."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "command").write_text(COMMAND + "\n")
        (folder / "runs.csv").write_text("run,seconds\n")

    def add(self, name, methods, rows=None, commit="abc1234"):
        (self.folder / name).mkdir()
        provenance = {"version": "9.9", "commit": commit, "mrpt": "MRPT 2.5.8", "compiler": "12",
                      "processor": "abacus", "processors": 2}  # fmt: skip
        summary = {"methods": methods, "provenance": provenance}
        (self.folder / name / "summary.json").write_text(json.dumps(summary))
        if rows is not None:
            head = "method,start,group,right_at_end,settled_after_m,wrong_steps"
            (self.folder / name / "runs.csv").write_text("\n".join([head] + rows) + "\n")
            self.add_steps(name, [row.split(",") for row in rows])
        with open(self.folder / "runs.csv", "a") as file:
            file.write(f"{name},60\n")

    def add_steps(self, name, rows):
        """Two steps of each drive: one 10 m off with a weight of 0.6, one right with 0.995."""
        lines = ["method,start,step,travelled_m,seconds,error_m,error_deg,weight,mapped,kidnapped,"
                 "confident"]
        kidnapped = int("kidnapped" in name)
        for i, (method, start, *_) in enumerate(rows):
            lines += [f"{method},{start},{i},0,0,10,0,0.6,1,0,0",
                      f"{method},{start},{i + 1},20,72,0.1,1,0.995,1,{kidnapped},1"]  # fmt: skip
        (self.folder / name / "results.csv").write_text("\n".join(lines) + "\n")

    def add_scans(self, name):
        """The rows of four queries, whose best answers have these probabilities."""
        answers = ["method,query,rank_of_right"]
        candidates = ["method,query,rank,probability"]
        for query, (rank, probability) in enumerate(((1, 0.999), (1, 0.96), (2, 0.8), (0, 0.3))):
            answers.append(f"signature,{query},{rank}")
            candidates += [f"signature,{query},1,{probability}", f"signature,{query},2,0.01"]
        (self.folder / name / "results.csv").write_text("\n".join(answers) + "\n")
        (self.folder / name / "candidates.csv").write_text("\n".join(candidates) + "\n")

    def fill(self):
        for name in ("campus", "intel", "fhw-reversed", "infinite-corridor-reversed"):
            self.add(f"scan-{name}", {"signature": scan(87, 99, 0.5, 48), "exhaustive": scan(77, 99, 500),
                                      "lattice": scan(80, 99, 5)})  # fmt: skip
            self.add_scans(f"scan-{name}")
        self.add("scan-city", {"signature": scan(30, 40, 0.5, 20)})
        self.add_scans("scan-city")
        self.add("features-campus", {"signature": scan(66, 99, 40, 14, 1)})
        self.add("opponents-campus", {
            "signature": scan(19, 24, 0.5), "exhaustive-fine": scan(20, 24, 500),
            "branch-and-bound": scan(21, 24, 50), "jcbb": scan(0, 24, 20),
        })  # fmt: skip
        self.add("opponents-intel", {"signature": scan(9, 9, 0.5), "exhaustive-fine": scan(9, 9, 5)})
        self.add("cbgl-aces-270", {"signature": scan(450, 500, 0.5, 300)})
        steps = [{"local_map_steps": 1, **scan(1, 2, 3)}]
        self.add("landmarks-dlr", {name: {"rows": [{**row, "firm_counts": [1, 2], "firm_and_wrong_counts": [0, 2],
                                                    "not_judged": 1} for row in steps]}
                                   for name in ("signature", "jcbb", "jcbb-greedy")})  # fmt: skip
        self.add("mcl-intel", {"signature": drive(8, 10), "mcl": drive(7, 10), "mcl-best": drive(9, 10)})
        self.add("scans-freiburg-101-in-intel", {"signature": scan(0, 300, 0.5)})
        self.add("scans-fhw-in-acapulco", {"signature": scan(0, 100, 0.5, 0, 1)})
        self.add("drives-aces-in-intel", {"signature": drive(0, 1, 1)}, ["signature,0,,0,,1"])
        self.add("drives-intel-in-campus", {"signature": drive(0, 1)}, ["signature,0,,0,,0"])
        rows = ["signature,0,,1,1.5,0", "signature,1,,1,4,0"]
        self.add("track-campus", {"signature": drive(19, 20)}, rows)
        self.add("track-intel-kidnapped", {"signature": {**drive(1, 2, 1), "noticed_counts": [2, 2]}},
                 ["signature,0,,1,1.5,0", "signature,1,,0,,1"])  # fmt: skip
        self.add("alone-campus", {"signature": drive(17, 20, 1)}, rows)
        self.add("apart-campus", {"signature": drive(1, 1)}, rows[:1])
        self.add("apart-fhw", {"signature": drive(1, 1)}, rows[:1])
        self.add("apart-fhw-reversed", {"signature": drive(1, 2)}, rows)
        self.add("track-dlr", {"signature": drive(3, 20, 2)}, [])
        rows = [f"signature,{i},{KINDS[i % 3]},1,2,{int(i == 3)}" for i in range(30)]
        self.add("sim-mapped", {"signature": simulated_drives(98, 100)}, rows)
        rows = [f"signature,{i},{KINDS[i % 2]},1,2,0" for i in range(20)]
        self.add("sim-moved", {"signature": simulated_drives(90, 100, KINDS[:2])}, rows)
        rows = [f"signature,{i},{KINDS[i]},1,2,0" for i in range(3)]
        self.add("sim-half", {"signature": simulated_drives(75, 100)}, rows)
        self.add("sim-no-odometry", {"signature": simulated_drives(95, 100)}, rows[:1])
        # 6 worlds of 2 drives; worlds 3 to 5 get the map of another kind.
        rows = [f"signature,{i},{KINDS[i // 2 % 3]},0,,{int(i in (0, 6))}" for i in range(12)]
        self.add("sim-foreign-mixed", {"signature": drive(0, 12, 2)}, rows)
        for kind in KINDS:
            rows = [f"signature,{i},{kind},0,,{int(kind == 'hall' and i < 2)}" for i in range(4)]
            self.add(f"sim-foreign-{kind}", {"signature": drive(0, 4)}, rows)
            self.add(f"same-size-{kind}-1", {"signature": drive(0, 4)}, rows)


def run(script, *arguments):
    return subprocess.run([sys.executable, "-B", ROOT / "scripts" / script, *arguments],
                          capture_output=True, text=True, check=False)  # fmt: skip


class ResultsTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        self.out = self.root / "out"
        self.out.mkdir()
        self.bench = Bench(self.out)
        self.docs = self.root / "docs" / "results"
        (self.root / "README.md").write_text(README)

    def write(self):
        return run("write_results.py", self.out, self.docs)

    def readme_numbers(self, mode):
        return run("readme_numbers", mode, "--root", self.root)

    def page(self):
        self.bench.fill()
        done = self.write()
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.docs / "RESULTS.md").read_text()

    def assert_fails(self, done, *parts):
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_page_names_its_commit_and_holds_the_figures(self):
        page = self.page()
        self.assertIn("commit abc1234", page)
        self.assertIn("| campus | 99 | 0.879 (0.80-0.93) | 1.000 | 48 | 0 |", page)
        self.assertIn("| 1000 | 10 |", page)  # what exhaustive and lattice take
        self.assertIn("| freiburg-101 in intel, trained on | 300 |", page)
        self.assertIn("| aces in intel, trained on | - | - | 1 | 1 = 100.00 %", page)
        self.assertIn("| all but those trained on | 100 | 1 = 1.00 % (0.18-5.45) | 1 | 0 = 0.00 %", page)
        self.assertIn("| half of the furniture moved: all | 200 | 0.900", page)
        self.assertNotIn("furniture moved: hall", page)
        self.assertIn("| campus | 20 | 20 | 0.850 (0.64-0.95) | 1 |", page)  # without odometry
        self.assertIn("| the same starts without odometry | 2 |", page)
        self.assertTrue((self.docs / "images" / "wake-ups.png").read_bytes().startswith(b"\x89PNG"))

    def test_claims_on_training_data_and_by_features_are_told_apart(self):
        page = " ".join(self.page().split())
        self.assertIn("144 of 297, 0 wrongly. Of all scans it is 212 of 436, 0 wrongly, and by features alone "
                      "15 of 99, 1 wrongly.", page)  # fmt: skip
        self.assertIn("*localized* are 14 right and 1 wrong of 99 on campus.", page)
        self.assertIn("scan**: campus, features alone (1, 14 right).", page)

    def test_every_recorded_set_has_its_uses_listed(self):
        asked = {data_use.place_of(name) for name in scans.SCANS}
        asked |= {data_use.place_of(name) for _, name, _ in drives.DRIVES}
        self.assertEqual({name for name, *_ in data_use.USES}, asked)
        self.assertIn("| infinite-corridor | nothing | the sharp likelihood in (6.8),", self.page())

    def test_training_sets_are_those_of_the_fit(self):
        fit = (ROOT / "scripts" / "fit_verdict").read_text()
        fitted = re.search(r"^TRAIN_RECORDED = (.*)$", fit, re.MULTILINE).group(1)
        self.assertEqual(fitted, json.dumps([name.removesuffix("-101") for name in data_use.TRAINED]))
        self.assertTrue(data_use.is_trained_pair("freiburg-101-in-intel"))
        self.assertFalse(data_use.is_trained_pair("intel-in-campus"))

    def test_page_keeps_to_its_style(self):
        lines = self.page().splitlines()
        self.assertLessEqual(len(lines), 360)
        text = " ".join(line for line in lines if line and line[0] not in "|#!")
        for sentence in re.split(r"[.?] |\* \*\*", text):
            self.assertLessEqual(len(sentence.split()), 30, sentence)

    def test_opponents_are_compared_and_those_ahead_named(self):
        page = self.page()
        self.assertIn("| method | campus, 24 scans | intel, 9 scans | dlr, 1 step |", page)
        self.assertIn("| signature | 0.792 (0.60-0.91), 0.50 ms | 1.000 (0.70-1.00), 0.50 ms |", page)
        self.assertIn("| branch-and-bound | 0.875 (0.69-0.96), 100 times | - | - |", page)
        self.assertIn("| jcbb-greedy | - | - | 0.500 (0.09-0.91), 1.0 times |", page)
        self.assertIn("| aces, 270 degrees | 500 | 0.900 (0.87-0.92) | 300 | 0 |", page)
        short = " ".join(page.split("## Data")[0].split())
        self.assertIn("On campus, 24 scans, `branch-and-bound` 0.875, sigloc 0.792.", short)
        self.assertNotIn("On intel, 9 scans", short)
        self.assertIn("often**: On intel, mcl-best 0.900, sigloc 0.800.", short)

    def test_misleading_information_is_bounded_by_kind_of_world(self):
        page = self.page()
        self.assertIn("| recorded drives, own map | 2 | 0 | 0.00 | 77.64 | 0.04 | 0.04 |", page)
        self.assertIn("| the same starts of intel, kidnapped after 15 m | 2 | 1 | 50.00 |", page)
        self.assertIn("| recorded drives, own map, no two overlapping | 4 | 0 | 0.00 | 52.71 |", page)
        self.assertIn("| recorded drives, another building's map | 1 | 0 |", page)
        self.assertIn("| recorded drives, another building's map, trained on | 1 | 1 |", page)
        self.assertIn("| fhw, reversed | 2 | 0.500 (0.09-0.91) | - | 0 | 77.64 | 2 of 2 | 0.04 |", page)
        # Two logs, campus with 1 of 1 and fhw with 2 of 3.
        self.assertIn("| all with lasers | 4 | 0.750 (0.30-0.95) | 0.67-1.00 | 0 | 52.71 | 4 of 4 | 0.08 |", page)
        self.assertIn("| of them, odometry recorded | 1 |", page)
        self.assertIn("| of them, fhw, acapulco, infinite-corridor, orebro | 3 | 0.667 (0.21-0.94) | - |", page)
        self.assertIn("| simulated office, whole map | 20 | 1 | 5.00 | 21.61 | 0.40 | 0.40 |", page)
        self.assertIn("| simulated hall, whole map | 10 | 0 | 0.00 | 25.89 |", page)
        self.assertIn("| simulated hall, another one's map | 4 | 2 | 50.00 |", page)
        self.assertTrue((self.docs / "images" / "integrity.png").read_bytes().startswith(b"\x89PNG"))

    def test_risk_falls_with_coverage(self):
        page = self.page()
        rows = {line.split(" |")[0]: line for line in page.splitlines() if line.startswith("| 0.")}
        # Three sets neither trained on nor repeated, and all five.
        self.assertIn("| 1.000 (0.76-1.00) | 6 of 12 | 50.00 |", rows["| 0.00"])
        self.assertIn("| 10 of 20 | 50.00 |", rows["| 0.00"])
        self.assertIn("| 0.750 (0.47-0.91) | 3 of 9 | 33.33 |", rows["| 0.70"])
        self.assertIn("| 0.250 (0.09-0.53) | 0 of 3 | 0.00 | 63.16 | 0.250", rows["| 0.99"])

    def test_published_weights_are_compared_with_what_was_right(self):
        page = self.page()
        self.assertIn("| 0.50-0.70 | 0.000 of 2 | - | 0.000 of 50 | 0.000 of 3 | 0.000 of 1 |", page)
        # Of the two kidnapped robots the steps after it: those before repeat the drives of others.
        self.assertIn("| 0.99-1.00 | 1.000 of 4 | - | 1.000 of 50 | 1.000 of 3 | 1.000 of 1 |", page)
        self.assertIn("| 0.70-0.90 | - | - | - | - | - | 0 |", page)

    def test_answers_without_a_sure_truth_are_counted(self):
        self.assertIn("| dlr, 1 step | 2 | 0.500 (0.09-0.91) | 1 | 0.500 (0.09-0.91) | 0 |", self.page())

    def test_foreign_maps_of_the_same_kind_are_counted_apart(self):
        page = self.page()
        other = next(line for line in page.splitlines() if line.startswith("| of another kind |"))
        self.assertIn("| 1 of 2 = 50.00 %", other)  # drive 6 is of world 3, an office
        self.assertIn("| 1 of 6 = 16.67 %", other)
        self.assertIn("| 1 of 3 |", other)
        same = next(line for line in page.splitlines() if line.startswith("| of the same kind |"))
        self.assertIn("| 0 of 4 = 0.00 % (0.00-48.99) | 0 of 4 = 0.00 %", same)
        self.assertIn("| 2 of 4 = 50.00 %", same)
        self.assertIn("| 1 of 6 |", same)

    def test_runs_of_different_commits_are_refused(self):
        self.bench.fill()
        self.bench.add("track-intel", {"signature": drive(1, 1)}, commit="fff0000")
        self.assert_fails(self.write(), "different commits", "abc1234", "fff0000 (track-intel)")
        self.assertFalse(self.docs.exists())

    def test_uncommitted_changes_are_refused(self):
        self.bench.add("track-intel", {"signature": drive(1, 1)}, commit="abc1234-dirty")
        self.assert_fails(self.write(), "abc1234-dirty")

    def test_a_quick_bench_never_leaves_its_folder(self):
        self.bench.fill()
        (self.out / "command").write_text("scripts/bench --quick --data DIR\n")
        self.assert_fails(self.write(), "quick")
        done = run("write_results.py", self.out, self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("quick trial", (self.out / "RESULTS.md").read_text())

    def test_missing_and_broken_input_gets_one_line(self):
        self.assert_fails(self.write(), "runs.csv", "lists no runs")
        self.bench.fill()
        (self.out / "track-dlr" / "summary.json").write_text("{")
        self.assert_fails(self.write(), "track-dlr/summary.json", "no summary")
        (self.out / "track-dlr" / "summary.json").unlink()
        self.assert_fails(self.write(), "track-dlr/summary.json", "No such file")

    def test_readme_gets_the_numbers_and_a_difference_is_found(self):
        self.assert_fails(self.readme_numbers("--check"), "RESULTS.md")
        page = self.page()
        self.assert_fails(self.readme_numbers("--check"), "README.md:2:")
        self.assertEqual(self.readme_numbers("--write").returncode, 0)
        self.assertEqual(self.readme_numbers("--check").returncode, 0)
        readme = (self.root / "README.md").read_text()
        self.assertIn("| median time, one thread | 0.50 ms |", readme)
        self.assertIn("2 of 4 in halls", " ".join(readme.split()))
        self.assertIn("These numbers are of commit abc1234, made by", readme)
        self.assertIn("| campus (99 scans) | intel, trained on (99 scans) |", readme)
        self.assertIn("Claims on intel are no test", " ".join(readme.split()))
        self.assertIn("With half of the world mapped 0 of 300 are wrong", " ".join(readme.split()))
        self.assertIn("On campus (24 scans) `branch-and-bound` is right in 0.875, sigloc in 0.792.",
                      " ".join(readme.split()))  # fmt: skip
        self.assertTrue(readme.startswith("# x\n") and readme.endswith("after\n"))
        (self.docs / "RESULTS.md").write_text(page.replace("| 48 | 0 |", "| 47 | 0 |"))
        self.assert_fails(self.readme_numbers("--check"), "README.md:", "| 48 |", "| 47 |")

    def test_readme_sentences_are_short(self):
        self.page()
        self.readme_numbers("--write")
        text = " ".join(line for line in (self.root / "README.md").read_text().splitlines()
                        if line and line[0] not in "|#<")  # fmt: skip
        for sentence in re.split(r"[.?] ", text):
            self.assertLessEqual(len(sentence.split()), 25, sentence)

    def test_a_row_that_is_gone_is_named(self):
        page = self.page()
        (self.docs / "RESULTS.md").write_text(page.replace("| campus | 99", "| camp | 99"))
        self.assert_fails(self.readme_numbers("--write"), "One scan, whole map", "no row 'campus'")

    def test_readme_without_the_markers_is_refused(self):
        self.page()
        (self.root / "README.md").write_text("# x\n")
        self.assert_fails(self.readme_numbers("--write"), "README.md", "needs one line")


class NumbersTest(unittest.TestCase):
    def test_few_points_get_the_interval_of_students_t(self):
        slope, half = numbers.fit_exponent([(1, 1), (2, 2.2), (4, 4)])
        self.assertAlmostEqual(slope, 1.0)
        self.assertAlmostEqual(half, 12.706 * 0.0794, places=3)
        self.assertEqual(numbers.exponent([(1, 1), (2, 4)]), "2.00")
        self.assertEqual(numbers.exponent([(1, 1)]), "-")

    def test_exact_upper_bounds(self):
        self.assertAlmostEqual(numbers.upper_bound(0, 59), 1 - 0.05 ** (1 / 59), places=9)
        most = numbers.upper_bound(1, 20)
        self.assertAlmostEqual((1 - most) ** 20 + 20 * most * (1 - most) ** 19, 0.05, places=9)
        self.assertAlmostEqual(numbers.upper_bound(5, 1000), 0.010481, places=5)
        self.assertEqual(numbers.upper_bound(3, 3), 1.0)

    def test_a_bootstrap_draws_whole_blocks(self):
        self.assertEqual(numbers.bootstrap([(5, 10)] * 4), (0.5, 0.5))
        low, high = numbers.bootstrap([(0, 10), (10, 10)], draws=1000)
        self.assertEqual((low, high), (0.0, 1.0))
        low, high = numbers.bootstrap([(9, 10)] * 9 + [(0, 1)])
        self.assertTrue(0.8 < low < 81 / 91 < high <= 0.9)

    def test_claims_without_truth_are_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(pathlib.Path(folder))
            bench.add("apart-fhw", {"signature": drive(0, 1)}, [])
            (bench.folder / "apart-fhw" / "runs.csv").write_text(
                "method,start,group,wrong_steps\nsignature,0,,0\n")
            (bench.folder / "apart-fhw" / "results.csv").write_text(
                "method,start,travelled_m,seconds,error_m,confident\n"
                "signature,0,0,0,0.1,1\nsignature,0,1,2,,1\nsignature,0,2,4,,0\n")
            exposure = integrity.Exposure()
            exposure.add(runs.Bench(folder), "apart-fhw")
            self.assertEqual((exposure.judged, exposure.claims), (1, 2))

    def test_steps_without_truth_are_never_right(self):
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(pathlib.Path(folder))
            bench.add("drives-a-in-b", {"signature": drive(0, 1)}, [])
            (bench.folder / "drives-a-in-b" / "results.csv").write_text(
                "method,start,weight,error_m,error_deg,mapped\n"
                "signature,0,0.7,,,0\nmcl,0,0.9,,,0\n")
            away = integrity.weighed_steps(runs.Bench(folder), ["drives-a-in-b"])
            self.assertEqual(away, [(0.7, None, False)])

    def test_wilson(self):
        low, high = numbers.wilson(0, 100)
        self.assertEqual(low, 0)
        self.assertAlmostEqual(high, 0.0370, places=4)

    def test_a_world_of_an_unexpected_kind_is_refused(self):
        with self.assertRaises(simulated.BadInput):
            simulated.of_another_kind(0, 6, "hall")


if __name__ == "__main__":
    unittest.main()
