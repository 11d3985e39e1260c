#!/usr/bin/env python3
"""Several ranks: processor seconds of each rank for the factor and for a step, and the memory of
the largest, on 1 to 4 ranks; two bars in the plane apart, 2e5 unknowns. A rank that waits within
MPI or MUMPS counts as busy. The factor is a run of one step less what the same run without a
factor takes: the explicit scheme on the same mesh; a step is a difference of two runs."""

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


def deck_of(folder, nx, ny, steps, **options):
    """A deck without tables; bars far apart. Returns its path."""
    path = os.path.join(folder, "bars-%d-%s.k" % (steps, options.get("scheme", "THETA")))
    scene = dict(nx=nx, ny=ny, courant=0.5, gap=5.0, **options)
    dt = make_bars.write(path, tend=None, **scene)["dt"]
    make_bars.write(path, tend=steps * dt, **scene)
    return common.without_tables(path)


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
    parser.add_argument("--most", type=int, default=4, help="ranks (4)")
    a = parser.parse_args()
    if shutil.which("mpirun") is None or not os.path.exists(PROGRAM):
        raise SystemExit("bipact-mpi is not built: no MPI or MUMPS here")
    print("%d unknowns; of the ranks the one with the most" % (4 * (a.nx + 1) * (a.ny + 1)))
    print("ranks  factor s  step ms  memory MB  of the others MB")
    with tempfile.TemporaryDirectory() as folder:
        few = deck_of(folder, a.nx, a.ny, 1)
        many = deck_of(folder, a.nx, a.ny, 21)
        none = deck_of(folder, a.nx, a.ny, 1, scheme="PAOLI", pbeta=0.0, mass="LUMPED")
        for ranks in range(1, a.most + 1):
            best = {}
            for _ in range(a.rounds):
                for deck in (none, few, many):
                    now = run(deck, folder, ranks)
                    old = best.get(deck, now)
                    best[deck] = [tuple(map(min, x, y)) for x, y in zip(now, old)]
            factor = max(x[0] - y[0] for x, y in zip(best[few], best[none]))
            step = max((x[0] - y[0]) / 20.0 for x, y in zip(best[many], best[few]))
            memory = sorted((x[1] for x in best[many]), reverse=True)
            others = " ".join("%.0f" % m for m in memory[1:])
            print("%5d %9.2f %8.1f %10.0f  %s" % (ranks, factor, 1e3 * step, memory[0], others))


if __name__ == "__main__":
    main()
