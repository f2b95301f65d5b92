# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a Markdown page: written by write_results.py, read by readme_numbers."""
import textwrap

from results.runs import BadInput

WIDTH = 150


class Table:
    """Rows with a name each; a row whose first cells are None is left out."""

    def __init__(self, *head):
        self.head = head
        self.rows = {}

    def add(self, name, *cells):
        assert len(cells) == len(self.head) - 1 and name not in self.rows
        self.rows[name] = cells

    def cell(self, row, column):
        """The text of a cell, or None where there is no such row."""
        cells = self.rows.get(row)
        return None if cells is None else cells[self.head.index(column) - 1]

    def extreme(self, column, rows=None, largest=False):
        """The row, of some or all, whose cell begins with the smallest or largest number."""
        rows = self.rows if rows is None else rows
        choose = max if largest else min
        return choose(rows, key=lambda name: float(str(self.cell(name, column)).split()[0]))

    def named_cells(self):
        """The rows as lists of texts, each row's name first."""
        return [[name, *map(str, cells)] for name, cells in self.rows.items()]

    def lines(self):
        out = ["| " + " | ".join(self.head) + " |", "|---" * len(self.head) + "|"]
        return out + ["| " + " | ".join(cells) + " |" for cells in self.named_cells()]


class Section:
    """A heading, a paragraph, at most one table and at most one plot."""

    def __init__(self, title, table=None, text=(), plot=None):
        self.title = title
        self.table = table
        self.text = text
        self.plot = plot

    def is_empty(self):
        return self.table is not None and not self.table.rows

    def lines(self):
        out = [f"## {self.title}"]
        if self.text:
            out += paragraph(self.text)
        if self.plot is not None:
            out.append(f"![{self.title}](images/{self.plot})")
        if self.table is not None:
            out += ([""] if self.text else []) + self.table.lines()
        return out + [""]


def paragraph(sentences, width=WIDTH):
    return textwrap.wrap(" ".join(s for s in sentences if s), width, break_on_hyphens=False,
                         break_long_words=False)  # fmt: skip


def bullets(sentences):
    out = []
    for sentence in sentences:
        lines = textwrap.wrap(sentence, WIDTH - 2, break_on_hyphens=False)
        out += ["* " + lines[0]] + ["  " + line for line in lines[1:]]
    return out


def _cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


class Page:
    """Cells of a page's tables, looked up by the section's title, the row and the column."""

    def __init__(self, text, name):
        self.name = name
        self.lines = text.splitlines()
        self.tables = {}
        title = None
        for line in self.lines:
            if line.startswith("## "):
                title = line[3:].strip()
            elif line.startswith("|---"):
                continue
            elif line.startswith("|") and title:
                self.tables.setdefault(title, []).append(_cells(line))

    def cell(self, title, row, column):
        table = self.tables.get(title)
        if not table:
            raise BadInput(f"{self.name}: no table '{title}'")
        if column not in table[0]:
            raise BadInput(f"{self.name}: '{title}' has no column '{column}'")
        for cells in table[1:]:
            if cells[0] == row:
                return cells[table[0].index(column)]
        raise BadInput(f"{self.name}: '{title}' has no row '{row}'")

    def least(self, title, column, without):
        """The row whose cell begins with the smallest number, and that number; none that ends in `without`."""
        names = [cells[0] for cells in self.tables.get(title, [])[1:] if not cells[0].endswith(without)]
        numbers = {name: self.cell(title, name, column).split()[0] for name in names}
        if not numbers:
            raise BadInput(f"{self.name}: no row in '{title}'")
        name = min(numbers, key=lambda key: float(numbers[key]))
        return name, numbers[name]
