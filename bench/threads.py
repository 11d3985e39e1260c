#!/usr/bin/env python3
"""What threads gain. First a linear solver alone on the square of 2e5 unknowns and the cube of 20
nodes a side: processor time of the slowest thread and of what one thread does alone, over that of one
thread (targets: .62 and .77). Then steps at finite deformation: the same ratio in instructions
(valgrind). No wall time is read, so that other work on the machine does not matter much; of several
rounds the least counts."""

import argparse
import os
import re
import subprocess
import sys
import tempfile

import common

sys.path.insert(0, os.path.join(common.ROOT, "tests", "support"))

CASES = (
    ("LDLT", 317, 2, 0.62),
    ("SUPERNODAL", 317, 2, 0.62),
    ("SUPERNODAL", 20, 3, 0.77),
)
SOLVERS = os.path.join(common.ROOT, "build", "release", "bench", "linear_solvers")


def solver_seconds(engine, n, d, threads, rounds):
    """Seconds of a factor and of a solve, the least of some rounds."""
    command = [SOLVERS, engine, str(n), str(d), "WHOLE", str(threads)]
    environment = dict(os.environ, OMP_WAIT_POLICY="passive")
    found = []
    for _ in range(rounds):
        text = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        words = re.search(r"factor (\S+) s .*solve (\S+) ms", text.stdout)
        found.append((float(words.group(1)), 1.0e-3 * float(words.group(2))))
    return [min(column) for column in zip(*found)]


def solvers(threads, rounds):
    """Prints the table of linear solvers."""
    print("engine       n d threads  factor s  ratio  solve ms  ratio  target")
    for engine, n, d, target in CASES:
        one = None
        for count in threads:
            factor, solve = solver_seconds(engine, n, d, count, rounds)
            one = one or (factor, solve)
            row = (factor, factor / one[0], 1e3 * solve, solve / one[1])
            text = "%-10s %3d %d %7d " % (engine, n, d, count)
            text += "%9.3f %6.3f %9.3f %6.3f" % row
            print(text + ("  %.2f" % target if count == 2 else ""), flush=True)


def instructions(deck, threads, folder):
    """Instructions of each thread of a run."""
    out = os.path.join(folder, "counts")
    for name in os.listdir(folder):
        if name.startswith("counts"):
            os.remove(os.path.join(folder, name))
    command = ["valgrind", "--tool=callgrind", "--separate-threads=yes", "--fair-sched=yes"]
    command += ["--callgrind-out-file=" + out, common.PROGRAM, deck, "--quiet", "-o"]
    command += [os.path.join(folder, "results"), "--threads", str(threads)]
    environment = dict(os.environ, OMP_WAIT_POLICY="passive")
    subprocess.run(command, env=environment, capture_output=True, check=True)
    counts = []
    for name in sorted(os.listdir(folder)):
        if re.match(r"counts-\d+$", name):
            with open(os.path.join(folder, name)) as file:
                counts += [int(x) for x in re.findall(r"^totals: (\d+)", file.read(), re.M)]
    return counts


def steps(threads):
    """Prints the instructions of steps at finite deformation, from runs of two lengths."""
    os.environ.update(ROOT=common.ROOT, BIPACT=common.PROGRAM, TMP=tempfile.gettempdir())
    import finite_scenes
    import solids

    print("finite deformation       threads  Minstructions a step of each thread  largest/one")
    meshes = {"plane": finite_scenes.Disc(40, (0.0, 0.0)), "space": solids.Box((8, 8, 8))}
    with tempfile.TemporaryDirectory() as folder:
        for name, mesh in meshes.items():
            lines = finite_scenes.body(mesh, "neo-hooke") + finite_scenes.finite()
            v = 0.2 * (mesh.x - mesh.x.mean(axis=0)) * [1.0, 2.0, 0.5][: len(mesh.x[0])]
            lines += finite_scenes.thrown(v, range(len(mesh.x)))
            one = None
            for count in threads:
                found = []
                for last in (1, 3):
                    deck = os.path.join(folder, "deck.k")
                    with open(deck, "w") as file:
                        file.write(solids.deck(lines, 5.0e-3, 5.0e-3 * last))
                    found.append(instructions(deck, count, folder))
                each = [0.5e-6 * (b - a) for a, b in zip(*found)]
                one = one or max(each)
                text = " ".join("%.1f" % x for x in each)
                print("%-24s %7d  %-35s  %.3f" % (name, count, text, max(each) / one), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="of each solver (3)")
    parser.add_argument("--threads", default="1,2,3,4", help="numbers of threads (1,2,3,4)")
    parser.add_argument("--only", choices=("solvers", "steps"), help="one of the two tables")
    arguments = parser.parse_args()
    threads = [int(x) for x in arguments.threads.split(",")]
    if arguments.only != "steps":
        solvers(threads, arguments.rounds)
    if arguments.only != "solvers":
        steps(threads)


if __name__ == "__main__":
    main()
