#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy over our own sources, as a build folder compiles them.

Most of clang-tidy's time goes into the headers of MRPT, Eigen and the standard library, anew for
every source file. So files that are compiled alike are first linted in groups, each through a
generated file that includes its members. A group that is not clean (because of a finding, or
because two members use a name twice) is halved and linted again; what counts is what is found in a
file by itself.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

TIDY = ["clang-tidy-14", "--quiet"]
GROUP_CHECKS = "--checks=-bugprone-suspicious-include"
MAX_GROUP = 12
ROOT = pathlib.Path(__file__).resolve().parent.parent
HAS_MAIN = re.compile(r"^int main\(", re.MULTILINE)


# What ships. Tests are held by warnings as errors and the sanitizers; linting them too would take
# longer than building them.
LINTED = ["src/*.cpp", "apps/*.cpp", "examples/*.cpp", "python/*.cpp", "ros/*.cpp"]


def own_commands(build, files):
    """Yields (file, flags) of our sources: generated and fetched ones are not ours."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--"] + LINTED,
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    own = {str(ROOT / line) for line in listed.stdout.splitlines()}
    wanted = own & {str(path.resolve()) for path in files} if files else own
    database = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    for entry in sorted(database, key=lambda entry: entry["file"]):
        if entry["file"] in wanted:
            wanted.discard(entry["file"])  # a file of two targets is linted once
            words = shlex.split(entry["command"])[: shlex.split(entry["command"]).index("-o")]
            flags = [words[i] for i in range(len(words)) if is_flag(words, i)]
            yield entry["file"], (*flags, "-Wno-unknown-warning-option")


def is_flag(words, i):
    return words[i].startswith("-") or words[i - 1] in ("-isystem", "-include")


def make_groups(commands):
    """Yields (files, flags): groups of nearly equal size, compiled alike, with at most one main."""
    alike = collections.defaultdict(list)
    for file, flags in commands:
        if HAS_MAIN.search(pathlib.Path(file).read_text(encoding="utf-8")):
            yield [file], flags
        else:
            alike[flags].append(file)
    for flags, files in alike.items():
        count = -(-len(files) // MAX_GROUP)
        for i in range(count):
            yield files[i * len(files) // count : (i + 1) * len(files) // count], flags


def tidy(unit, flags, *options):
    """Returns clang-tidy's findings in a translation unit, or None when it is clean."""
    command = [*TIDY, *options, unit, "--", *flags]
    result = subprocess.run(command, capture_output=True, text=True)
    return None if result.returncode == 0 else result.stdout + result.stderr


def lint(files, flags, folder):
    """Prints the findings in files and returns the number of files that have some."""
    if len(files) == 1:
        findings = tidy(files[0], flags)
        if findings is not None:
            print(f"== {pathlib.Path(files[0]).relative_to(ROOT)}\n{findings}", flush=True)
        return int(findings is not None)
    name = hashlib.sha1("\n".join(files).encode()).hexdigest()
    unit = folder / f"{name}.cpp"
    unit.write_text("".join(f'#include "{file}"\n' for file in files), encoding="utf-8")
    if tidy(str(unit), flags, GROUP_CHECKS) is None:
        return 0
    half = len(files) // 2
    return lint(files[:half], flags, folder) + lint(files[half:], flags, folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path, help="build folder with its compile commands")
    parser.add_argument("files", type=pathlib.Path, nargs="*", help="default: all our sources")
    arguments = parser.parse_args()
    folder = arguments.build.resolve() / "lint"
    folder.mkdir(exist_ok=True)
    groups = list(make_groups(own_commands(arguments.build, arguments.files)))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faulty = sum(pool.map(lambda group: lint(*group, folder), groups))
    count = sum(len(files) for files, _ in groups)
    print(f"lint: {count} files, {faulty} with findings")
    return 1 if faulty or not count else 0


if __name__ == "__main__":
    sys.exit(main())
