#!/usr/bin/env python3
"""Reading is linear: bipact --check on decks of 1e4 to N nodes and as many elements, beside wc
and Python's readline in the same run. Processor seconds (user + system) of each whole process,
the least of three; memory is the peak."""

import argparse
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEAD = """*KEYWORD
*CONTROL_TERMINATION
       1.0
*CONTROL_IMPLICIT_GENERAL
         1       0.1
*CONTROL_IMPLICIT_DYNAMICS
         1
*BIPACT_TIME
     THETA
*PART
a square
         1         1         1
*SECTION_SHELL
         1        13                   4
       1.0
*MAT_ELASTIC
         1       1.0    1000.0       0.3
"""


def write_square(path, n):
    """A square of n x n quadrilaterals."""
    with open(path, "w") as out:
        out.write(HEAD + "*NODE\n")
        for j in range(n + 1):
            out.write(
                "".join(
                    "%8d%16.10f%16.10f\n" % (j * (n + 1) + i + 1, i / n, j / n)
                    for i in range(n + 1)
                )
            )
        out.write("*ELEMENT_SHELL\n")
        for j in range(n):
            first = j * (n + 1) + 1
            out.write(
                "".join(
                    "%8d%8d%8d%8d%8d%8d\n"
                    % (
                        j * n + i + 1,
                        1,
                        first + i,
                        first + i + 1,
                        first + n + i + 2,
                        first + n + i + 1,
                    )
                    for i in range(n)
                )
            )
        out.write("*END\n")


def measure(command):
    """(least processor seconds of three runs, peak MiB)."""
    best, peak = float("inf"), 0
    for _ in range(3):
        child = os.fork()
        if child == 0:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            os.execvp(command[0], command)
        _, status, usage = os.wait4(child, 0)
        if status != 0:
            raise SystemExit("%s failed" % command[0])
        best, peak = min(best, usage.ru_utime + usage.ru_stime), max(peak, usage.ru_maxrss)
    return best, peak / 1024.0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--nodes", type=float, default=1.0e6, help="size of the largest deck (1e6)"
    )
    a = parser.parse_args()
    program = os.path.join(ROOT, "bin", "bipact")
    lines = "for x in open(%r, 'rb'): pass"
    print(
        "%9s %8s %10s %8s %9s | %8s %10s"
        % ("nodes", "MB", "bipact s", "MB/s", "MiB", "wc s", "readline s")
    )
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "square.k")
        for nodes in (1.0e4, 1.0e5, a.nodes):
            n = int(round(nodes**0.5))
            write_square(deck, n)
            size = os.path.getsize(deck) / 1.0e6
            seconds, peak = measure([program, deck, "--check"])
            wc = measure(["wc", deck])[0]
            readline = measure([sys.executable, "-c", lines % deck])[0]
            print(
                "%9d %8.1f %10.3f %8.0f %9.0f | %8.3f %10.3f"
                % ((n + 1) ** 2, size, seconds, size / seconds, peak, wc, readline)
            )


if __name__ == "__main__":
    main()
