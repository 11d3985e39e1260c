#!/usr/bin/env python3
"""Which exact solution a run has, read from the deck as the run understood it (deck.echo.k).

    scene, why = scene_of("run")    # data as make_bars.py describes a scene; None, and why not

Two free bars, or one and a rigid plane, have that of analytic.Impact when nothing but their
impact acts on them and their waves stay one-dimensional: rectangles of the same height, in one
line, uniform velocities along it, linear elastic with Poisson ratio 0, one contact from the
beginning. Only what is known to leave that solution alone may be in the deck.

On the command line: what was found of a run.
"""

import argparse
import math
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from cards import NODE, SHELL, TEN

ECHO = "deck.echo.k"
HARMLESS = (
    "KEYWORD TITLE COMMENT END NODE ELEMENT_SHELL PART SECTION_SHELL MAT_ELASTIC DEFINE_CURVE "
    "INITIAL_VELOCITY INITIAL_VELOCITY_NODE INITIAL_VELOCITY_GENERATION RIGIDWALL_PLANAR "
    "CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE"
).split()
HARMLESS_KINDS = ("BIPACT_", "CONTROL_", "DATABASE_", "PARAMETER", "SET_")
LONG = (20,) * 8  # columns of a long card
FREE = ("", "0", "3")  # TC of a node of a plane model: z alone
NEAR = 1.0e-9  # two lengths of a deck are the same: its digits, and round-off of turned scenes


class NoExactSolution(Exception):
    """The text says why."""


