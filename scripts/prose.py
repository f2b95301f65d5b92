#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that our prose is plain: no sentence longer than MAX_WORDS (in README.md fewer), none of the HOME_MADE words.

Reads the text of Markdown pages (tables, code and formulas aside) and the comments of C++ sources.
Prints one line a finding, `path:line: reason`, and exits 1 when there is one.

  scripts/prose.py [FILE...]
"""
import pathlib
import re
import subprocess
import sys

MAX_WORDS = 30
MAX_WORDS_OF = {"README.md": 25}  # the page that everybody reads
ROOT = pathlib.Path(__file__).resolve().parent.parent

# Words of our own for what the field has a term for: pattern, the term.
HOME_MADE = [
    (r"\b(one|a|first|single|latest|last|whole|each|another|second) looks?\b(?!-)", "scan"),
    (r"\blooks? by look\b", "scan by scan"),
    (r"\b(un)?mapped land\b|\bthe land\b|\boff (the|its) land\b", "mapped area"),
    (r"\bquick field\b", "coarse field"),
    (r"\bscene facts\b|\bexplained facts?\b", "explained constraints"),
]

CODE_SPAN = re.compile(r"``?[^`]*``?")
LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
WORD = re.compile(r"[^\W_]*[^\W\d_][^\W_]*(?:['’-][^\W_]+)*")
# A sentence ends at . ! ? or a colon before a list; not after an abbreviation or inside a number.
END = re.compile(r"(?<!\be\.g)(?<!\bi\.e)(?<!\beq)(?<!\bet al)(?<!\bcf)(?<!\bvs)[.!?](?=[\s)\"*]|$)")


def sentences(lines):
    """Yields (line number, sentence) of numbered lines that belong together."""
    text, starts = "", []
    for number, line in lines:
        starts.append((len(text), number))
        text += line.strip() + " "
    begin = 0
    for end in [match.end() for match in END.finditer(text)] + [len(text)]:
        sentence = text[begin:end].strip()
        if sentence:
            at = begin + len(text[begin:]) - len(text[begin:].lstrip())
            yield max(number for offset, number in starts if offset <= at), sentence
        begin = end


def markdown_blocks(lines):
    """Yields lists of (number, line): paragraphs and items, without tables, code and formulas."""
    block, in_code = [], False
    for number, line in enumerate(lines, 1):
        is_fence = line.lstrip().startswith("```")
        in_code ^= is_fence
        is_item = re.match(r"\s*([*-]|\d+\.)\s", line)
        skip = in_code or is_fence or not line.strip() or line.lstrip().startswith(("|", "#", "!", "<!"))
        if skip or is_item or line.startswith("    "):
            if block:
                yield block
            block = []
        if not skip and not line.startswith("    "):
            block.append((number, re.sub(r"^\s*([*-]|\d+\.)\s+", "", line)))
    if block:
        yield block


def comment_blocks(lines):
    """Yields the comments of a C++ source, paragraph by paragraph; no code in them, no tables."""
    block = []
    for number, line in enumerate(lines, 1):
        match = re.search(r"(?:^|\s)//[/!]?<?(.*)$", line)
        text = match.group(1) if match and '"' not in line[: match.start()] else ""
        alone = line.lstrip().startswith("//")
        is_code = text.startswith("     ") or "SPDX-" in text or "NOLINT" in text
        is_item = re.match(r"\s*([*-]|\d+\.)\s", text)
        if not text.strip() or is_code or is_item or not alone:
            if block:
                yield block
            block = []
        if text.strip() and not is_code:
            block.append((number, re.sub(r"^\s*([*-]|\d+\.)\s+", "", text)))
    if block:
        yield block


def findings(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    blocks = markdown_blocks(lines) if path.suffix == ".md" else comment_blocks(lines)
    most = MAX_WORDS_OF.get(str(path.relative_to(ROOT)), MAX_WORDS)
    for block in blocks:
        for number, sentence in sentences(block):
            plain = LINK.sub(r"\1", CODE_SPAN.sub("x", sentence))
            count = len(WORD.findall(plain))
            if count > most:
                yield number, f"a sentence of {count} words: {sentence[:60]}..."
            for pattern, term in HOME_MADE:
                found = re.search(pattern, plain)
                if found:
                    yield number, f"'{found.group(0)}': say '{term}'"


def main():
    patterns = ["*.md", "*.h", "*.cpp"]
    listed = sys.argv[1:] or subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns],
        cwd=ROOT, capture_output=True, text=True, check=True,
    ).stdout.split("\n")  # fmt: skip
    paths = [ROOT / name for name in sorted(set(listed)) if name]
    count = 0
    for path in paths:
        if not path.is_file():
            continue
        for number, reason in findings(path):
            print(f"{path.relative_to(ROOT)}:{number}: {reason}")
            count += 1
    if count:
        return 1
    print(f"prose: {len(paths)} files in order")
    return 0


if __name__ == "__main__":
    sys.exit(main())
