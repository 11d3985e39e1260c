#!/usr/bin/env python3
"""The forecast of --plan beside what a run took: memory and processor time of decks of 1e2 to 1e6
dofs. `forecast.py [WORD ...]` runs those whose name has a word; --phases prints the seconds of each
phase of a step. A forecast counts a machine to itself: on a busy one times differ more."""

import argparse
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common

os.environ.setdefault("ROOT", common.ROOT)
os.environ.setdefault("BIPACT", common.PROGRAM)
os.environ.setdefault("TMP", tempfile.gettempdir())
sys.path.insert(0, os.path.join(common.ROOT, "tests", "support"))
import numpy as np
from finite_scenes import Disc, Grid, body, finite, spinning, thrown
from solids import Box, deck


def bars(nx, ny, steps, scheme="THETA,0.5,0.5", mass="CONSISTENT,0"):
    """Two bars that meet after a third of the run, faces of ny elements."""
    h = 0.5 / nx / np.sqrt(1.0e5)
    lines = []
    for number, start in ((1, -1.0 - h * steps / 3.0), (2, h * steps / 3.0)):
        mesh = Grid(nx, ny, (1.0, ny / nx), (start, 0.0))
        first = 10000000 * number
        lines += body(mesh, "elastic", number, first)
        lines += thrown([(float(3 - 2 * number), 0.0)] * len(mesh.x), range(len(mesh.x)), first)
    lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,,,0.2"]
    return deck(lines, float(h), float(h * steps), scheme=scheme, mass=mass)


def cube(n, steps, law="elastic", courant=1.0):
    """A cube that flies onto a wall, or at finite deformation spins."""
    mesh = Box((n, n, n), (1.0, 1.0, 1.0), "HEX8")
    h = courant / n / np.sqrt(1.35e5)
    lines = finite() if law != "elastic" else []
    lines += body(mesh, law)
    if law == "elastic":
        lines += thrown([(0.0, 0.0, -1.0)] * len(mesh.x), range(len(mesh.x)))
        lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,%r,0.0,0.0,1.0,0.2" % float(-h * steps / 3)]
    else:
        velocity = spinning(np.array(mesh.x), np.array([10.0, 20.0, 15.0]))
        lines += thrown(velocity, range(len(mesh.x)))
    return deck(lines, float(h), float(h * steps), mass="LUMPED,0")


def disc(n, steps):
    """A foam disc that bounces off a floor."""
    mesh = Disc(n, (0.0, 1.01))
    lines = finite() + body(mesh, "foam") + ["*INITIAL_VELOCITY", "0,", "0.0,-20.0"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,0.3"]
    return deck(lines, 0.03 / steps, 0.03, mass="LUMPED,0")


DECKS = {
    "bars 100 x 1": lambda: bars(100, 1, 4000),
    "bars 100 x 1 NEWMARK": lambda: bars(100, 1, 4000, "NEWMARK,"),
    "bars 400 x 4": lambda: bars(400, 4, 400),
    "bars 100 x 25": lambda: bars(100, 25, 400),
    "bars 400 x 60": lambda: bars(400, 60, 60),
    "bars 500 x 100": lambda: bars(500, 100, 30),
    "bars 1000 x 250": lambda: bars(1000, 250, 10),
    "bars 400 x 60 explicit": lambda: bars(400, 60, 400, "PAOLI,,,,,,0.0", "LUMPED,0"),
    "cube 6": lambda: cube(6, 200),
    "cube 12": lambda: cube(12, 60),
    "cube 20": lambda: cube(20, 20),
    "disc 16": lambda: disc(16, 240),
    "disc 40": lambda: disc(40, 60),
    "foam cube 8": lambda: cube(8, 40, "foam"),
    "foam cube 16": lambda: cube(16, 10, "foam"),
}


def compare(name, text, folder, phases):
    """One line; where the forecast is off by more than it promises, a star."""
    path = os.path.join(folder, "forecast.k")
    with open(path, "w") as out:
        out.write(text)
    plan = subprocess.run([common.PROGRAM, path, "--plan"], capture_output=True, text=True).stdout
    found = re.search(
        r"forecast: memory (\d+) MB, start (\S+) s, a step (\S+) s, the run (\S+) s at (\S+)", plan
    )
    memory, start, step, whole, rate = map(float, found.groups())
    done = common.run(path, os.path.join(folder, "out"))
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    log = common.read_log(os.path.join(folder, "out"))
    seconds = {k[6:]: v for k, v in log.items() if k.startswith("phase ")}
    clock = sum(seconds.values())
    share = done["cpu"] / clock if clock > done["cpu"] else 1.0
    run = done["cpu"] - share * (seconds["input"] + seconds["assembly"])
    with open(os.path.join(folder, "out", "bipact.log")) as text:
        peak = int(re.search(r"peak memory (\d+) kB", text.read())[1]) * 1.024e-3
    print(
        "%-24s %7.0f %7.0f %5.2f%s  %8.1e %8.1e %5.2f%s  %5.2f"
        % (
            name,
            memory,
            peak,
            memory / peak,
            " " if 0.75 <= memory / peak <= 1.25 else "*",
            whole,
            run,
            whole / run,
            " " if 0.5 <= whole / run <= 2.0 else "*",
            rate,
        ),
        flush=True,
    )
    if phases:
        steps = log["steps"]
        per = {k: share * v / steps for k, v in seconds.items() if v > 0.02 * clock}
        print("   " + ", ".join("%s %.1e" % (k, v) for k, v in per.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("words", nargs="*")
    parser.add_argument("--phases", action="store_true")
    args = parser.parse_args()
    print("scene                     MB plan     run ratio   s plan   run      ratio   Gflop/s")
    with tempfile.TemporaryDirectory() as folder:
        for name, make in DECKS.items():
            if not args.words or any(w in name for w in args.words):
                compare(name, make(), folder, args.phases)


if __name__ == "__main__":
    main()
