#!/usr/bin/env python3
"""The judge of scripts/collide.py on cases made by hand. Last line 'N passed, N failed'."""

import math
import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import collide_deck
import collide_judge as judge
import collide_mesh as mesh
import collide_scenes as scenes
import tables

counts = [0, 0]


def check(name, holds):
    counts[not holds] += 1
    if not holds:
        print("FAIL " + name)


def near(name, value, wanted, tolerance=1.0e-12):
    """Round-off of numbers near 1."""
    check("%s: %r, wanted %r" % (name, value, wanted), abs(value - wanted) <= tolerance)


def box(x, y, width=1.0, height=1.0):
    return np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])


def still(loop):
    return np.array([loop])


def deepest(one, two):
    return judge.deepest_of(still(one), still(two))[0]


def check_depths():
    corner = box(0.9, 0.95)
    near("corner in corner", deepest(box(0, 0), corner), 0.05)
    near("the same, exchanged", deepest(corner, box(0, 0)), 0.05)
    near("a small box on a large one", deepest(box(0, 0), box(0.4, 0.97, 0.2, 0.2)), 0.15)
    near("apart", deepest(box(0, 0), box(1.001, 0.2)), 0.0)
    near("boxes that meet, bodies apart", deepest(box(0, 0), box(1.1, 0.0) @ SHEAR), 0.0)
    near("face on face", deepest(box(0, 0), box(1.0, 0.25)), 0.0)
    # Corners on edges: the edges of the plus cross 1.9 from their ends.
    plus = box(-2, -0.1, 4, 0.2), box(-0.1, -2, 0.2, 4)
    near("a plus, no node inside", deepest(*plus), 1.9 / 4.0)
    # A hexagram of two triangles: crossings a third from the ends, at 60 degrees.
    angles = math.pi / 2.0 + 2.0 * math.pi / 3.0 * np.arange(3)
    triangle = np.column_stack([np.cos(angles), np.sin(angles)])
    near("a hexagram", deepest(triangle, -triangle), math.sin(math.pi / 3.0) / 3.0)
    notch = np.array([(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)], float)
    near("inside a notch, not in the body", deepest(notch, box(1.1, 1.1, 0.8, 0.8)), 0.0)
    near("in the floor of a notch", deepest(notch, box(1.1, 0.9, 0.8, 0.8)), 0.1 / 0.8)
    moving = np.array([box(1.5 - 0.1 * k, 0.45) for k in range(10)])
    depth, row = judge.deepest_of(np.array(10 * [box(0, 0)]), moving)
    near("the deepest row", depth, 0.4)
    check("its number", row == 9)


SHEAR = np.array([[1.0, 0.0], [0.5, 1.0]])


