#!/usr/bin/env python3
"""Read the tables (NAME.tab) that a run leaves in its directory.

Layout of a table: header lines that start with '#', the last of them holding the bare column
names; one row of numbers per time (per time and id where the table has an id column); a closing
line '# end: done | failed | stopped, cycle N'.  Numbers are in the units of the deck.

    from tables import read_table
    nodout = read_table("run/nodout.tab")
    nodout.select(node=201)["ux"]          # history of one node, a numpy array

On the command line: a summary of the tables of a run (columns, rows, range of every column).
"""

import argparse
import glob
import os
import re
import sys

import startup  # noqa: F401  before what is no part of Python
import numpy as np

INTEGER_COLUMNS = frozenset(
    "cycle node part element contact side wall nactive nstick nslip status "
    "solves sweeps factors".split()
)
ID_COLUMNS = ("node", "part", "element", "wall", "contact", "side")
END_LINE = re.compile(r"#\s*end:\s*(\w+)[\s,]*cycle\s+(\d+)")


class TableError(Exception):
    """A table that cannot be read; the text names the file and the reason."""


class Table:
    """Columns of one table by name.

    names   column names in file order
    header  header lines without '#', as written
    status  'done', 'failed' or 'stopped'; '' where the closing line is missing
    cycle   number of the last step [-], from the closing line; None where it is missing
    """

    def __init__(self, path, names, data, header, status, cycle):
        self.path, self.names, self.header = path, names, header
        self.status, self.cycle = status, cycle
        self._data = data

    def __getitem__(self, name):
        try:
            return self._data[name]
        except KeyError:
            raise TableError(
                "%s: no column '%s'; there are: %s" % (self.path, name, " ".join(self.names))
            ) from None

    def __contains__(self, name):
        return name in self._data

    def __len__(self):
        return len(self._data[self.names[0]]) if self.names else 0

    def rows(self, keep):
        """Table of the rows that the mask or index array keeps."""
        data = {name: column[keep] for name, column in self._data.items()}
        return Table(self.path, self.names, data, self.header, self.status, self.cycle)

    def select(self, **ids):
        """Table of the rows whose id columns have the given values, e.g. node=7, side=1."""
        keep = np.ones(len(self), dtype=bool)
        for name, value in ids.items():
            keep &= self[name] == value
        return self.rows(keep)

    @property
    def id_columns(self):
        """Names of the columns that say of what a row is: those of ids right after the time."""
        found = []
        for name in self.names[1:]:
            if name not in ID_COLUMNS:
                break
            found.append(name)
        return found

    def ids(self, name):
        """The different values of an id column, sorted."""
        return np.unique(self[name])

    def vectors(self, *names):
        """Columns side by side: array (rows, len(names))."""
        return np.column_stack([self[name] for name in names])


def split_lines(lines):
    """Header lines before the data, data lines, closing line ('' if there is none)."""
    marks = [i for i, line in enumerate(lines) if line.startswith("#")]
    closing = next((lines[i] for i in reversed(marks) if END_LINE.match(lines[i])), "")
    body = [line for line in lines if line.strip() and not line.startswith("#")]
    first = lines.index(body[0]) if body else len(lines)
    header = [lines[i] for i in marks if i < first and not END_LINE.match(lines[i])]
    return header, body, closing


def parse_numbers(path, body, columns):
    """Array (rows, columns) of the data lines; an error names the first bad row."""
    if not body:
        return np.empty((0, columns))
    try:
        numbers = np.loadtxt(body, ndmin=2, comments=None)
    except ValueError as problem:
        raise TableError("%s: %s" % (path, problem)) from None
    if numbers.shape[1] != columns:
        raise TableError(
            "%s: rows have %d fields, the header names %d columns"
            % (path, numbers.shape[1], columns)
        )
    return numbers


def to_columns(names, numbers):
    """Dictionary of contiguous columns; ids and counts become integers."""
    data = {}
    for k, name in enumerate(names):
        column = np.ascontiguousarray(numbers[:, k])
        whole = name in INTEGER_COLUMNS and np.all(np.abs(column) < 2.0**53)
        whole = whole and np.array_equal(column, np.rint(column))
        data[name] = column.astype(np.int64) if whole else column
    return data


def read_table(path):
    """Read one table; a missing file or a damaged row raises TableError."""
    try:
        with open(path, encoding="ascii", errors="replace") as stream:
            lines = stream.read().splitlines()
    except OSError as problem:
        raise TableError("%s: %s" % (path, problem.strerror)) from None
    header, body, closing = split_lines(lines)
    if not header:
        raise TableError("%s: no line of column names" % path)
    names = header[-1].lstrip("#").split()
    data = to_columns(names, parse_numbers(path, body, len(names)))
    match = END_LINE.match(closing)
    status, cycle = (match.group(1), int(match.group(2))) if match else ("", None)
    return Table(path, names, data, [h.lstrip("#").strip() for h in header], status, cycle)


def read_run(directory, name):
    """Table NAME of a run directory, or None where the run did not write it."""
    path = os.path.join(directory, name + ".tab")
    return read_table(path) if os.path.exists(path) else None


def write_table(path, names, columns, status="done", cycle=0, title=""):
    """Write a table in the same layout (for tests and for derived results)."""
    integer = [name in INTEGER_COLUMNS for name in names]
    with open(path, "w", encoding="ascii") as out:
        out.write("# %s\n#%s\n" % (title, " ".join(n.rjust(24) for n in names)))
        for row in zip(*columns):
            out.write(" ".join(format_number(v, i) for v, i in zip(row, integer)) + "\n")
        out.write("# end: %s, cycle %d\n" % (status, cycle))


def format_number(value, integer):
    """24 columns: an integer, or a real as Fortran's ES24.16E3 prints it."""
    if integer:
        return "%24d" % value
    mantissa, _, exponent = ("%.16E" % value).partition("E")
    text = "%sE%+04d" % (mantissa, int(exponent)) if exponent else mantissa
    return text.rjust(24)


def summarise(table):
    """Lines of text: the table's size, end and the range of every column."""
    end = "%s, cycle %d" % (table.status, table.cycle) if table.status else "no closing line"
    yield "%s: %d rows, %s" % (table.path, len(table), end)
    for name in table.names:
        column = table[name]
        if name in ID_COLUMNS:
            ids = table.ids(name)
            yield "  %-12s ids: %s%s" % (
                name,
                " ".join(map(str, ids[:8])),
                " ..." if len(ids) > 8 else "",
            )
        elif len(column):
            yield "  %-12s %24.16E .. %24.16E" % (name, column.min(), column.max())


def main(argv=None):
    parser = argparse.ArgumentParser(
        description="Print rows, end and column ranges of the tables of a run."
    )
    parser.add_argument("path", nargs="+", help="NAME.tab, or a run directory")
    arguments = parser.parse_args(argv)
    try:
        for path in arguments.path:
            inside = os.path.isdir(path)
            for name in sorted(glob.glob(os.path.join(path, "*.tab"))) if inside else [path]:
                print("\n".join(summarise(read_table(name))))
    except TableError as problem:
        print("tables.py: %s" % problem, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
