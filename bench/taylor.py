#!/usr/bin/env python3
"""Taylor's copper bar against a rigid wall, mean dilatation: radius of the foot and length of
the bar at 80 us. Published: 7.22 to 7.23 mm, 21.41 to 21.43 mm (doc/verification.md).

taylor.py [N ...]: explicit around the axis with N = 5, 8 and 12 elements over the radius, and
the limit by lines in 1/n through the last two; a quarter of an hour of processor time.
taylor.py --implicit STEPS ...: THETA 1/2, EMC, 5 x 25 elements, against the explicit run of the
same mesh: differences (of the length also the mean over the last 15 us, for at the end the bar
vibrates by .01 mm), what the scheme took of the energy, how well the energy balances.
taylor.py --space N ...: the same of a quarter in space; six minutes with five elements."""

import argparse
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import numpy as np

sys.path.insert(0, os.path.join(common.ROOT, "tests", "support"))
import tables
import taylor_bars

# Per element over the radius: the smallest elements stay stable to the end.
STEPS, STEPS_IN_SPACE = 2705, 3400


def measure(text, axis="y"):
    """Radius of the foot, length along the axis [mm], processor seconds, what the scheme took
    and what is left of the balance, of the first energy, and the steps."""
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "taylor.k"), os.path.join(folder, "out")
        with open(deck, "w") as file:
            file.write(text)
        done = common.run(deck, out)
        if done["code"] != 0:
            raise SystemExit(done["errors"])
        nodes, rows = tables.read_run(out, "nodout"), tables.read_run(out, "glstat")
    last = nodes["time"] == nodes["time"].max()
    start = rows["kinetic"][0]
    found = rows["kinetic"] + rows["internal"] + rows["plastic"] + rows["algorithmic"]
    return {
        "radius": nodes["x"][last][0],
        "length": nodes[axis][last][-1],
        "mean": nodes.select(node=nodes["node"].max())[axis][-15:].mean(),
        "cpu": done["cpu"],
        "taken": rows["algorithmic"][-1] / start,
        "open": np.abs(found - start).max() / start,
        "steps": rows["cycle"][-1],
    }


def refine(sizes, in_space=False):
    """Explicit runs and the limit by lines in 1/n through the last two."""
    print("over radius   steps  radius  length  balance   CPU s")
    found = {}
    for n in sizes:
        if in_space:
            got = measure(taylor_bars.space_bar(n, STEPS_IN_SPACE * n), "z")
        else:
            got = measure(taylor_bars.ring_bar(n, STEPS * n))
        found[n] = got["radius"], got["length"]
        numbers = (n, got["steps"], *found[n], got["open"], got["cpu"])
        print("%11d %7d %7.4f %7.4f %8.1e %7.0f" % numbers, flush=True)
    if len(sizes) < 2:
        return
    a, b = sizes[-2:]
    limit = [(b * y - a * x) / (b - a) for x, y in zip(found[a], found[b])]
    print("limit               %7.4f %7.4f" % tuple(limit))


def halve(counts, n=5):
    """Implicit runs; the later columns of radius and length are less the explicit run's."""
    heads = "asked done radius length radius length mean algorithmic balance CPU".split()
    print("%8s %7s %8s %8s %9s %9s %9s %12s %8s %7s" % tuple(heads))
    best = measure(taylor_bars.ring_bar(n, STEPS * n))
    form = "%8s %7d %8.4f %8.4f %9.5f %9.5f %9.5f %12.1e %8.1e %7.1f"
    for steps in [0] + counts:
        got = measure(taylor_bars.ring_bar(n, steps, implicit=True)) if steps else best
        off = [got[k] - best[k] for k in ("radius", "length", "mean")]
        numbers = [got[k] for k in ("radius", "length")] + off
        numbers += [got[k] for k in ("taken", "open", "cpu")]
        print(form % (steps or "explicit", got["steps"], *numbers), flush=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sizes", nargs="*", type=int, metavar="N", help="elements, explicit")
    parser.add_argument("--implicit", nargs="+", type=int, metavar="STEPS")
    parser.add_argument("--space", nargs="+", type=int, metavar="N")
    options = parser.parse_args()
    if options.implicit:
        halve(options.implicit)
    elif options.space:
        refine(options.space, in_space=True)
    else:
        refine(options.sizes or [5, 8, 12])


if __name__ == "__main__":
    main()
