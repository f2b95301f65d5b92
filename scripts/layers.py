#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rules of docs/architecture.md that a compiler does not see.

* Each folder includes only the parts of the project below it and the MRPT modules it may use.
* Files are no longer than MAX_LINES and carry the two SPDX lines.
* Every equation that a source file cites is in docs/algorithm.md.
* With --binaries DIR: no executable or library built there links what it must not.

Prints one line a violation, `path:line: reason`, and exits 1 when there is one.
"""
import argparse
import pathlib
import re
import subprocess
import sys

MAX_LINES = 400

# The core, lowest first: a part may include itself and what stands before it.
CORE = ["config", "geometry", "features", "signature", "map", "matching", "tracking"]
PARTS = {part: CORE[: i + 1] for i, part in enumerate(CORE)}
PARTS["bridge"] = CORE + ["bridge"]
PARTS["render"] = CORE + ["bridge", "render"]
PARTS["eval"] = CORE + ["bridge", "eval"]
PARTS["hwdrivers"] = CORE + ["bridge", "hwdrivers"]

# Apps that users run: they never depend on the evaluation library.
PRODUCT_APPS = {"sigloc-map", "sigloc-localize"}

MRPT_CORE = {"core", "math", "config"}
MRPT_BRIDGE = MRPT_CORE | {
    "bayes", "containers", "img", "io", "maps", "obs", "opengl", "poses", "random", "rtti",
    "serialization", "slam", "system", "tfest", "topography", "typemeta",
}  # fmt: skip
MRPT_MODULES = {part: MRPT_CORE for part in CORE}
MRPT_MODULES.update(bridge=MRPT_BRIDGE, render=MRPT_BRIDGE, eval=MRPT_BRIDGE)
MRPT_MODULES["hwdrivers"] = MRPT_BRIDGE | {"hwdrivers"}

# Tests of the core stay as light as the core.
CORE_TESTS = {"unit", "property"}

# Headers that only some folders may include: pattern, folders, reason.
RESTRICTED = [
    (r"GL/.*|mrpt/opengl/opengl_api\.h", {"render"}, "OSMesa belongs to the render target"),
    (r"CLI/.*", {"apps"}, "the command line belongs to the apps"),
    (r"iostream", {"apps", "tests"}, "the library never prints"),
    (r"wx/.*", set(), "wxWidgets has no place here"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
PRINTS = re.compile(r"\bstd::(cout|cerr|clog)\b|(?<![a-zA-Z_])(f?printf|puts)\(")
EQUATION = re.compile(r"\((\d+\.\d+)\)")
CITES_EQUATION = re.compile(r"\b[Ee]q\.")
SPDX = ["SPDX-FileCopyrightText: 2026 the sigloc authors", "SPDX-License-Identifier: BSD-3-Clause"]
SPDX_SUFFIXES = {".h", ".cpp", ".py", ".sh", ".cmake", ".cmake.in", ".gp", ".ini"}


def place(path):
    """Returns (kind, name) of a source file: a library part, an app, an example, a kind of test."""
    parts = path.parts
    if parts[0] == "include" and len(parts) > 3:
        return "part", parts[2]
    if parts[0] == "src" and len(parts) > 2:
        return "part", parts[1]
    if parts[0] == "examples":
        return "examples", path.stem
    if parts[0] in ("apps", "tests") and len(parts) > 2:
        if parts[0] == "apps" and parts[1] == "render":
            return "part", "render"
        return parts[0], parts[1]
    return "none", ""


def allowed_parts(kind, name):
    if kind == "part":
        return set(PARTS[name])
    if kind == "examples" or (kind == "apps" and name in PRODUCT_APPS):
        return set(PARTS["render"])
    if kind == "tests" and name in CORE_TESTS:
        return set(CORE)
    return set(PARTS)


def allowed_modules(kind, name):
    if kind == "part":
        return MRPT_MODULES[name]
    if kind == "tests" and name in CORE_TESTS:
        return MRPT_CORE
    return MRPT_BRIDGE


def include_violations(path, kind, name, header):
    sigloc = re.match(r"sigloc/([^/]+)/", header)
    if sigloc and sigloc.group(1) not in allowed_parts(kind, name):
        yield f"{kind} '{name}' may not include part '{sigloc.group(1)}' ({header})"
    mrpt = re.match(r"mrpt/([^/]+)[/.]", header)
    if mrpt and mrpt.group(1) not in allowed_modules(kind, name):
        yield f"{kind} '{name}' may not include MRPT module '{mrpt.group(1)}' ({header})"
    for pattern, folders, reason in RESTRICTED:
        if re.fullmatch(pattern, header) and kind not in folders and name not in folders:
            yield f"{header}: {reason}"
    if ".." in header:
        yield f"{header}: include from the root, not relative to the folder"


def source_violations(path, lines):
    kind, name = place(path)
    if kind == "none" or (kind == "part" and name not in PARTS):
        yield 1, "a source file outside the folders of docs/architecture.md"
        return
    for number, line in enumerate(lines, 1):
        if kind == "part" and PRINTS.search(line):
            yield number, "the library never prints"
        match = INCLUDE.match(line)
        for reason in include_violations(path, kind, name, match.group(1)) if match else ():
            yield number, reason


def citation_violations(lines, equations):
    """Finds cited equations that are not there; a citation is on the line that says "eq."."""
    for number, line in enumerate(lines, 1):
        if CITES_EQUATION.search(line):
            for equation in EQUATION.findall(line):
                if equation not in equations:
                    yield number, f"equation ({equation}) is not in docs/algorithm.md"


def needs_spdx(path, lines):
    is_script = bool(lines) and lines[0].startswith("#!")
    return is_script or path.name == "CMakeLists.txt" or bool(set(path.suffixes) & SPDX_SUFFIXES)


def file_violations(path, text, equations):
    lines = text.splitlines()
    is_code = path.suffix in (".h", ".cpp")
    if needs_spdx(path, lines):
        if len(lines) > MAX_LINES:
            yield len(lines), f"{len(lines)} lines, more than {MAX_LINES}"
        head = "\n".join(lines[:4])
        if not all(line in head for line in SPDX):
            yield 1, "the two SPDX lines are missing"
    if is_code:
        yield from source_violations(path, lines)
        yield from citation_violations(lines, equations)


def own_files(root):
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=root, capture_output=True, text=True, check=True,
    )  # fmt: skip
    for line in sorted(set(listed.stdout.splitlines())):
        path = pathlib.Path(line)
        is_ours = path.parts[0] not in ("maps", "rawlogs", "docs")
        if is_ours and (root / path).is_file():
            yield path


def binary_violations(folder):
    """Checks the libraries that each binary asks for by itself (its NEEDED entries)."""
    for path in sorted(p for p in folder.glob("*/*") if p.is_file() and not p.is_symlink()):
        if path.parent.name not in ("bin", "lib"):
            continue
        dump = subprocess.run(["readelf", "-d", str(path)], capture_output=True, text=True)
        needed = re.findall(r"\(NEEDED\).*\[(.+?)\]", dump.stdout)
        is_library = path.name.startswith("lib")
        for library in needed:
            if re.match(r"libmrpt-(apps|gui)\.|libwx_", library):
                yield f"{path.name} links {library}"
            if is_library and library.startswith("libOSMesa"):
                yield f"{path.name} links {library}: only executables may"
            if path.name in PRODUCT_APPS and library.startswith("libsigloc-eval"):
                yield f"{path.name} links {library}: product apps may not"
            if library.startswith("libmrpt-hwdrivers") and "hwdrivers" not in path.name:
                yield f"{path.name} links {library}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--binaries", type=pathlib.Path, help="build folder to check as well")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parent.parent
    # An equation's number ends its line.
    method = (root / "docs" / "algorithm.md").read_text(encoding="utf-8")
    known = set(re.findall(r"\((\d+\.\d+)\)$", method, re.MULTILINE))
    violations = []
    count = 0
    for path in own_files(root):
        try:
            text = (root / path).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue  # data, not source
        count += 1
        violations += [f"{path}:{line}: {why}" for line, why in file_violations(path, text, known)]
    if arguments.binaries:
        violations += binary_violations(arguments.binaries)
    for violation in violations:
        print(violation)
    if violations:
        return 1
    print(f"layers: {count} files in order")
    return 0


if __name__ == "__main__":
    sys.exit(main())