def check_inside():
    """Crossing numbers against sums of angles."""
    rng = np.random.default_rng(5)
    wrong = 0
    for _ in range(50):
        angles = np.sort(rng.uniform(0.0, 2.0 * math.pi, 9))
        loop = rng.uniform(0.3, 1.0, 9)[:, None] * np.column_stack(
            [np.cos(angles), np.sin(angles)]
        )
        points = rng.uniform(-1.0, 1.0, (40, 2))
        a = loop[None] - points[:, None]
        b = np.roll(a, -1, axis=1)
        turns = np.arctan2(judge.cross(a, b), (a * b).sum(-1)).sum(axis=1)
        found = judge.inside(still(points), still(loop))[0]
        wrong += np.count_nonzero(found != (np.abs(turns) > math.pi))
    check("points inside polygons: %d differ" % wrong, wrong == 0)
    # Heights of a corner and a point are equal, start + (end - start) of its edges is another one.
    loops = rng.uniform(1.0, 2.0, (200, 4, 2)) * [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    loops[:, 1, 1] *= 10.0 ** rng.uniform(-8.0, 0.0, 200)
    points = loops[:, 1:2] - [10.0, 0.0]
    wrong = np.count_nonzero(judge.inside(points, loops))
    check("points at the height of a corner: %d inside" % wrong, wrong == 0)


def check_through():
    plate = box(0, 0, 4, 0.2)
    needle = np.array([(2.0, 0.5), (2.1, 1.5), (1.9, 1.5)])

    def moved(*ways):
        return np.array([needle + way for way in ways]), np.array(len(ways) * [plate])

    check("through in one step", judge.through(*moved((0, 0), (0, -1), (0, -2))) != [])
    check("through in small steps", judge.through(*moved(*[(0, -0.1 * k) for k in range(9)])))
    back = [(0, 0), (0, -0.4), (0, -0.45), (0, -0.1), (0, 0)]
    check("in and out again", judge.through(*moved(*back)) == [])
    past = [(1.999, 0.0), (2.02, -0.6), (2.02, -1.0)]
    check("past a corner", judge.through(*moved(*past)) == [])
    check("far away", judge.through(*moved((0, 3), (0, -3.0 + 5.0))) == [])


def check_motion():
    wall = (np.array([0.0, 0.0]), np.array([0.0, 1.0]), 0.0)
    near("behind a wall", judge.below_wall(still(box(0, -0.02)), wall)[0], 0.02)
    one = np.array([box(0, 0), box(0.03, 0.0)])
    two = np.array([box(3, 0), box(3, 0.04)])
    near("relative motion in a step", judge.relative_step(one, two), 0.05)
    found = judge.overlap([one, two], [[0, 1, 2, 3]] * 2)
    near("the same in edges", found["step"], 0.05)


def make_table(**columns):
    columns = {name: np.asarray(column, float) for name, column in columns.items()}
    for name in ("part", "side"):
        if name in columns:
            columns[name] = columns[name].astype(int)
    return tables.Table("", list(columns), columns, [], "done", 1)


def check_balances():
    zero = np.zeros(3)
    names = ("external", "motion", "unsolved", "internal", "friction", "contact", "algorithmic")
    terms = {name: zero for name in names}
    grown = np.array([1.0, 0.8, 1.1])
    glstat = make_table(kinetic=grown, total=grown, initial=zero + 1.0, **terms)
    near("energy that grows", judge.energy(glstat), 0.1 / 1.1)
    glstat = make_table(kinetic=grown, total=grown, initial=zero + 1.1, **terms)
    near("energy that does not", judge.energy(glstat), 0.0)
    momx = [1, -2, 1.5, -2.5, 1.5, -2.4]
    matsum = make_table(part=[1, 2] * 3, momx=momx, momy=[0.0] * 6)
    none = np.zeros((3, 2))
    near("momentum", judge.momentum(matsum, none), 0.1 / 2.5)
    given = none + [[0, 0], [0, 0], [0.1, 0]]
    near("momentum with an impulse", judge.momentum(matsum, given), 0.0)
    forces = dict(fy=[0] * 4, ix=[0] * 4, iy=[0] * 4, side=[1, 2, 1, 2])
    turned = np.array([box(0, 0), mesh.turned(box(0, 0), 0.7) + 3.0])
    near("a rigid motion keeps the shape", judge.shape(turned), 0.0)
    turned[1, 2] += mesh.turned(np.array([0.1, 0.1]), 0.7)
    near("a corner pulled along the diagonal", judge.shape(turned), 0.1 * 2**0.5 / turned.max())
    near("forces", judge.balance(make_table(fx=[0, 0, 2, -1.5], **forces)), 0.25)
    near("opposite forces", judge.balance(make_table(fx=[1, -1, 2, -2], **forces)), 0.0)


def check_rigid():
    """A body that turns about a point: its centre of mass is not the mean of its nodes."""
    wedge = np.array([(0.0, 0.0), (3.0, 0.0), (1.5, 0.0), (0.0, 3.0)])[[0, 2, 1, 3]]
    near("centroid", np.abs(mesh.centroid(wedge) - 1.0).max(), 0.0)
    velocity = 2.0 * np.column_stack([-wedge[:, 1], wedge[:, 0]]) + [0.5, 0.25]
    v, omega = scenes.velocities_of({"xy": wedge, "loop": [0, 1, 2, 3], "velocity": velocity})
    near("rate of rotation", omega, 2.0)
    near("velocity of the centre", np.hypot(*(v - [0.5 - 2.0, 0.25 + 2.0])), 0.0)
    for number in range(40):
        plain, scene = scenes.draw(3, number), scenes.draw(3, number, rigid=True)
        check("rigid parts in scene %d" % number, any(b["rigid"] for b in scene["bodies"]))
        for one, two in zip(plain["bodies"], scene["bodies"]):
            check("the same bodies in scene %d" % number, np.array_equal(one["xy"], two["xy"]))


def check_scenes():
    for number in range(40):
        scene = scenes.draw(3, number)
        again = scenes.draw(3, number)
        check("scene %d again" % number, collide_deck.deck(scene) == collide_deck.deck(again))
        mirrored = scenes.transformed(scene, scenes.MIRROR)
        for one in (scene, mirrored, scenes.renumbered(scene, np.random.default_rng(1))):
            least = min(
                mesh.corner_areas(b["xy"], e).min()
                for b in one["bodies"]
                for e in b["elements"]
            )
            check("areas of scene %d" % number, least > 0.0)
        loops = [scenes.loop_of(b) for b in scene["bodies"]]
        gaps = [mesh.distance(a, b) for k, a in enumerate(loops) for b in loops[:k]]
        check("gaps of scene %d" % number, min(gaps) > 0.0)
        depths = [deepest(a, b) for k, a in enumerate(loops) for b in loops[:k]]
        check("overlap of scene %d at the start" % number, max(depths) == 0.0)


check_depths()
check_inside()
check_through()
check_motion()
check_balances()
check_rigid()
check_scenes()
print("%d passed, %d failed" % tuple(counts))
sys.exit(1 if counts[1] else 0)
