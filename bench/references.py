#!/usr/bin/env python3
"""References of scenes without a closed solution, kept as numbers with a bound of their own error.

    references.py [SCENE]... [--n N]

For each scene the finest run (PAOLI, mass DISPERSION, Courant 1/2, n elements) at 61 times goes to
bench/references/SCENE.json, and with it what the same scheme with half the elements and THETA with
as many differ from it: the larger of the two in each measure is the bound. Below it a difference
from the reference is no finding. The scenes and n of the kept files are the defaults."""

import argparse
import json
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import numpy as np
import report_scenes

FINEST = {"block": 128, "disc": 64}


def history(scene, method, n, times=None):
    """(times, history, data of the scene, processor seconds) of a run."""
    run = dict(scene=scene, method=method, mass="DISPERSION", redist=0, n=n, courant=0.5)
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "run.k"), os.path.join(folder, "out")
        meta = report_scenes.write_scene(deck, run)
        done = common.run(deck, out)
        if done["code"] != 0:
            raise SystemExit("%s %s %d failed: %s" % (scene, method, n, done["errors"]))
        if times is None:
            times = np.linspace(0.0, meta["tend"], 61)
        return times, report_scenes.history_of(out, meta, times), meta, done["cpu"]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", nargs="*", default=sorted(FINEST))
    parser.add_argument("--n", type=int, help="elements of the finest mesh")
    a = parser.parse_args()
    os.makedirs(report_scenes.REFERENCES, exist_ok=True)
    for scene in a.scene:
        n = a.n or FINEST[scene]
        times, kept, meta, seconds = history(scene, "PAOLI", n)
        bound = {}
        for method, size in (("PAOLI", n // 2), ("THETA", n)):
            other, took = history(scene, method, size, times)[1::2]
            off = report_scenes.distance(other, kept, meta["v"])
            print("%s, %s D %d: %s, %.1f s" % (scene, method, size, off, took))
            bound = {k: max(v, bound.get(k, 0.0)) for k, v in off.items()}
        made = "PAOLI D, n %d, Courant 0.5; %s, %.0f s" % (n, common.today(), seconds)
        rounded = {k: [float("%.10g" % x) for x in v] for k, v in kept.items()}
        found = dict(scene=scene, made=made, bound={k: float("%.3g" % v) for k, v in bound.items()})
        found.update(time=[float("%.10g" % t) for t in times], history=rounded)
        with open(os.path.join(report_scenes.REFERENCES, scene + ".json"), "w") as file:
            json.dump(found, file, indent=0)
            file.write("\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
