#!/usr/bin/env python3
"""Runs decks of input/catalogue and draws what they find over the closed forms of analytic.py:
doc/figures/catalogue.png."""

import argparse
import math
import os
import subprocess
import sys
import tempfile

import startup  # before what is no part of Python
import numpy as np

import analytic
from contact_errors import face_of, flat_face
import tables

DECKS = os.path.join(startup.ROOT, "input", "catalogue")
FOUND, EXACT = dict(marker="o", ms=3, lw=0, color="C0"), dict(color="k", lw=1.0)


def solve(folder, name):
    """Runs a deck; returns the folder of its tables."""
    out = os.path.join(folder, name)
    deck = os.path.join(DECKS, name + ".k")
    subprocess.run([startup.program(), deck, "-o", out, "--quiet"], check=True)
    return out


def face(out, side):
    """Place, pressure and shear of the nodes at y = 0 of a side."""
    mesh = os.path.join(DECKS, os.path.basename(out) + "_mesh.k")
    x, length, fx, fy, _ = face_of(flat_face(mesh), out, side)
    return x, np.abs(fy) / length, np.abs(fx) / length


def hertz(axes, out):
    load = tables.read_run(out, "rcforc").select(side=2)
    exact = analytic.Hertz(1.0, 500.0 / 0.91, abs(load["fy"][-1]))
    x, p, q = face(out, 2)
    near = np.abs(x) < 0.045
    at = np.linspace(-0.045, 0.045, 901)
    axes.plot(at, exact.pressure(at), **EXACT)
    axes.plot(at, exact.shear(at, 0.3, abs(load["fx"][-1])), **EXACT)
    axes.plot(x[near], p[near], **FOUND)
    axes.plot(x[near], q[near], **dict(FOUND, color="C1"))
    axes.set(title="Hertz; Cattaneo, Mindlin", xlabel="x [L]", ylabel="pressure, shear [F L-2]")


def cylinder(axes, out):
    exact = analytic.Hertz(50.0, 52500.0 / 0.91, 35.0e3)
    x, p, _ = face(out, 2)
    at = np.linspace(0.0, 8.0, 801)
    axes.plot(at, exact.pressure(at), **EXACT)
    axes.plot(x[x < 8.0], p[x < 8.0], **FOUND)
    axes.set(title="NAFEMS contact benchmark 1", xlabel="x [mm]", ylabel="pressure [MPa]")


def westergaard(axes, out):
    exact = analytic.Westergaard(2.0, math.pi * 500.0 / 0.91 * 1.0e-3 / 2.0, 0.36403)
    mesh = flat_face(os.path.join(DECKS, "westergaard_mesh.k"))
    x, _, _, _, p = face_of(mesh, out, 2)
    at = np.linspace(0.0, 1.0, 801)
    inside = at < exact.half_width
    axes.plot(at, np.where(inside, exact.pressure(at), 0.0), **EXACT)
    axes.plot(x, p, **FOUND)
    axes.set(title="Westergaard's wave", xlabel="x [L]", ylabel="pressure [F L-2]")


def punch(axes, out):
    x, p, _ = face(out, 1)
    load = 2.0 * abs(tables.read_run(out, "rcforc").select(side=1)["fy"][-1])
    at = np.linspace(0.0, 0.99, 801)
    axes.plot(at, load / (math.pi * np.sqrt(1.0 - at**2)), **EXACT)
    axes.plot(x, p, **FOUND)
    axes.set(title="flat punch", xlabel="x [L]", ylabel="pressure [F L-2]")


def mass_on_rod(axes, out):
    rows = tables.read_run(out, "rcforc").select(side=2)
    t = rows["time"][2:] - 1.0e-4
    axes.plot(t, analytic.mass_on_rod(1.0, 0.01, 1.0, t), **EXACT)
    axes.plot(t[::8], rows["fmx"][2::8], **FOUND)
    axes.set(title="rigid mass on a rod", xlabel="t [T]", ylabel="force [F]")


def rigid_bowl(axes, out):
    rows = tables.read_run(out, "rbdout")
    swing = math.asin(0.28)
    quarter = 0.25 * analytic.GlidingBlock(1.0, 0.6, 0.5).period(False, swing)
    axes.plot(rows["time"], swing + rows["rz"], color="C0", lw=1.0)
    times = quarter * np.arange(11)
    axes.plot(times, swing * np.cos(0.5 * np.pi * np.arange(11)), "k+", ms=9)
    axes.set(title="rigid block in a bowl", xlabel="t [T]", ylabel="angle [rad]")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    figure = os.path.join(startup.ROOT, "doc", "figures", "catalogue.png")
    parser.add_argument("-o", metavar="FILE", default=figure, help="picture (%(default)s)")
    a = parser.parse_args()
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    drawn, panels = plt.subplots(2, 3, figsize=(12, 6.4))
    with tempfile.TemporaryDirectory() as folder:
        for axes, draw in zip(
            panels.flat, (hertz, cylinder, westergaard, punch, mass_on_rod, rigid_bowl)
        ):
            draw(axes, solve(folder, draw.__name__))
    drawn.tight_layout()
    drawn.savefig(a.o, dpi=90)
    return 0


if __name__ == "__main__":
    sys.exit(main())
