#!/usr/bin/env python3
"""Small scenes with known answers for the contact rows of the second implementation."""

import random
import sys
import tempfile
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import scenes
import second_contact
from scenes import Scene, box, row_of
from second_contact import Pair
from second_run import Run

results = {"passed": 0, "failed": 0}


def check(name, value, bound, least=False):
    """Counts a figure that must be at most (or at least) its bound."""
    good = value >= bound if least else value <= bound
    results["passed" if good else "failed"] += 1
    if not good or "-v" in sys.argv:
        sign = ">=" if least else "<="
        print(f"{'ok  ' if good else 'FAIL'} {name}: {value:.3e} {sign} {bound:.3e}")


def run(scene, **options):
    """Runs a scene; returns the run, its tables, growth of energy and overlap."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "deck.k"
        scene.write(deck)
        made = Run(deck, **options)
        tables = made.run()
    e = tables.energy
    growth = np.max(e[:, 2] - e[:, 3]) / (e[0, 2] or np.max(e[:, 2]))
    return made, tables, growth, np.max(tables.overlap)


def sound(name, scene, overlap, **options):
    """Checks energy, residual and overlap of a scene that must touch."""
    made, tables, growth, depth = run(scene, **options)
    check(f"{name}: energy", growth, 1 + 1e-9)
    check(f"{name}: residual", np.max(np.abs(tables.energy[:, 8])), 1e-11)
    check(f"{name}: overlap", depth, overlap)
    check(f"{name}: touches", np.max(np.abs(tables.impulse)), 1e-8, least=True)
    return made, tables


def first_force(tables):
    return int(np.nonzero(np.any(tables.impulse != 0, axis=(1, 2)))[0][0])


def slab():
    """A block between the nodes of a coarse slab: the slab's nodes do not see it."""
    scene = Scene("slab", steps=200)
    scene.body(2, 2, box(0.2, 1.00205, 0.5, 0.5), (0.0, -1.0))
    base = scene.body(1, 1, box(0, 0, 1, 1))
    scene.hold(row_of(base, 0))
    scene.contact(1, 2)
    _, tables = sound("slab", scene, 1e-6)
    # It closes 1e-4 a step: the gap of 2.05e-3 is used up in step 21.
    check("slab: first step of force", abs(first_force(tables) - 21), 1)


def corner_on_edge(order):
    scene = Scene("corner on edge", dt=5e-5, steps=200)
    half = 0.5 * (sin(0.5) + cos(0.5))
    scene.body(2, 2, box(0.03, half + 0.001 - 0.5, 1, 1, 0.5), (0.0, -2.0))
    base = scene.body(3, 1, box(-1, -1, 3, 1))
    scene.hold(row_of(base, 0))
    scene.contact(*order)
    sound(f"corner on edge {order}", scene, 1e-6)


def inner_corner(n, speed, steps, dt):
    scene = Scene("L", dt=dt, steps=steps)
    scene.body(n, n, box(0.51, 0.512, 0.8, 0.8), speed, poisson=0.0)
    base = scene.body(4, 4, box(0, 0, 2, 2), keep=lambda i, j: i < 1 or j < 1, poisson=0.0)
    scene.hold([k for p, k in base.items() if p[1] == 0 or p[0] == 0])
    scene.contact(1, 2)
    sound(f"L, {n} cells, dt {dt}", scene, 1.5e-3)


def groove():
    scene = Scene("V groove", dt=5e-5, steps=250)
    half = 0.3 * 2**0.5

    def bed(a, b):
        x = 3 * a - 1.5
        return x, abs(x) * b - 1.5 * (1 - b)

    scene.body(3, 3, box(-0.3, half + 0.002 - 0.3, 0.6, 0.6, pi / 4), (0.0, -3.0))
    base = scene.body(6, 3, bed)
    scene.hold(row_of(base, 0))
    scene.contact(1, 2)
    _, tables = sound("V groove", scene, 1.5e-3)
    x, y = np.max(np.abs(tables.impulse[:, 0]), axis=0)
    check("V groove: across the axis", x / y, 1e-9)


def apex(order, flat, mu):
    """The corner of a block falls on the corner of another, or on the middle of an edge."""
    scene = Scene("apex", dt=5e-5, steps=250)
    half = 0.5 * 2**0.5
    scene.body(2, 2, box(-0.5, half + 0.001 - 0.5, 1, 1, pi / 4), (0.0, -3.0))
    if flat:
        scene.body(3, 2, box(-1.5, -1.001, 3, 1))
    else:
        scene.body(2, 2, box(-0.5, -half - 0.001 - 0.5, 1, 1, pi / 4))
    scene.contact(*order, mu)
    made, tables = sound(f"apex {order} {flat} {mu}", scene, 1e-6)
    x, y = np.max(np.abs(tables.impulse[:, 0]), axis=0)
    check(f"apex {order} flat {flat} mu {mu}: force across the axis", x / y, 1e-9)
    upper = slice(0, 9)
    momentum = (made.body.mass @ made.v)[upper].sum(axis=0)
    check(f"apex {order} flat {flat} mu {mu}: momentum across", abs(momentum[0] / momentum[1]), 1e-9)


def bars():
    """Two equal bars meet face to face; the motion is a mirror image."""
    scene = Scene("bars", steps=220)
    left = scene.body(6, 2, box(-3.0005, 0, 3, 1), (2.0, 0.0), poisson=0.3)
    right = scene.body(6, 2, box(0.0005, 0, 3, 1), (-2.0, 0.0), poisson=0.3)
    scene.contact(1, 2, 0.3)
    for frame, bound in (("START", 1e-7), ("REF", 1e-9)):
        made, tables, growth, depth = run(scene, frame=frame)
        check(f"bars {frame}: energy", growth, 1 + 1e-9)
        check(f"bars {frame}: overlap", depth, 1e-3)
        mirror = [right[6 - p[0], p[1]] - 1 for p in left]
        one = tables.u[:, [k - 1 for k in left.values()]]
        two = tables.u[:, mirror] * [-1, 1]
        check(f"bars {frame}: mirror", np.max(np.abs(one - two)) / np.max(np.abs(one)), bound)


