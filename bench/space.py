#!/usr/bin/env python3
"""What a step in space costs: cubes of n x n x n hexahedra on a rigid plane, two cubes on each
other with matching and with shifted nodes, bars of 100 x 2 x 2.  bench/space.py [N ...]

Processor seconds from the timers of bipact.log: the factor once, then a step and its parts.
Read ratios within one table, not single times."""

import argparse
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))
import startup

from make_space import grid

STEPS = 40
PHASES = ("factorisation", "solves", "contact search", "contact")


def cards(x, elements, number, first):
    out = ["*NODE"] + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(x)]
    out += ["*ELEMENT_SOLID"]
    out += [
        "%d,%d,%s" % (first + k, number, ",".join(str(first + n) for n in e))
        for k, e in enumerate(elements)
    ]
    out += ["*PART", "body", "%d,%d,%d" % (number, number, number), "*SECTION_SOLID"]
    out += ["%d,1" % number, "*MAT_ELASTIC", "%d,1.0,1000.0,0.3" % number]
    out += ["*SET_NODE_LIST", "%d," % number]
    ids = [str(first + k) for k in range(len(x))]
    return out + [",".join(ids[k : k + 8]) + "," for k in range(0, len(ids), 8)]


def scene(kind, n):
    """(deck, unknowns): bodies that touch in the first steps and press on each other."""
    if kind == "bars":
        bodies = [
            grid((100, 2, 2), lambda i, j, k: [i / 10.0 + at, j / 2.0, k / 2.0])
            for at in (0.0, 10.001)
        ]
        speeds, step = ("1.0,0.0,0.0", "-1.0,0.0,0.0"), 1.0e-3
    else:
        shift = 0.37 / n if kind == "shifted" else 0.0
        bodies = [grid((n, n, n), lambda i, j, k: [i / n, j / n, k / n + 0.001])]
        if kind != "wall":
            low = grid((n, n, n), lambda i, j, k: [i / n + shift, j / n + shift, k / n - 1.0])
            bodies.append(low)
        speeds, step = ("0.3,0.0,-1.0", "0.0,0.0,1.0"), 0.01 / n
    out = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % (STEPS * step)]
    out += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % step, "*CONTROL_IMPLICIT_DYNAMICS", "1,"]
    for b, (x, elements) in enumerate(bodies):
        out += cards(x, elements, b + 1, 1 + 1000000 * b)
        out += ["*INITIAL_VELOCITY", "%d," % (b + 1), speeds[b]]
    if kind == "wall":
        out += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,0.0,1.0,0.3"]
    else:
        out += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,3,3", "0.3,"]
    return "\n".join(out + ["*END", ""]), 3 * sum(len(x) for x, _ in bodies)


def measure(kind, n, program):
    with tempfile.TemporaryDirectory() as folder:
        deck, unknowns = scene(kind, n)
        path = os.path.join(folder, "scene.k")
        with open(path, "w", encoding="ascii") as file:
            file.write(deck)
        done = subprocess.run(
            [program, path, "-o", folder, "--quiet"], capture_output=True, text=True
        )
        if done.returncode:
            raise SystemExit("%s %d: %s" % (kind, n, done.stderr))
        with open(os.path.join(folder, "bipact.log"), encoding="utf-8") as file:
            log = file.read()
    engine, size, work = re.search(
        r"solver (\w+), .* factor (\d+) bytes, .*\((\S+) Gflop", log
    ).groups()
    times = [
        float(re.search(r"(?m)^%s +(\S+) +\d+$" % phase, log).group(1)) for phase in PHASES
    ]
    rows = sum(
        int(k) for k in re.findall(r"(?:edge|vertex|second|wall|crossing) (\d+)", log)[:5]
    )
    solves = int(re.search(r"contact solves (\d+)", log).group(1))
    return unknowns, engine, int(size) / 1e6, float(work), times, rows / max(1, solves)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "sizes", nargs="*", type=int, default=[6, 10, 16, 22], help="n of cubes"
    )
    parser.add_argument("--bin", default=startup.program(), help="program")
    a = parser.parse_args()
    print(
        "scene        n    dofs  engine         MB   Gflop  factor s | ms a step:  solves  search"
        " contact | rows"
    )
    cases = [("wall", n) for n in a.sizes] + [("matching", n) for n in a.sizes[:2]]
    cases += [("shifted", n) for n in a.sizes[:2]] + [("bars", 100)]
    for kind, n in cases:
        unknowns, engine, size, work, times, rows = measure(kind, n, a.bin)
        per_step = [1e3 * t / STEPS for t in times[1:]]
        print(
            "%-9s %4d %7d  %-10s %6.1f %7.3f %9.3f | %19.3f %7.3f %7.3f | %4.0f"
            % (kind, n, unknowns, engine, size, work, times[0], *per_step, rows)
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
