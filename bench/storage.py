#!/usr/bin/env python3
"""What field files and restart files cost the two-bar impact (THETA, 4000 steps, 200 elements):
medians of the processor time, interleaved, each over the run without them; and larger bars."""

import os
import shutil
import statistics
import tempfile

import common
import make_bars

FIELD = "*BIPACT_FIELD\n%10.3e                     %9d\n"
CASES = (
    ("nothing", ""),
    ("fields every step", FIELD % (1e-9, 64)),
    ("fields every step, 32 bits", FIELD % (1e-9, 32)),
    ("fields every 100th step", FIELD % (1e-3, 64)),
    ("restart every 1000 steps", "*BIPACT_RESTART\n      1000\n"),
    ("both every 100th step", FIELD % (1e-3, 64) + "*BIPACT_RESTART\n       100\n"),
)


def measure(folder, options, times):
    path = os.path.join(folder, "bars.k")
    make_bars.write(path, **options)
    with open(path) as file:
        text = file.read()
    decks = []
    for name, cards in CASES:
        decks.append(os.path.join(folder, name.replace(" ", "_") + ".k"))
        with open(decks[-1], "w") as file:
            file.write(text.replace("*END", cards + "*END"))
    seconds = [[] for _ in CASES]
    for _ in range(times):
        for k, deck in enumerate(decks):
            out = os.path.join(folder, "out")
            shutil.rmtree(out, ignore_errors=True)
            seconds[k].append(common.run(deck, out)["cpu"])
    medians = [statistics.median(s) for s in seconds]
    for (name, _), value in zip(CASES, medians):
        print(
            "%-28s %9.1f ms %+8.1f %%" % (name, 1e3 * value, 1e2 * (value / medians[0] - 1.0))
        )


def main():
    with tempfile.TemporaryDirectory() as folder:
        print("two bars, 100 x 1 elements each, 4000 steps")
        measure(folder, dict(dt=1e-5, tend=0.04), 11)
        print("two bars, 200 x 20 elements each, 4000 steps")
        measure(folder, dict(nx=200, ny=20, dt=1e-5, tend=0.04), 1)


if __name__ == "__main__":
    main()
