# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The example does what it says."""
import pathlib
import re
import subprocess
import sys

import matplotlib.image
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(*arguments):
    return subprocess.run([sys.executable, ROOT / "examples/04_localize.py", *arguments],
                          capture_output=True, text=True, check=False, cwd=ROOT)  # fmt: skip


def test_it_finds_the_robot_and_draws(tmp_path):
    picture = tmp_path / "office.png"
    done = run("--picture", picture)
    assert (done.returncode, done.stderr) == (0, "")
    # The true pose at the end is the last row of rawlogs/office-truth.txt.
    assert re.search(r"^step 202: localized .*\(4\.7\d m, 6\.0\d m, -?(39|40|41)\.\d deg\)", done.stdout, re.M)
    image = matplotlib.image.imread(picture)[..., :3]
    colours = np.unique((image * 255).astype(np.uint8).reshape(-1, 3), axis=0)
    assert min(image.shape[:2]) > 300 and len(colours) > 20


def test_a_missing_map_is_told_in_one_line(tmp_path):
    done = run("--map", tmp_path / "a.yaml")
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and "a.yaml: no such file" in done.stderr
