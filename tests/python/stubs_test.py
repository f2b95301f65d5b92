# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The types that are told are those of the module, and what uses it has types that fit."""
import ast
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]
STUBS = pathlib.Path(sigloc.__file__).with_suffix(".pyi")
CLASSES = {node.name: node for node in ast.parse(STUBS.read_text()).body if isinstance(node, ast.ClassDef)}


def mypy(tmp_path, *arguments):
    environment = {**os.environ, "MYPYPATH": str(pathlib.Path(sigloc.__file__).parents[1]),
                   "MYPY_CACHE_DIR": str(tmp_path)}  # fmt: skip
    done = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True,
                          env=environment, check=False)  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_those_of_the_module(tmp_path):
    # What is compiled has no stubs of its own; its classes have pybind11's metaclass, and those that
    # nobody makes a constructor that only refuses. typing.NamedTuple is a function.
    allowed = tmp_path / "allowed"
    allowed.write_text("sigloc._sigloc\nsigloc\\.[A-Z]\\w+\n"
                       "sigloc\\.(Answer|Decision|Hypothesis|Map|Step)\\.__init__\n"
                       "sigloc\\.\\w+\\.NamedTuple\n")  # fmt: skip
    mypy(tmp_path, "mypy.stubtest", "sigloc", "--allowlist", str(allowed), "--ignore-unused-allowlist")


def test_the_example_has_types_that_fit(tmp_path):
    mypy(tmp_path, "mypy", "--strict", "--ignore-missing-imports", str(ROOT / "examples/04_localize.py"))


def test_stubs_name_everything():
    for name in sigloc.__all__:
        thing = getattr(sigloc, name)
        if not inspect.isclass(thing):
            continue
        told = {node.name for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
        there = {member for member in vars(thing) if not member.startswith("_")}
        if name == "Verdict":
            there -= set(thing.__members__)
        assert {member for member in told if not member.startswith("_")} == there, name


@pytest.mark.parametrize("name", ["Localizer", "Tracker"])
def test_stubs_name_every_option(name):
    constructor = next(node for node in CLASSES[name].body if getattr(node, "name", "") == "__init__")
    told = [argument.arg for argument in constructor.args.kwonlyargs]
    documented = [line.split(" = ")[0] for line in getattr(sigloc, name).__init__.__doc__.splitlines()
                  if " = " in line and "->" not in line]  # fmt: skip
    assert told == documented and len(told) >= 5


def test_everything_is_documented():
    for name in sigloc.__all__:
        thing = getattr(sigloc, name)
        if not inspect.isclass(thing):
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items():
            if not member.startswith("_") and member not in ("name", "value"):
                assert inspect.getdoc(value), f"{name}.{member}"
