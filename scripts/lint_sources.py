#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy over our own sources, as a build folder compiles them.

Most of clang-tidy's time goes into the headers of MRPT, Eigen and the standard library, anew for
every source file. So files that are compiled alike are first linted in groups, each through a
generated file that includes its members; a group that is not clean (because of a finding, or
because its members don't go together in one translation unit) is linted again file by file, and
that is what counts.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

TIDY = ["clang-tidy-14", "--quiet", "--extra-arg=-Wno-unknown-warning-option"]
GROUP_CHECKS = "--checks=-bugprone-suspicious-include"
MAX_GROUP = 12
ROOT = pathlib.Path(__file__).resolve().parent.parent


def own_commands(build, files):
    """Yields (file, arguments) of our sources: generated and fetched ones are not ours."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", "*.cpp"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    own = {str(ROOT / line) for line in listed.stdout.splitlines()}
    wanted = {str(path.resolve()) for path in files} or own
    database = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    for entry in sorted(database, key=lambda entry: entry["file"]):
        if entry["file"] in own & wanted:
            wanted.discard(entry["file"])  # a file of two targets is linted once
            arguments = shlex.split(entry["command"])
            end = arguments.index("-o")
            yield pathlib.Path(entry["file"]), tuple(arguments[:end])


def make_groups(commands):
    """Returns lists of (file, arguments) of nearly equal size, all with the same arguments."""
    alike = collections.defaultdict(list)
    for file, arguments in commands:
        alike[arguments].append(file)
    for arguments, files in alike.items():
        count = -(-len(files) // MAX_GROUP)
        for i in range(count):
            yield files[i::count], arguments


def write_group(folder, number, files, arguments):
    unit = folder / f"group_{number}.cpp"
    unit.write_text("".join(f'#include "{file}"\n' for file in files), encoding="utf-8")
    return {"directory": str(folder), "file": str(unit), "arguments": [*arguments, "-c", str(unit)]}


def tidy(database, file, *options):
    """Returns clang-tidy's findings in a file, or None when it is clean."""
    command = [*TIDY, *options, "-p", str(database), str(file)]
    result = subprocess.run(command, capture_output=True, text=True)
    return None if result.returncode == 0 else result.stdout + result.stderr


def lint_group(build, folder, unit, files):
    if len(files) > 1 and tidy(folder, unit, GROUP_CHECKS) is None:
        return []
    findings = [(file, tidy(build, file)) for file in files]
    return [(file, text) for file, text in findings if text is not None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="build folder with its compile commands")
    parser.add_argument("files", type=pathlib.Path, nargs="*", help="default: all our sources")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    folder = build / "lint"
    folder.mkdir(exist_ok=True)
    groups = list(make_groups(own_commands(build, arguments.files)))
    units = [write_group(folder, i, *group) for i, group in enumerate(groups)]
    (folder / "compile_commands.json").write_text(json.dumps(units), encoding="utf-8")

    faulty = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [
            pool.submit(lint_group, build, folder, unit["file"], files)
            for unit, (files, _) in zip(units, groups)
        ]
        for job in concurrent.futures.as_completed(jobs):
            for file, text in job.result():
                faulty += 1
                print(f"== {file.relative_to(ROOT)}\n{text}", flush=True)
    count = sum(len(files) for files, _ in groups)
    print(f"lint: {count} files, {faulty} with findings")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
