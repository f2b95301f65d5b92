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
import itertools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

TIDY = ["clang-tidy-14", "--quiet"]
GROUP_CHECKS = "--checks=-bugprone-suspicious-include"
MAX_GROUP = 24
ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME = re.compile(r"^\w[\w:<>, &*]*[ &*](\w+)(?:\(| = )", re.MULTILINE)  # in the first column
HAS_MAIN = re.compile(r"^int main\(", re.MULTILINE)


# What ships. Tests are held by warnings as errors and the sanitizers; linting them too would take
# longer than building them.
LINTED = ["src/*.cpp", "apps/*.cpp", "examples/*.cpp", "python/*.cpp", "ros/*.cpp"]


# What differs between targets and means nothing to clang-tidy.
IDLE_FLAG = re.compile(r"-fPI[CE]|-fvisibility=\w+|-D\w+_EXPORTS")


def own_commands(build, files):
    """Yields (file, flags) of our sources: generated and fetched ones are not ours. Each file gets
    the include folders and definitions of all of them, so that more are compiled alike."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--"] + LINTED,
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    own = {str(ROOT / line) for line in listed.stdout.splitlines()}
    wanted = own & {str(path.resolve()) for path in files} if files else own
    database = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    flags = {item["file"]: flags_of(item["command"]) for item in database if item["file"] in own}
    values = collections.defaultdict(dict)  # a name's flags, such as those that define SIGLOC_WORK
    for flag in itertools.chain(*flags.values()):
        values[flag[-1].partition("=")[0]][flag] = True
    shared = [flag for alike in values.values() if len(alike) == 1 for flag in alike]
    for file in sorted(wanted & flags.keys()):
        apart = [flag for flag in flags[file] if flag not in shared]
        yield file, (*itertools.chain(*shared, *apart), "-Wno-unknown-warning-option")


def flags_of(command):
    """Returns the flags of a compiler's command, each as a tuple of one or two words."""
    words = shlex.split(command)
    words = words[: words.index("-o")]
    pairs = [(a, b) for a, b in zip(words, words[1:]) if a in ("-isystem", "-include")]
    singles = [(a,) for a in words if a.startswith("-") and a not in ("-isystem", "-include")]
    return [flag for flag in singles + pairs if not IDLE_FLAG.fullmatch(flag[-1])]


def make_groups(commands):
    """Yields (files, flags): groups that are compiled alike and seem not to use a name twice."""
    groups = []
    for file, flags in commands:
        text = pathlib.Path(file).read_text(encoding="utf-8")
        names = set(NAME.findall(text)) - {"main"}
        fits = (g for g in groups if g[1] == flags and len(g[0]) < MAX_GROUP and not g[2] & names)
        group = next(fits, None)
        if group is None:
            groups.append(group := ([], flags, set()))
        group[0].append(file)
        group[2].update(names)
    for files, flags, _ in groups:
        yield files, flags


def tidy(unit, flags, *options):
    """Returns clang-tidy's findings in a translation unit, or None when it is clean."""
    command = [*TIDY, *options, unit, "--", *flags]
    result = subprocess.run(command, capture_output=True, text=True)
    return None if result.returncode == 0 else result.stdout + result.stderr


def inclusion(file):
    """Returns the lines that include file, its main under a name of its own."""
    if not HAS_MAIN.search(pathlib.Path(file).read_text(encoding="utf-8")):
        return f'#include "{file}"\n'
    name = "mainOf" + hashlib.sha1(file.encode()).hexdigest()
    return f'#define main {name}\n#include "{file}"\n#undef main\n'


def lint(files, flags, folder):
    """Prints the findings in files and returns the number of files that have some."""
    if len(files) == 1:
        findings = tidy(files[0], flags)
        if findings is not None:
            print(f"== {pathlib.Path(files[0]).relative_to(ROOT)}\n{findings}", flush=True)
        return int(findings is not None)
    name = hashlib.sha1("\n".join(files).encode()).hexdigest()
    unit = folder / f"{name}.cpp"
    unit.write_text("".join(map(inclusion, files)), encoding="utf-8")
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