class Deck:
    """Cards by keyword of an echo deck: blanks and parameters are resolved in it."""

    def __init__(self, path):
        self.blocks = []  # (keyword without options, has a title, is long, cards)
        with open(path, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if line.startswith("*"):
                    self.blocks.append(self.keyword(line[1:].strip().upper()) + ([],))
                elif not line.startswith("$") and self.blocks:
                    self.blocks[-1][3].append(line.rstrip("\n"))

    @staticmethod
    def keyword(name):
        long = name.endswith(("+", " LONG=Y"))
        name = name.split()[0].rstrip("+")
        for option in ("_TITLE", "_ID"):
            if name.endswith(option):
                return name[: -len(option)], True, long
        return name, name == "PART", long

    def cards(self, keyword, per_entry=1, widths=TEN):
        """Entries of a keyword: lists of `per_entry` cards, each a list of field texts."""
        for name, titled, long, lines in self.blocks:
            if name != keyword:
                continue
            step = per_entry + titled if keyword == "PART" else per_entry
            lines = lines if keyword == "PART" else lines[titled:]
            for k in range(0, len(lines) - step + 1, step):
                entry = lines[k + step - per_entry : k + step]
                yield [split(line, LONG if long else widths) for line in entry]

    def lists(self, keyword):
        """{id: numbers} of sets: a card with the id, then cards of numbers."""
        found = {}
        for name, titled, long, lines in self.blocks:
            if name == keyword:
                fields = [split(x, LONG if long else TEN) for x in lines[titled:]]
                members = [int(f) for card in fields[1:] for f in card if f]
                found[int(fields[0][0])] = [n for n in members if n]
        return found


def split(line, widths):
    """Fields of a card, in columns or in comma form, without blanks."""
    if "," in line:
        return [field.strip() for field in line.split(",")] + [""] * 8
    ends = np.cumsum(widths)
    return [line[b - w : b].strip() for b, w in zip(ends, widths)]


def value(text, default=0.0):
    return float(text) if text else default


# ---------------------------------------------------------------- bodies


class Body:
    """A part: its nodes, velocity, and what an elastic bar of it has."""

    def __init__(self, part, nodes, cells, velocities):
        self.part, self.ids = part, sorted({n for cell in cells for n in cell})
        self.points = np.array([nodes[n] for n in self.ids])
        self.area = sum(polygon_area(np.array([nodes[n] for n in cell])) for cell in cells)
        speeds = np.array([velocities.get(n, (0.0, 0.0)) for n in self.ids])
        self.velocity = speeds[0]
        if not np.array_equal(speeds, np.broadcast_to(speeds[0], speeds.shape)):
            raise NoExactSolution("part %d does not move at one velocity" % part)

    def along(self, axis):
        """Its ends along an axis, and across it; it must be a rectangle that lies along it."""
        a, b = self.points @ axis, self.points @ np.array([-axis[1], axis[0]])
        ends, sides = (a.min(), a.max()), (b.min(), b.max())
        box = (ends[1] - ends[0]) * (sides[1] - sides[0])
        if abs(box - self.area) > 1.0e-6 * box:
            raise NoExactSolution("part %d is no rectangle along the motion" % self.part)
        return ends, sides

    def face(self, axis):
        """Nodes of the end that looks along an axis."""
        a = self.points @ axis
        return [n for n, s in zip(self.ids, a) if s > a.max() - 1.0e-6 * (a.max() - a.min())]


def polygon_area(corners):
    x, y = corners.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def read_bodies(deck):
    """[Body] of the parts that have elements, and [(E, density, thickness)] of them."""
    nodes = {}
    for (f,) in deck.cards("NODE", 1, NODE):
        nodes[int(f[0])] = value(f[1]), value(f[2])
        if f[4] not in FREE:
            raise NoExactSolution("node %s is held" % f[0])
    cells = {}
    for (f,) in deck.cards("ELEMENT_SHELL", 1, SHELL):
        corners = list(dict.fromkeys(int(n) for n in f[2:6] if n and int(n)))
        cells.setdefault(int(f[1]), []).append(corners)
    parts = {int(f[0]): (int(f[1]), int(f[2])) for (f,) in deck.cards("PART")}
    sections = {int(f[0]): value(g[0], 1.0) or 1.0 for f, g in deck.cards("SECTION_SHELL", 2)}
    laws = {int(f[0]): [value(x) for x in f[1:4]] for (f,) in deck.cards("MAT_ELASTIC")}
    velocities = read_velocities(deck, nodes, cells)
    bodies = []
    for part, corners in cells.items():
        section, material = parts[part]
        density, young, poisson = laws[material]
        if poisson != 0.0:
            raise NoExactSolution("the Poisson ratio is %g: waves in two dimensions" % poisson)
        body = Body(part, nodes, corners, velocities)
        body.density, body.young, body.thickness = density, young, sections[section]
        bodies.append(body)
    return bodies


def read_velocities(deck, nodes, cells):
    """{node: (vx, vy)} of the initial velocities."""
    found, node_sets, part_sets = {}, deck.lists("SET_NODE_LIST"), deck.lists("SET_PART_LIST")

    def of_parts(parts):
        return [n for p in parts for cell in cells.get(p, ()) for n in cell]

    for f, g in deck.cards("INITIAL_VELOCITY", 2):
        members = node_sets[int(f[0])] if value(f[0]) else nodes
        found.update(dict.fromkeys(members, (value(g[0]), value(g[1]))))
    for (f,) in deck.cards("INITIAL_VELOCITY_NODE"):
        found[int(f[0])] = value(f[1]), value(f[2])
    for f, _ in deck.cards("INITIAL_VELOCITY_GENERATION", 2):
        number, kind = int(value(f[0])), int(value(f[1], 1.0))
        if value(f[2]):
            raise NoExactSolution("a body turns")
        members = nodes
        if number:
            members = (
                node_sets[number]
                if kind == 3
                else of_parts([number] if kind == 2 else part_sets[number])
            )
        found.update(dict.fromkeys(members, (value(f[3]), value(f[4]))))
    return found


# ---------------------------------------------------------------- the scene


def bar(body, ends, sides, axis):
    """One bar as in the json of make_bars.py."""
    speed = math.sqrt(body.young / body.density)
    area = (sides[1] - sides[0]) * body.thickness
    return {
        "length": ends[1] - ends[0],
        "speed": speed,
        "density": body.density,
        "area": area,
        "impedance": body.density * speed * area,
        "velocity": float(body.velocity @ axis),
    }


def along_motion(bodies, motion):
    """Unit vector of a relative motion; the velocities have nothing across it."""
    size = np.hypot(*motion)
    if size == 0.0:
        raise NoExactSolution("nothing moves towards another body")
    axis = motion / size
    across = max(abs(axis[0] * b.velocity[1] - axis[1] * b.velocity[0]) for b in bodies)
    if across > NEAR * size:
        raise NoExactSolution("the bodies move across the line of their impact")
    return axis


def two_bars(deck, bodies):
    """Scene of two bodies that meet."""
    contacts = [
        cards[titled:] for name, titled, _, cards in deck.blocks if "CONTACT_2D" in name
    ]
    if len(contacts) != 1:
        raise NoExactSolution("%d contacts between two bodies" % len(contacts))
    first, second = (split(line, TEN) for line in (contacts[0] + [""])[:2])
    check_life(*second[:2])
    axis = along_motion(bodies, bodies[0].velocity - bodies[1].velocity)
    if (bodies[0].points @ axis).min() > (bodies[1].points @ axis).min():
        bodies, axis = bodies[::-1], -axis
        axis = along_motion(bodies, bodies[0].velocity - bodies[1].velocity)
    (ends1, sides1), (ends2, sides2) = (b.along(axis) for b in bodies)
    gap, height = ends2[0] - ends1[1], sides1[1] - sides1[0]
    if max(abs(a - b) for a, b in zip(sides1, sides2)) > NEAR * height:
        raise NoExactSolution("the faces of the bodies do not cover each other")
    bars = [bar(bodies[0], ends1, sides1, axis), bar(bodies[1], ends2, sides2, axis)]
    if gap < -NEAR * bars[0]["length"] or bars[0]["velocity"] <= bars[1]["velocity"]:
        raise NoExactSolution("the bodies do not meet")
    alike = all(math.isclose(bars[0][k], bars[1][k]) for k in ("length", "speed", "impedance"))
    head_on = bars[0]["velocity"] == -bars[1]["velocity"]
    return {
        "case": "two_bars" if alike and head_on else "unequal",
        "bars": bars,
        "gap": max(gap, 0.0),
        "v0": 0.5 * (bars[0]["velocity"] - bars[1]["velocity"]),
        "axis": axis.tolist(),
        "face1": bodies[0].face(axis),
        "sides": [1, 2] if is_in_surface(bodies[0], deck, int(first[0])) else [2, 1],
    }


def is_in_surface(body, deck, number):
    """Is a body in surface A of a contact: a part set, or, where negative, a node set?"""
    if number < 0:
        return bool(set(deck.lists("SET_NODE_LIST")[-number]) & set(body.ids))
    return body.part in deck.lists("SET_PART_LIST")[number]


def bar_on_wall(deck, body):
    """Scene of one body that meets a rigid plane."""
    walls = list(deck.cards("RIGIDWALL_PLANAR", 2))
    if len(walls) != 1:
        raise NoExactSolution("%d rigid planes before one body" % len(walls))
    first, second = walls[0]
    check_life(first[4], first[5])
    foot, head = (np.array([value(second[k]), value(second[k + 1])]) for k in (0, 3))
    axis = along_motion([body], body.velocity)
    normal = (head - foot) / np.hypot(*(head - foot))
    if abs(normal @ axis + 1.0) > NEAR:
        raise NoExactSolution("the body does not move straight at the wall")
    ends, sides = body.along(axis)
    one = bar(body, ends, sides, axis)
    gap = float(foot @ axis) - ends[1]
    if gap < -NEAR * one["length"]:
        raise NoExactSolution("the body does not meet the wall")
    return {
        "case": "wall",
        "bars": [one, dict(one, velocity=-one["velocity"])],
        "gap": max(gap, 0.0),
        "v0": one["velocity"],
        "axis": axis.tolist(),
        "face1": body.face(axis),
        "sides": [1, 2],
    }


def check_life(birth, death):
    """A contact must be there from the beginning to the end."""
    if value(birth) > 0.0 or value(death, 1.0e20) < 1.0e19:
        raise NoExactSolution("the contact is not there all the time")


def find_scene(folder):
    """The scene of a run; NoExactSolution where it has none."""
    path = os.path.join(folder, ECHO)
    if not os.path.exists(path):
        raise NoExactSolution("there is no %s" % ECHO)
    deck = Deck(path)
    for name, _, _, _ in deck.blocks:
        if name not in HARMLESS and not name.startswith(HARMLESS_KINDS):
            raise NoExactSolution("the deck has *%s" % name)
    try:
        bodies = read_bodies(deck)
        if len(bodies) not in (1, 2):
            raise NoExactSolution("there are %d bodies" % len(bodies))
        scene = two_bars(deck, bodies) if len(bodies) == 2 else bar_on_wall(deck, bodies[0])
    except (KeyError, ValueError, IndexError) as problem:
        raise NoExactSolution("the deck is not read here: %r" % problem) from None
    scene["L"], scene["c"] = scene["bars"][0]["length"], scene["bars"][0]["speed"]
    return scene


def scene_of(folder):
    """(scene, "") of a run directory, or (None, why it has no exact solution)."""
    try:
        return find_scene(folder), ""
    except NoExactSolution as problem:
        return None, str(problem)


def main(argv=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run", metavar="RUN_DIR")
    scene, why = scene_of(parser.parse_args(argv).run)
    if scene is None:
        print("no exact solution is known: %s" % why)
        return 1
    print("%s: gap %g, axis %g %g" % (scene["case"], scene["gap"], *scene["axis"]))
    for one in scene["bars"]:
        print("  " + ", ".join("%s %.10g" % pair for pair in one.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
