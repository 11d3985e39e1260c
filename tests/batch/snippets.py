"""The Python that a page shows, run where README's first deck was run: snippets.py PAGE WORD
runs each block of PAGE that contains WORD, and checks that every column that it reads has the
numbers of the table, bit for bit."""

import os
import re
import sys

ROOT = os.environ["ROOT"]
sys.path.insert(0, os.path.join(ROOT, "scripts"))


def numbers(path):
    """{column: numbers} of a table, read by plain Python."""
    with open(path) as file:
        lines = file.read().splitlines()
    names = [line for line in lines if line.startswith("#")][-2].split()[1:]
    rows = [[float(word) for word in line.split()] for line in lines if line[0] != "#"]
    return dict(zip(names, zip(*rows)))


def main():
    page, word = sys.argv[1:]
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        blocks = re.findall(r"(?m)(?:^    .*\n|^\n(?=    ))+", file.read())
    blocks = [re.sub("(?m)^    ", "", b) for b in blocks if word in b and "import " in b]
    passed = failed = 0
    truth = numbers("first.out/glstat.tab")
    for block in blocks:
        found = {}
        exec(block, found)
        table = found.get("table")
        columns = (
            {n: table[n] for n in table.columns}
            if table is not None
            else {n: found[n] for n in truth if n in found}
        )
        for name, column in columns.items():
            same = tuple(float(x) for x in column) == truth.get(name)
            passed, failed = passed + same, failed + (not same)
            print("%-12s %s" % (name, "as in the table" if same else "DIFFERS"))
    print("%d passed, %d failed" % (passed, failed))
    return failed > 0 or passed < 3


if __name__ == "__main__":
    sys.exit(main())
