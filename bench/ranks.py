#!/usr/bin/env python3
"""Several ranks: processor seconds of each rank for the factor and for a step, and the memory of
the largest, on 1 to 4 ranks; two bars in the plane apart, 2e5 unknowns. A rank that waits within
MPI or MUMPS counts as busy. The factor, with the sums of its matrix, is the difference of two
runs of some steps, one with a coefficient of damping that changes in each, one with a constant; a
step is that of two lengths of run. On one rank also with ENGINE MUMPS."""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import make_bars

PROGRAM = os.path.join(common.ROOT, "bin", "bipact-mpi")


FACTORS = 6
STEPS = 20


def deck_of(folder, nx, ny, steps, end, engine):
    """A deck without tables, of bars far apart that are damped by 1 at the start, and by `end`
    after many steps. Returns its path."""
    path = os.path.join(folder, "bars-%d-%g-%s.k" % (steps, end, engine))
    scene = dict(nx=nx, ny=ny, courant=0.5, gap=5.0)
    dt = make_bars.write(path, tend=None, **scene)["dt"]
    make_bars.write(path, tend=steps * dt, **scene)
    path = common.without_tables(path)
    with open(path) as file:
        text = file.read()
    cards = "*DEFINE_CURVE\n77,\n0.0,1.0\n%r,%r\n*DAMPING_PART_MASS\n1,77,1.0\n" % (100 * dt, end)
    cards += "*BIPACT_SOLVER\n%10s\n" % engine
    with open(path, "w") as file:
        file.write(text.replace("*END", cards + "*END"))
    return path


def run(deck, folder, ranks):
    """(processor seconds, MB) of each rank."""
    root = ["--allow-run-as-root"] if os.getuid() == 0 else []
    shell = '/usr/bin/time -o "%s/$OMPI_COMM_WORLD_RANK" -f "%%U %%S %%M" "$0" "$@"' % folder
    command = ["mpirun", *root, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]
    command += ["sh", "-c", shell, PROGRAM, deck, "-o", folder, "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    found = []
    for rank in range(ranks):
        with open(os.path.join(folder, str(rank))) as file:
            user, system, peak = file.read().split()
        found.append((float(user) + float(system), float(peak) / 1000.0))
    return found


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--nx", type=int, default=664, help="elements along each bar (664)")
    parser.add_argument("--ny", type=int, default=75, help="across (75)")
    parser.add_argument("--rounds", type=int, default=3, help="of which the least counts (3)")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 3, 4], help="(1 2 3 4)")
    a = parser.parse_args()
    if shutil.which("mpirun") is None or not os.path.exists(PROGRAM):
        raise SystemExit("bipact-mpi is not built: no MPI or MUMPS here")
    print("%d unknowns; of the ranks the one with the most" % (4 * (a.nx + 1) * (a.ny + 1)))
    print("ranks engine factor s  step ms  memory MB  of the others MB")
    with tempfile.TemporaryDirectory() as folder:
        serial = [(1, "LDLT")] if 1 in a.ranks else []
        for ranks, engine in serial + [(n, "MUMPS") for n in a.ranks]:
            few = deck_of(folder, a.nx, a.ny, FACTORS, 1.0, engine)
            each = deck_of(folder, a.nx, a.ny, FACTORS, 2.0, engine)
            many = deck_of(folder, a.nx, a.ny, FACTORS + STEPS, 1.0, engine)
            best = {}
            for _ in range(a.rounds):
                for deck in (few, each, many):
                    now = run(deck, folder, ranks)
                    old = best.get(deck, now)
                    best[deck] = [tuple(map(min, x, y)) for x, y in zip(now, old)]
            factor = max((x[0] - y[0]) / (FACTORS - 1) for x, y in zip(best[each], best[few]))
            step = max((x[0] - y[0]) / STEPS for x, y in zip(best[many], best[few]))
            memory = sorted((x[1] for x in best[many]), reverse=True)
            others = " ".join("%.0f" % m for m in memory[1:])
            line = "%5d %-6s %8.2f %8.1f %10.0f  %s"
            print(line % (ranks, engine, factor, 1e3 * step, memory[0], others), flush=True)


if __name__ == "__main__":
    main()
