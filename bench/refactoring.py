#!/usr/bin/env python3
"""A cube of foam that spins at finite deformation, whose matrix changes in each step: engines beside
each other in one run. `refactoring.py [N ...]` elements an edge (10 14 20); --courant C (1), --steps S
(6). CPU seconds of a step, without input; ratios to SUPERNODAL; iterations a solve of CG."""

import argparse
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common

os.environ.setdefault("ROOT", common.ROOT)
os.environ.setdefault("BIPACT", os.path.join(common.ROOT, "bin", "bipact"))
os.environ.setdefault("TMP", tempfile.gettempdir())
sys.path.insert(0, os.path.join(common.ROOT, "tests", "support"))
import numpy as np
from finite_scenes import body, finite, spinning, thrown
from solids import Box, deck

ENGINES = ("SUPERNODAL", "CG", "AUTO")
SPEED = np.sqrt(1.2e5)  # of pressure waves in foam, G 40, PR .25, density 1e-3


def cube(n, courant, steps, engine):
    """Text of the deck."""
    mesh = Box((n, n, n), (1.0, 1.0, 1.0), "HEX8")
    velocity = spinning(np.array(mesh.x), np.array([10.0, 20.0, 15.0]))
    lines = finite() + body(mesh, "foam") + thrown(velocity, range(len(mesh.x)))
    lines += ["*BIPACT_SOLVER", engine + ","]
    h = float(courant / n / SPEED)
    return deck(lines, h, steps * h, mass="LUMPED,0")


def measure(text, folder):
    """CPU seconds and what bipact.log says of the engine and its iterations."""
    name = os.path.join(folder, "cube.k")
    with open(name, "w") as out:
        out.write(text)
    done = common.run(name, os.path.join(folder, "out"))
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    with open(os.path.join(folder, "out", "bipact.log")) as log:
        text = log.read()
    count = re.search(r"conjugate gradients: (\d+)", text)
    solves = int(re.search(r", solves (\d+)", text)[1])
    engine = re.search(r"solver (\w+)", text)[1]
    return done["cpu"], engine, int(count[1]) / solves if count else 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("sizes", nargs="*", type=int, default=[10, 14, 20])
    parser.add_argument("--courant", type=float, default=1.0)
    parser.add_argument("--steps", type=int, default=6)
    args = parser.parse_args()
    print("dofs     engine              CPU s a step  ratio  iterations a solve")
    with tempfile.TemporaryDirectory() as folder:
        for n in args.sizes:
            first = None
            for engine in ENGINES:
                cpu = [
                    measure(cube(n, args.courant, s, engine), folder) for s in (1, 1 + args.steps)
                ]
                step = (cpu[1][0] - cpu[0][0]) / args.steps
                first = first or step
                print(
                    "%-8d %-10s %-10s %9.3f  %6.2f  %6.1f"
                    % (3 * (n + 1) ** 3, engine, cpu[1][1], step, step / first, cpu[1][2]),
                    flush=True,
                )


if __name__ == "__main__":
    main()
