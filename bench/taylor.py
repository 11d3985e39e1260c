#!/usr/bin/env python3
"""Taylor's copper bar against a rigid wall, axisymmetric, explicit, mean dilatation: radius of the
foot and length of the bar at 80 us with 5, 8 and 12 elements over the radius, and their limits
by lines in 1/n through the last two. Quarter of an hour of processor time; `taylor.py 3 5` runs
other meshes. Published: 7.22 to 7.23 mm, 21.41 to 21.43 mm (doc/verification.md)."""

import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common

sys.path.insert(0, os.path.join(common.ROOT, "tests", "support"))
import rings
import tables

STEPS = 2705    # per element over the radius: the smallest elements stay stable to the end


def measure(n, folder):
    """Radius of the foot, length along the axis [mm], processor seconds."""
    deck = os.path.join(folder, "taylor.k")
    with open(deck, "w") as out:
        out.write(rings.taylor_bar(n, STEPS * n)[1])
    done = common.run(deck, os.path.join(folder, "out"))
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    rows = tables.read_run(os.path.join(folder, "out"), "nodout")
    last = rows["time"] == rows["time"].max()
    return rows["x"][last][0], rows["y"][last][1], done["cpu"]


def main():
    sizes = [int(a) for a in sys.argv[1:]] or [5, 8, 12]
    print("elements  radius  length   CPU s")
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for n in sizes:
            radius, length, cpu = measure(n, folder)
            found[n] = radius, length
            print("%2d x %-3d  %7.4f  %7.4f  %6.0f" % (n, 5 * n, radius, length, cpu), flush=True)
    if len(sizes) < 2:
        return
    a, b = sizes[-2:]
    limit = [(b * y - a * x) / (b - a) for x, y in zip(found[a], found[b])]
    print("limit     %7.4f  %7.4f" % tuple(limit))


if __name__ == "__main__":
    main()
