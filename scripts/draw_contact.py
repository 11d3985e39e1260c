#!/usr/bin/env python3
"""Pressure and shear of the pairings NODE and MORTAR against closed forms: runs the scenes hertz and
westergaard of contact_scenes.py on meshes 2:3 and on matching ones, prints error and CPU time, and
draws doc/figures/mortar.png."""

import argparse
import json
import os
import subprocess
import sys
import tempfile

import startup  # before what is no part of Python
import numpy as np

import make_scenes
from contact_errors import face_of, hertz_errors, hertz_of, wave_errors


def solve(folder, scene, **options):
    """Runs a scene; returns (its data, CPU seconds)."""
    deck = os.path.join(folder, "scene.k")
    meta = make_scenes.write(deck, scene, **options)
    done = subprocess.run([startup.program(), deck, "-o", folder, "--quiet"], check=False)
    with open(os.path.join(folder, "summary.json"), encoding="ascii") as file:
        summary = json.load(file)
    return meta if done.returncode == 0 else None, summary


PAIRINGS = (
    ("NODE, matching", "NODE", 1.0, "C2"),
    ("MORTAR, matching", "MORTAR", 1.0, "C0"),
    ("NODE, 2:3", "NODE", 1.5, "C3"),
    ("MORTAR, 2:3", "MORTAR", 1.5, "C1"),
)


def measure(folder):
    """{scene: [(pairing, size, error, other error, CPU seconds)]}, and the faces of case H."""
    found, faces = {"hertz": [], "westergaard": []}, []
    for name, pairing, ratio, colour in PAIRINGS:
        for h in (0.01, 0.005, 0.0025):
            side = "B" if pairing == "MORTAR" else "AUTO"
            meta, summary = solve(folder, "hertz", h=h, ratio=ratio, pairing=pairing, side=side)
            if not meta:
                continue
            off = hertz_errors(meta, folder)
            found["hertz"].append((name, h, off["p_y"], off["q_x"], summary["cpu"]))
            if h == 0.005 and name != "MORTAR, matching":
                x, length, fx, fy, _ = face_of(meta["x"], folder, 2)
                faces.append((name, colour, x, -fy / length, fx / length, hertz_of(meta, folder)))
        for n in (8, 16, 32):
            edges = {"upper": int(ratio * n), "lower": n}
            meta, summary = solve(folder, "westergaard", pairing=pairing, **edges)
            if meta:
                found["westergaard"].append((name, n, *wave_errors(meta, folder, 2), summary["cpu"]))
    return found, faces


def draw(path, found, faces):
    """Three panels: tractions of case H, and error over CPU time of both scenes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13, 4.2))
    for name, colour, x, p, q, (exact, force) in faces:
        near = np.abs(x) < 0.045
        left.plot(x[near], np.abs(p[near]), "o-", color=colour, ms=3, lw=0.8, label=name)
        left.plot(x[near], np.abs(q[near]), "s:", color=colour, ms=3, lw=0.8)
    at = np.linspace(-0.045, 0.045, 901)
    left.plot(at, exact.pressure(at), "k", lw=1.0, label="Hertz; Cattaneo, Mindlin")
    left.plot(at, exact.shear(at, 0.3, force), "k", lw=1.0)
    left.set(xlabel="x [L]", ylabel="pressure, shear (dotted) [F L-2]")
    left.legend(fontsize=7)
    for axes, scene, label in (
        (middle, "hertz", "L2 error of the pressure, case H"),
        (right, "westergaard", "inner error of the pressure, Westergaard"),
    ):
        for name, _, _, colour in PAIRINGS:
            rows = [r for r in found[scene] if r[0] == name]
            axes.loglog([r[4] for r in rows], [r[2] for r in rows], "o-", color=colour, label=name)
        axes.set(xlabel="CPU [s]", ylabel=label)
        axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    figures = os.path.join(startup.ROOT, "doc", "figures", "mortar.png")
    parser.add_argument("-o", metavar="FILE", default=figures, help="picture (%(default)s)")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found, faces = measure(folder)
    for scene, head in (
        ("hertz", "edge | p, L2 | q, L2"),
        ("westergaard", "edges of the coarser | p, inner | p, L2"),
    ):
        print("| %s | %s | CPU s |\n|---|---|---|---|---|" % (scene, head))
        for name, size, one, two, cpu in found[scene]:
            print("| %s | %g | %.2e | %.2e | %.2f |" % (name, size, one, two, cpu))
    draw(a.o, found, faces)
    return 0


if __name__ == "__main__":
    sys.exit(main())
