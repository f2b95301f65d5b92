#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the rules of docs/architecture.md that a compiler does not see.

* Each module includes only the modules below it, the headers of VOCABULARY and the MRPT modules it may use.
* Public headers, product apps and examples include public headers only.
* No folder of src/ is crowded, and public headers are few.
* Files are no longer than MAX_LINES and carry the two SPDX lines.
* Every equation that a source file or a page cites is in docs/algorithm.md.
* Every path of ours that a page, a source or a script names is there, and so is what pages link to.
* With --binaries DIR: no executable or library built there links what it must not.

Prints one line a violation, `path:line: reason`, and exits 1 when there is one.
"""
import argparse
import pathlib
import re
import subprocess
import sys

MAX_LINES = 400

# The modules of src/, lowest first: a module may include itself and the modules before it in its line.
CORE = [
    "config", "geometry", "features", "signature", "map", "map/building",
    "matching/dense", "matching/keypoints", "matching/features", "matching/generation", "matching",
    "tracking/evidence", "tracking/tracks", "tracking/landmarks", "tracking",
]  # fmt: skip
BRIDGE = CORE + ["io/archive", "io/solid", "io", "io/points", "io/maps", "plugin", "localize"]
EVAL = BRIDGE + [
    "slam", "eval/process", "eval/data", "eval/worlds", "eval/worlds/buildings", "eval/methods/lattice",
    "eval/methods/features", "eval/methods/particles", "eval/methods", "eval/scoring",
    "eval/protocols", "eval/wakeup", "eval/reports",
]  # fmt: skip
MODULES = {module: line[: line.index(module) + 1] for line in (EVAL, BRIDGE, CORE) for module in line}
MODULES["render"] = BRIDGE + ["render"]
MODULES["slam"] = BRIDGE + ["slam"]
MODULES["hwdrivers"] = BRIDGE + ["hwdrivers"]
MODULES["bindings"] = BRIDGE + ["bindings"]  # of python/
MODULES["ros1"] = BRIDGE + ["ros1"]  # of ros/

# Headers of types alone that modules below their own may include, and which modules.
VOCABULARY = {
    "sigloc/matching/RelocationResult.h":
        {"matching/dense", "matching/keypoints", "matching/features"},
    "sigloc/tracking/Belief.h": {"tracking/tracks"},
    "sigloc/tracking/TrackerOptions.h": {"tracking/tracks", "tracking/landmarks"},
    "eval/methods/RelocationMethod.h": {"eval/methods/particles"},
    "eval/methods/TrackingMethod.h": {"eval/methods/particles"},
}  # fmt: skip

MAX_FILES = 22  # in a folder of src/
MAX_PUBLIC_HEADERS = 30

# Apps that users run: they never depend on the evaluation library.
PRODUCT_APPS = {"sigloc-map", "sigloc-localize", "sigloc-align"}

MRPT_CORE = {"core", "math", "config", "version"}  # the last is a header by itself
MRPT_BRIDGE = MRPT_CORE | {
    "bayes", "containers", "img", "io", "maps", "obs", "opengl", "poses", "random", "rtti",
    "serialization", "system", "tfest", "topography", "typemeta",
}  # fmt: skip
MRPT_MODULES = {module: MRPT_CORE if module in CORE else MRPT_BRIDGE for module in MODULES}
MRPT_MODULES["hwdrivers"] = MRPT_BRIDGE | {"hwdrivers"}
WITH_SLAM = MRPT_BRIDGE | {"slam"}
MRPT_MODULES |= {module: WITH_SLAM for module in EVAL if module == "slam" or module.startswith("eval/")}

# Tests of the core stay as light as the core.
CORE_TESTS = {"unit", "threads"}

# Headers that only some folders may include: pattern, folders, reason.
RESTRICTED = [
    (r"GL/.*|mrpt/opengl/opengl_api\.h", {"render"}, "OSMesa belongs to the render target"),
    (r"CLI/.*", {"apps", "ros1"}, "the command line belongs to the programs"),
    (r"iostream", {"apps", "tests"}, "the library never prints"),
    (r"wx/.*", set(), "wxWidgets has no place here"),
]

# What only our own sources use: whoever has sigloc installed need not have these.
NOT_IN_PUBLIC_HEADERS = re.compile(r"(boost|fmt|nlohmann)/.*|(png|zlib|zstd)\.h")

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCE = ROOT / "src"
INCLUDED = ROOT / "include"

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
PRINTS = re.compile(r"\bstd::(cout|cerr|clog)\b|(?<![a-zA-Z_])(f?printf|puts)\(")
EQUATION = re.compile(r"\((\d+\.\d+)\)")
# A page says no "eq.", so there a number in brackets from 1 on is taken for an equation's.
EQUATION_OF_PAGE = re.compile(r"\(([1-9]\d?\.\d{1,2})\)")
WRITES_PAGES = {"scripts/results/data_use.py"}  # its equations are in docs/results
CITES_EQUATION = re.compile(r"\b[Ee]q\.")
CITES_OTHER_PAGE = re.compile(r"\\cite (?!algorithm\b)[a-z]")  # papers begin with a name
OWN_PATH = re.compile(
    r"(?<![\w/.<-])(?:src|include|apps|docs|examples|python|ros|scripts|tests|cmake)/[\w/.-]*\w(?![\w*<{$]|/[*<{$])"
)
LINK = re.compile(r"\]\(([\w./-]+)[)#]")
SPDX = ["SPDX-FileCopyrightText: 2026 the sigloc authors", "SPDX-License-Identifier: BSD-3-Clause"]
SPDX_SUFFIXES = {".h", ".cpp", ".py", ".pyi", ".sh", ".cmake", ".cmake.in", ".gp", ".ini"}


def module_of_public(header):
    """Returns the module of a public header: where the source file of its name lies."""
    part, name = pathlib.PurePath(header).parts[1:3]
    for module in MODULES:
        if module.split("/")[0] == part and (SOURCE / module / name).with_suffix(".cpp").is_file():
            return module
    return part


def place(path):
    """Returns (kind, name) of a source file: a module, an app, an example, a kind of test."""
    parts = path.parts
    if parts[:2] == ("include", "sigloc") and len(parts) == 3:
        return "umbrella", parts[2]
    if parts[0] == "include" and len(parts) == 4:
        return "module", module_of_public("/".join(parts[1:]))
    if parts[0] == "src" and len(parts) > 2:
        return "module", "/".join(parts[1:-1])
    if parts[0] in ("python", "ros") and len(parts) > 2:
        return "module", "/".join(parts[1:-1])
    if parts[0] == "examples":
        return "examples", path.stem
    if parts[0] in ("apps", "tests") and len(parts) > 2:
        if parts[0] == "apps" and parts[1] == "render":
            return "module", "render"
        return parts[0], parts[1]
    return "none", ""


def allowed_modules(kind, name):
    if kind == "module":
        return set(MODULES[name])
    if kind in ("examples", "umbrella"):
        return set(MODULES["slam"])
    if kind == "apps" and name in PRODUCT_APPS:
        return set(MODULES["render"])
    if kind == "tests" and name in CORE_TESTS:
        return set(CORE)
    return set(MODULES)


def allowed_mrpt_modules(kind, name):
    if kind == "module":
        return MRPT_MODULES[name]
    if kind == "tests" and name in CORE_TESTS:
        return MRPT_CORE
    return WITH_SLAM if kind in ("tests", "examples") else MRPT_BRIDGE


def own_include_violations(path, kind, name, header):
    is_public = header.startswith("sigloc/")
    module = module_of_public(header) if header.count("/") == 2 and is_public else ""
    if not is_public:
        module = str(pathlib.PurePath(header).parent)
        if module not in MODULES:
            beside = path.parent / header  # where a compiler looks first
            if beside.parts[0] == "src" and (ROOT / beside).is_file():
                yield f"{header}: include from the root, not relative to the folder"
            return
        if path.parts[0] == "include" or kind == "examples" or (
            kind in ("apps", "module") and path.parts[0] == "apps" and not module.startswith("eval")
        ):
            yield f"{header}: is not installed; users' headers, apps and examples do without"
    if is_public and header != "sigloc/sigloc.h" and not (INCLUDED / header).is_file():
        yield f"{header}: no such public header"
    if header == "sigloc/sigloc.h" and kind == "module":
        yield f"{header}: includes every module"
    upward = module not in allowed_modules(kind, name) and name not in VOCABULARY.get(header, ())
    if module and upward:
        yield f"{kind} '{name}' may not include module '{module}' ({header})"


def include_violations(path, kind, name, header):
    yield from own_include_violations(path, kind, name, header)
    mrpt = re.match(r"mrpt/([^/]+)[/.]", header)
    if mrpt and mrpt.group(1) not in allowed_mrpt_modules(kind, name):
        yield f"{kind} '{name}' may not include MRPT module '{mrpt.group(1)}' ({header})"
    for pattern, folders, reason in RESTRICTED:
        if re.fullmatch(pattern, header) and kind not in folders and name not in folders:
            yield f"{header}: {reason}"
    if path.parts[0] == "include" and NOT_IN_PUBLIC_HEADERS.fullmatch(header):
        yield f"{header}: users do without it"
    if ".." in header:
        yield f"{header}: include from the root, not relative to the folder"


def source_violations(path, lines):
    kind, name = place(path)
    if kind == "none" or (kind == "module" and name not in MODULES):
        yield 1, "a source file outside the folders of docs/architecture.md"
        return
    for number, line in enumerate(lines, 1):
        if kind == "module" and path.name != "main.cpp" and PRINTS.search(line):
            yield number, "the library never prints"
        match = INCLUDE.match(line)
        for reason in include_violations(path, kind, name, match[1]) if match else ():
            yield number, reason


def citation_violations(path, lines, equations):
    """Finds cited equations that are not there; in code a citation is on the line that says "eq."."""
    is_code = path.suffix in (".h", ".cpp")
    for number, line in enumerate(lines, 1):
        if is_code and CITES_OTHER_PAGE.search(line):
            yield number, "cites a page that is not docs/algorithm.md"
        if is_code and not CITES_EQUATION.search(line):
            continue
        for equation in (EQUATION if is_code else EQUATION_OF_PAGE).findall(line):
            if equation not in equations:
                yield number, f"equation ({equation}) is not in docs/algorithm.md"


def is_there(path):
    """True for a file or folder, and for a file named without its suffix: `src/tracking/rivals`."""
    return path.exists() or any(path.parent.glob(path.name + ".*"))


def path_violations(path, lines):
    for number, line in enumerate(lines, 1):
        for named in OWN_PATH.findall(line):
            if not is_there(ROOT / named):
                yield number, f"there is no {named}"
        for target in LINK.findall(line) if path.suffix == ".md" else ():
            if not ((ROOT / path).parent / target).exists():
                yield number, f"links to {target}, which is not there"


def needs_spdx(path, lines):
    is_script = bool(lines) and lines[0].startswith("#!")
    return is_script or path.name == "CMakeLists.txt" or bool(set(path.suffixes) & SPDX_SUFFIXES)


def file_violations(path, text, equations):
    lines = text.splitlines()
    is_code = path.suffix in (".h", ".cpp")
    if path.suffix in (".hpp", ".hh", ".cc", ".cxx", ".c"):
        yield 1, "headers end in .h, sources in .cpp"
    yield from path_violations(path, lines)
    if needs_spdx(path, lines):
        if len(lines) > MAX_LINES:
            yield len(lines), f"{len(lines)} lines, more than {MAX_LINES}"
        head = "\n".join(lines[:4])
        if not all(line in head for line in SPDX):
            yield 1, "the two SPDX lines are missing"
    if is_code:
        yield from source_violations(path, lines)
    if is_code or path.suffix == ".md" or str(path) in WRITES_PAGES:
        yield from citation_violations(path, lines, equations)


def own_files(root):
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=root, capture_output=True, text=True, check=True,
    )  # fmt: skip
    for line in sorted(set(listed.stdout.splitlines())):
        path = pathlib.Path(line)
        # Notes, but for one, and results tell of their time; what is in maps/ and rawlogs/ is data.
        is_ours = not re.match("(maps|rawlogs|docs/(lab-notes(?!/choices-and-data)|results|images))/", line)
        if is_ours and (root / path).is_file():
            yield path


def crowded_folders(paths):
    """Finds folders of src/ with too many files, and too many public headers."""
    folders = [path.parent for path in paths if path.parts[0] == "src"]
    for folder in sorted(set(folders)):
        if folders.count(folder) > MAX_FILES:
            yield f"{folder}: {folders.count(folder)} files, more than {MAX_FILES}"
    public = sum(path.parts[0] == "include" for path in paths)
    if public > MAX_PUBLIC_HEADERS:
        yield f"include: {public} public headers, more than {MAX_PUBLIC_HEADERS}"


def binary_violations(folder):
    """Checks the libraries that each binary asks for by itself (its NEEDED entries)."""
    binaries = [*folder.glob("bin/*"), *folder.glob("lib/**/*")]
    for path in sorted(p for p in binaries if p.is_file() and not p.is_symlink()):
        dump = subprocess.run(["readelf", "-d", str(path)], capture_output=True, text=True)
        needed = re.findall(r"\(NEEDED\).*\[(.+?)\]", dump.stdout)
        is_library = ".so" in path.name
        is_launcher = path.name in PRODUCT_APPS
        for library in needed:
            if re.match(r"libmrpt-(apps|gui)\.|libwx_", library):
                yield f"{path.name} links {library}"
            if is_library and library.startswith("libOSMesa"):
                yield f"{path.name} links {library}: only executables may"
            if library.startswith(("libmrpt-slam", "libsigloc-slam")) and re.match(
                r"libsigloc-mrpt|libsigloc-hw|sigloc-(map|localize|align|ros1)", path.name
            ):
                yield f"{path.name} links {library}, which takes long to load"
            if is_launcher and re.match(r"libsigloc|libmrpt-(img|opengl|obs|maps)\.", library):
                yield f"{path.name} links {library}: it loads that once its arguments are right"
            if library.startswith("libmrpt-hwdrivers") and "hwdrivers" not in path.name:
                yield f"{path.name} links {library}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--binaries", type=pathlib.Path, help="build folder to check as well")
    arguments = parser.parse_args()
    root = ROOT
    # An equation's number ends its line.
    method = (root / "docs" / "algorithm.md").read_text(encoding="utf-8")
    known = set(re.findall(r"\((\d+\.\d+)\)$", method, re.MULTILINE))
    violations = []
    paths = list(own_files(root))
    violations += crowded_folders(paths)
    count = 0
    for path in paths:
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