def flush():
    """A block slides from one table to the next at the same height, then over a step."""
    for ledge, name in ((0.0, "flush"), (5e-5, "low"), (-1e-2, "down")):
        scene = Scene("tables", dt=2e-3, steps=200)
        scene.body(4, 2, box(-0.8, 0.0, 0.6, 0.4), (1.5, 0.0), young=1000.0)
        one = scene.body(2, 1, box(-1.0, -0.5, 1, 0.5))
        two = scene.body(2, 1, box(0.003, -0.5 + ledge, 1, 0.5))
        scene.hold([*one.values(), *two.values()])
        scene.contact(1, 2)
        scene.contact(1, 3)
        made, tables, growth, depth = run(scene)
        check(f"tables {name}: energy", growth, 1 + 1e-9)
        check(f"tables {name}: overlap", depth, 1.5e-3)
        if name == "flush":
            speed = (made.body.mass @ made.v).sum(axis=0)[0] / made.body.mass[:15].sum()
            check("tables flush: speed", abs(speed - 1.5), 1e-9)


def turned(angle, swap):
    """A hit of two blocks, turned or with the bodies in the other order."""
    scene = Scene("turned", dt=5e-5, steps=160)
    c, s = cos(angle), sin(angle)

    def turn(shape):
        def place(a, b):
            x, y = shape(a, b)
            return c * x - s * y, s * x + c * y

        return place

    v = (1.0, -3.0)
    scene.body(3, 3, turn(box(0.1, 1.001, 0.9, 0.9, 0.05, about=(0, 0))),
               (c * v[0] - s * v[1], s * v[0] + c * v[1]))
    scene.body(4, 2, turn(box(0, 0, 1.5, 1)))
    scene.contact(*((2, 1) if swap else (1, 2)), 0.3)
    u = run(scene)[1].u
    return u @ np.array([[c, -s], [s, c]])


def invariance():
    plain = turned(0.0, False)
    size = np.max(np.abs(plain))
    # Coordinates of the deck have 10 digits; the turned scene is another one by that much.
    check("turned by 1 rad", np.max(np.abs(turned(1.0, False) - plain)) / size, 1e-6)
    check("bodies swapped", np.max(np.abs(turned(0.0, True) - plain)) / size, 1e-9)


def purse():
    """A block on a wavy base: closing of overlaps is paid for by what was lost before."""
    made, tables, growth, depth = run(scenes.make(41))
    first = tables.energy[0, 2]
    check("wavy base: energy", growth, 1 + 1e-9)
    check("wavy base: overlap", depth, 1.5e-3)
    check("wavy base: purse", -min(card.purse for card in made.cards) / first, 1e-11)
    made, tables, growth, depth = run(scenes.make(38))
    check("pressed: the purse was short", tables.counts["purse"], 1, least=True)


def crowds():
    """Bodies that spin and hit: energy, overlap, momentum; without the rules energy is made."""
    depths = []
    for number in (102, 108, 109, 121, 122, 129):
        scene = scenes.crowd(number, random.Random(number))
        scene.steps = 300
        made, tables, growth, depth = run(scene)
        depths.append(depth)
        check(f"crowd {number}: energy", growth, 1 + 1e-9)
        check(f"crowd {number}: overlap", depth, 1e-2)
        start = made.body.mass @ made.body.v0
        change = (made.body.mass @ made.v - start).sum(axis=0)
        check(f"crowd {number}: momentum", np.max(np.abs(change)) / np.abs(start).sum(), 1e-10)
    check("crowds: overlap, median", float(np.median(depths)), 2e-3)
    scene = scenes.crowd(109, random.Random(109))
    scene.steps = 300
    bare = run(scene, frame="REF", purse=False)[2]
    check("crowd, FRAME REF without the purse: energy", bare, 1.5, least=True)


def reach():
    """Rows of nodes beside a corner depend on the reach; with a limit on them nothing does."""
    plain = Pair.reach
    for limit, name in ((np.inf, "as written"), (0.1, "limited")):
        kept, second_contact.BESIDE = second_contact.BESIDE, limit
        one = run(scenes.make(1))[1].u
        Pair.reach = lambda self, motion: 2 * plain(self, motion)
        two = run(scenes.make(1))[1].u
        Pair.reach, second_contact.BESIDE = plain, kept
        change = np.max(np.abs(one - two)) / np.max(np.abs(one))
        # Without the limit the change is 2e-2: it shows that this check bites.
        wanted = (change, 1e-9) if limit < 1 else (-change, -1e-4)
        check(f"reach doubled, rows beside a corner {name}", *wanted)


def main():
    slab()
    for order in ((1, 2), (2, 1)):
        corner_on_edge(order)
        for flat in (False, True):
            for mu in (0.0, 0.3):
                apex(order, flat, mu)
    inner_corner(3, (-3.0, -3.0), 200, 1e-4)
    inner_corner(3, (-3.0, -2.0), 400, 5e-5)
    inner_corner(5, (-2.0, -3.0), 300, 1e-4)
    groove()
    bars()
    flush()
    invariance()
    purse()
    crowds()
    reach()
    print(f"{results['passed']} passed, {results['failed']} failed")
    return 1 if results["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
