#!/usr/bin/env python3
"""Reference scenes, deterministic by number: scenes.py [NUMBER [FILE]] writes a deck.

Without arguments it lists them. Lengths are of the order 1, waves run at about 1000."""

import random
import sys
from math import cos, pi, sin

import numpy as np


class Scene:
    """Nodes, elements and cards that become a deck."""

    def __init__(self, title, dt=1e-4, steps=200, theta=0.5, xi=None):
        self.title, self.dt, self.steps, self.theta, self.xi = title, dt, steps, theta, xi
        self.nodes, self.elements, self.parts, self.cards = [], [], [], []
        self.sets = 0

    def body(self, nx, ny, shape, velocity=(0, 0), form=13, triangles=False, keep=None, **material):
        """Adds a part from a grid of nx * ny cells; shape maps (0..1, 0..1) to the plane.

        keep(i, j) tells which cells there are. Returns the part; nodes by grid place."""
        pid, numbers, places = len(self.parts) + 1, {}, {}
        for j in range(ny):
            for i in range(nx):
                if keep and not keep(i, j):
                    continue
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                for p in ring:
                    if p not in places:
                        places[p] = shape(p[0] / nx, p[1] / ny)
        for p in sorted(places, key=lambda p: (p[1], p[0])):
            self.nodes.append(places[p])
            numbers[p] = len(self.nodes)
        for j in range(ny):
            for i in range(nx):
                if keep and not keep(i, j):
                    continue
                ring = [numbers[p] for p in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                if not triangles:
                    self.elements.append((pid, ring))
                elif (i + j) % 2:
                    self.elements += [(pid, ring[:3]), (pid, [ring[0], ring[2], ring[3]])]
                else:
                    self.elements += [(pid, [ring[0], ring[1], ring[3]]), (pid, ring[1:])]
        self.parts.append((form, material.get("density", 1e-3), material.get("young", 1000.0),
                           material.get("poisson", 0.3), material.get("thickness", 1.0)))
        everything = self.node_set(numbers.values())
        if velocity != (0, 0):
            self.cards.append("*INITIAL_VELOCITY\n" + card(everything) + card(*velocity))
        self.cards.append("*SET_PART_LIST\n" + card(pid) + card(pid))
        return numbers

    def node_set(self, nodes):
        self.sets += 1
        nodes = sorted(nodes)
        lines = "".join(card(*nodes[k : k + 8]) for k in range(0, len(nodes), 8))
        self.cards.append("*SET_NODE_LIST\n" + card(self.sets) + lines)
        return self.sets

    def hold(self, nodes, x=1, y=1):
        self.cards.append("*BOUNDARY_SPC_SET\n" + card(self.node_set(nodes), "", x, y))

    def contact(self, a, b, mu=0.0, kind="SURFACE_TO_SURFACE"):
        self.cards.append(
            f"*CONTACT_2D_AUTOMATIC_{kind}\n" + card(a, "" if b is None else b, "", "", mu)
        )

    def curve(self, number, points):
        lines = "".join(f"{a:20.10e}{o:20.10e}\n" for a, o in points)
        self.cards.append("*DEFINE_CURVE\n" + card(number) + lines)

    def gravity(self, strength, direction="Y"):
        self.curve(90, [(0.0, 1.0), (1.0, 1.0)])
        self.cards.append(f"*LOAD_BODY_{direction}\n" + card(90, strength))

    def wall(self, point, ahead, mu=0.0):
        self.cards.append("*RIGIDWALL_PLANAR\n" + card("") + card(*point, "", *ahead, "", mu))

    def write(self, path):
        """Writes the deck with tables of every step."""
        end = self.dt * self.steps
        text = ["*KEYWORD\n*TITLE\n" + self.title + "\n", "*CONTROL_TERMINATION\n" + card(end)]
        text.append("*CONTROL_IMPLICIT_GENERAL\n" + card(1, self.dt))
        text.append("*CONTROL_IMPLICIT_DYNAMICS\n" + card(1))
        xi = "" if self.xi is None else self.xi
        text.append("*BIPACT_TIME\n" + card("THETA", self.theta, xi))
        if not any(c.startswith("*BIPACT_CONTACT") for c in self.cards):
            text.append("*BIPACT_CONTACT\n" + card("", 1e-12))
        text.append("*NODE\n")
        text += [f"{i:8d}{x:16.9e}{y:16.9e}\n" for i, (x, y) in enumerate(self.nodes, 1)]
        text.append("*ELEMENT_SHELL\n")
        for e, (pid, ring) in enumerate(self.elements, 1):
            text.append("".join(f"{k:8d}" for k in (e, pid, *ring)) + "\n")
        for pid, (form, density, young, poisson, thickness) in enumerate(self.parts, 1):
            text.append(f"*PART\npart {pid}\n" + card(pid, pid, pid))
            text.append("*SECTION_SHELL\n" + card(pid, form, "", 4) + card(thickness))
            text.append("*MAT_ELASTIC\n" + card(pid, density, young, poisson))
        text += self.cards
        history = "".join(
            card(*range(k, min(k + 8, len(self.nodes) + 1)))
            for k in range(1, len(self.nodes) + 1, 8)
        )
        text.append("*DATABASE_HISTORY_NODE\n" + history)
        tables = ["GLSTAT", "NODOUT"]
        joined = "".join(self.cards)
        tables += ["RCFORC"] * ("*CONTACT" in joined) + ["RWFORC"] * ("*RIGIDWALL" in joined)
        for table in tables:
            text.append(f"*DATABASE_{table}\n" + card(self.dt))
        text.append("*END\n")
        with open(path, "w", encoding="utf-8") as deck:
            deck.write("".join(text))


def card(*values):
    """Returns a line of fields of 10 columns."""
    line = ""
    for value in values:
        text = str(value)
        if isinstance(value, float):
            text = next(t for t in (f"{value:.{n}g}" for n in range(8, 0, -1)) if len(t) < 10)
        if len(text) > 10:
            raise ValueError(f"{text} is wider than a field")
        line += text.rjust(10)
    return line.rstrip() + "\n"


def box(x, y, width, height, angle=0.0, shear=0.0, about=(0.5, 0.5)):
    """Returns the map of a unit square to a box turned by an angle about a place in it."""
    c, s = cos(angle), sin(angle)

    def place(a, b):
        p = (a - about[0]) * width + shear * (b - about[1]) * height, (b - about[1]) * height
        return (x + about[0] * width + c * p[0] - s * p[1],
                y + about[1] * height + s * p[0] + c * p[1])

    return place


def row_of(numbers, j):
    return [k for p, k in numbers.items() if p[1] == j]


def column_of(numbers, i):
    return [k for p, k in numbers.items() if p[0] == i]


def block_on_block(number, rnd, quads=None):
    """Non-matching faces meet squarely or obliquely; quads or triangles; any friction."""
    counts = [(3, 2), (5, 3), (4, 4), (2, 5), (3, 4), (6, 4), (2, 3), (4, 5)][number % 8]
    mu = [0.0, 0.3, 0.6, 1.0][number % 4]
    scene = Scene(f"blocks {counts}, mu {mu}", steps=160 + 20 * (number % 4))
    triangles = number % 3 == 1 and quads is None
    width = 0.8 + 0.4 * rnd.random()
    off = rnd.uniform(-0.2, 0.2)
    scene.body(counts[0], 3, box(off, 1.002, width, 0.9), (rnd.uniform(-2, 2), -3.0),
               triangles=triangles, poisson=[0.0, 0.3][number % 2])
    base = scene.body(counts[1], 2, box(-0.1, 0, 1.4, 1), triangles=number % 5 == 2)
    scene.hold(row_of(base, 0))
    scene.contact(*((1, 2) if number % 2 else (2, 1)), mu)
    return scene


def free_blocks(number, rnd):
    """Two free blocks meet obliquely."""
    mu = [0.0, 0.2, 0.5][number % 3]
    scene = Scene(f"free blocks, mu {mu}", steps=200)
    v = rnd.uniform(1, 4)
    scene.body(3, 3, box(-1.003, rnd.uniform(-0.3, 0.3), 1, 1), (v, rnd.uniform(-1, 1)))
    scene.body(2 + number % 3, 4, box(0, 0, 0.9, 1.1), (-1.0, 0.5),
               young=[1000.0, 400.0][number % 2], triangles=bool(number % 2))
    scene.contact(1, 2, mu)
    return scene


def corner_on_edge(number, rnd):
    """A turned block hits a slab with its corner."""
    mu = [0.0, 0.3, 1.0, 0.1][number % 4]
    angle = [45, 30, 20, 60, 10, 40][number % 6] * pi / 180
    scene = Scene(f"corner on edge, {angle * 180 / pi:.0f} degrees, mu {mu}", dt=5e-5, steps=300)
    half = 0.5 * (sin(angle) + cos(angle))
    scene.body(4, 4, box(rnd.uniform(-0.3, 0.3), half + 0.002 - 0.5, 1, 1, angle),
               (rnd.uniform(-1, 1), -4.0))
    base = scene.body(3 + number % 3, 2, box(-1, -0.8, 3, 0.8), triangles=number % 2 == 1)
    scene.hold(row_of(base, 0))
    scene.contact(1, 2, mu)
    return scene


def corner_on_corner(number, rnd):
    """Two blocks meet with their corners, in line or off it."""
    scene = Scene("corner on corner", dt=5e-5, steps=250)
    off = [0.0, 0.05, -0.08][number % 3]
    turn = pi / 4 + 0.2 * (number % 2)
    half = 0.5 * 2**0.5
    scene.body(3, 3, box(off - 0.5, half + 0.001 - abs(off) - 0.5, 1, 1, pi / 4), (0.0, [-3.0, -14.0, -3.0][number % 3]))
    scene.body(3, 3, box(-0.5, -half * cos(turn - pi / 4) - 0.001 - 0.5, 1, 1, turn),
               young=[1000.0, 500.0][number // 2])
    scene.contact(1, 2, [0.3, 0.0, 0.6][number % 3])
    return scene


def into_l(number, rnd):
    """A block flies into an L or its corner meets the end of a ledge."""
    mu = [0.0, 0.3][number % 2]
    n = 3 + number % 3
    scene = Scene(f"block into an L, mu {mu}", dt=5e-5, steps=300)
    scene.body(n, 3, box(0.505, 0.506 + 0.1 * (number % 2), 0.8, 0.8), (-3.0, -3.0 + number % 3))
    base = scene.body(4, 4, box(0, 0, 2, 2), keep=lambda i, j: i < 1 or j < 1,
                      poisson=0.2)
    scene.hold([k for p, k in base.items() if p[1] == 0 or p[0] == 0])
    scene.contact(*((1, 2) if number % 2 else (2, 1)), mu)
    return scene


def walls(number, rnd):
    """A block falls on one or two rigid walls, one of them inclined."""
    mu = [0.0, 0.3, 1.0, 0.5][number % 4]
    scene = Scene(f"walls, mu {mu}", steps=200)
    scene.body(3, 4, box(0.0, 0.003, 1, 1.2, 0.1 * (number % 3)), (1.0, -2.0),
               triangles=number % 2 == 1)
    scene.wall((0.0, -0.051 * (number % 3)), (0.0, 1.0), mu)
    if number % 2:
        scene.wall((1.1, 0.0), (0.1, 0.2 * (number % 3)), 0.2)
    scene.gravity(500.0)
    return scene


def stack(number, rnd):
    """Three bodies on each other, the lowest on a wall or held; gravity."""
    mu = [0.0, 0.4, 0.8][number % 3]
    scene = Scene(f"stack of three, mu {mu}", steps=150, theta=0.6)
    counts = [(4, 3, 5), (2, 3, 4), (3, 3, 3), (5, 2, 3)][number % 4]
    base = scene.body(counts[0], 2, box(0, 0, 1.2, 0.8), triangles=number % 2 == 1)
    scene.body(counts[1], 2, box(0.1, 0.8, 1, 0.6))
    scene.body(counts[2], 2, box(0.05 * number, 1.402, 0.9, 0.5), (rnd.uniform(-1, 1), -2.0))
    if number % 3 == 2:
        scene.wall((0.0, -0.001), (0.0, 1.0), 0.3)
    else:
        scene.hold(row_of(base, 0))
    scene.contact(2, 1, mu)
    scene.contact(2, 3, mu / 2)
    scene.gravity(1000.0)
    return scene


def pressed(number, rnd):
    """A block is pressed down by a load that grows, with weight and a side load."""
    mu = [0.0, 0.5, 1.0, 0.3][number % 4]
    scene = Scene(f"pressed block, mu {mu}", dt=2e-4, steps=150, theta=[0.5, 0.7, 1.0][number % 3],
                  xi=[None, 0.6][number % 2])
    top = scene.body([3, 5, 4][number % 3], 3, box(0, 1.0, 1, 1), form=12 + number % 2)
    base = scene.body([4, 3, 6][number % 3], 2, box(-0.2, 0, 1.5, 1), form=12 + number % 2)
    scene.hold(row_of(base, 0))
    scene.contact(2, 1, mu)
    scene.curve(7, [(0.0, 0.0), (0.01, 1.0), (1.0, 1.0)])
    loaded = scene.node_set(row_of(top, 3))
    scene.cards.append("*LOAD_NODE_SET\n" + card(loaded, 2, 7, -3.0) + card(loaded, 1, 7, 0.4))
    scene.cards.append("*LOAD_NODE_POINT\n" + card(row_of(top, 3)[0], 1, 7, 0.2))
    return scene


def slide(number, rnd):
    """A block slides over a base, flat or wavy, coarse or fine."""
    mu = [0.0, 0.2, 0.0, 0.5][number % 4]
    wave = [0.0, 0.02][number // 2 % 2]
    scene = Scene(f"slide over a base, wave {wave}, mu {mu}", dt=1e-4, steps=300)
    flat = box(0, -0.5, 2.4, 0.5)

    def wavy(a, b):
        x, y = flat(a, b)
        return x, y + wave * b * sin(6 * pi * a)

    scene.body([3, 5, 2, 4][number % 4], 2, box(0.3, wave + 0.002, 0.6, 0.4), (12.0, -1.0))
    base = scene.body(10, 2, wavy, young=[1000.0, 300.0][number % 2])
    scene.hold(row_of(base, 0))
    scene.contact(1, 2, mu)
    scene.gravity(2000.0)
    return scene


def groove(number, rnd):
    """A turned block flies into a V groove, its corner first or a flank first."""
    scene = Scene("V groove", dt=5e-5, steps=250)
    slope, half = 1.2, 0.3 * 2**0.5

    def bed(a, b):
        x = 3 * a - 1.5
        return x, (slope * abs(x)) * b - 1.5 * (1 - b)

    off = [0.0, 0.06, -0.1][number % 3]
    turn = pi / 4 + [0.0, 0.1, 0.0][number % 3]
    # The half diagonal stands in the groove of unequal slope: a corner at each side touches.
    height = half * max(1.0, slope) + slope * abs(off) + 0.003
    scene.body(3, 3, box(off - 0.3, height - 0.3, 0.6, 0.6, turn), (0.0, -4.0))
    base = scene.body(6, 3, bed, poisson=0.2)
    scene.hold(row_of(base, 0))
    scene.contact(1, 2, [0.0, 0.2, 0.5][number % 3])
    return scene


def crowd(number, rnd):
    """Soft bodies of several shapes that spin freely and meet at large steps."""
    scene = Scene("crowd", dt=4e-4, steps=200)
    mu = [0.0, 0.3, 0.6][number % 3]
    middle = [(-0.66, 0.0), (0.66, 0.1), (0.0, 1.15)]
    for k, (x, y) in enumerate(middle):
        angle = rnd.uniform(0, 2 * pi)
        keep = (lambda i, j: i < 1 or j < 1) if k == number % 3 else None
        made = scene.body(2 + k, 3 - k // 2, box(x - 0.4, y - 0.4, 0.8, 0.8, angle),
                          young=40.0 + 40 * k, poisson=0.2, keep=keep,
                          triangles=k == 1)
        spin = rnd.uniform(-15, 15)
        vx, vy = -20 * x + rnd.uniform(-3, 3), 20 * (0.4 - y) + rnd.uniform(-3, 3)
        lines = ""
        for node in sorted(made.values()):
            px, py = scene.nodes[node - 1]
            lines += card(node, vx - spin * (py - y), vy + spin * (px - x))
        scene.cards.append("*INITIAL_VELOCITY_NODE\n" + lines)
    scene.contact(1, 2, mu)
    scene.contact(2, 3, mu)
    scene.contact(3, 1, mu)
    return scene


def special(number, rnd):
    """Masses, sides, node sets and other cards on two blocks."""
    scene = block_on_block(number, rnd, quads=number == 1 or None)
    scene.cards.pop()
    mu = 0.3
    if number == 0:
        scene.cards.append("*BIPACT_MASS\n" + card("LUMPED"))
    elif number == 1:
        scene.cards.append("*BIPACT_MASS\n" + card("DISPERSION", 0, 0.5))
    if number in (2, 3):
        scene.contact(1, 2, mu)
        scene.cards.append("*BIPACT_PAIR\n" + card(1, "A" if number == 2 else "B"))
    elif number == 4:
        scene.contact(1, 2, mu, "NODE_TO_SURFACE")
    elif number == 5:
        scene.contact(-1, 2, mu, "NODE_TO_SURFACE")
    else:
        scene.contact(1, 2, mu)
    return scene


def together(number, rnd):
    """Three or more bodies, all of them in one card."""
    scene = Scene("all bodies in one card", steps=200)
    scene.body(3, 2, box(0, 0, 1, 0.7), (0.0, 1.0))
    scene.body(2, 3, box(0.3, 0.704, 0.8, 0.9), (0.5, -2.0), triangles=True)
    scene.body(2, 2, box(1.103, 0.1, 0.5, 1.0), (-2.0, 0.0))
    scene.contact(0, None, [0.0, 0.3][number % 2], "SINGLE_SURFACE")
    return scene


def options(number, rnd):
    """Two blocks with cards that only the new rule takes, or with node sets as sides."""
    scene = block_on_block([1, 4, 6, 2][number], rnd)
    scene.cards.pop()
    if number == 3:
        # Sets 1 and 2 hold all nodes of the two bodies.
        scene.contact(-1, -2, 0.3)
        return scene
    scene.contact(2, 1, 0.3)
    if number < 2:
        scene.cards.append("*BIPACT_PAIR\n" + card(1, "BOTH"))
    else:
        scene.cards.append("*BIPACT_CONTACT\n" + card("", 1e-12) + card("", "REF"))
    return scene


def folding(number, rnd):
    """The legs of a U are driven onto each other: contact of a body with itself."""
    scene = Scene("U that closes", dt=1e-4, steps=200)
    cells = 7 + 2 * number
    gap = range(cells // 2, cells // 2 + 1)
    made = scene.body(cells, 5, box(0, 0, 0.2 * cells, 1.6), young=200.0, poisson=0.2,
                      keep=lambda i, j: j < 1 or i not in gap)
    lines = ""
    for p, node in sorted(made.items()):
        if p[1] > 2:
            lines += card(node, (12.0 if p[0] <= cells // 2 else -15.0) * (p[1] - 2), 0.0)
    scene.cards.append("*INITIAL_VELOCITY_NODE\n" + lines)
    scene.hold(row_of(made, 0))
    scene.contact(0, None, [0.0, 0.4][number], "SINGLE_SURFACE")
    return scene


def tables(number, rnd):
    """A block slides from one table to another: flush, over a low step, down, off the edge."""
    ledge = [0.0, 5e-5, -0.01, -2.0][number]
    scene = Scene(f"tables, ledge {ledge}", dt=1e-3, steps=250)
    scene.body(4, 2, box(-0.7, 0.0, 0.6, 0.4), (1.5, 0.0), triangles=number == 1)
    one = scene.body(2, 1, box(-1.0, -0.5, 1, 0.5))
    two = scene.body(2, 1, box(0.003, -0.5 + ledge, 1, 0.5))
    # A node over the crack between flush tables has two rows; rigid tables leave open how much
    # each of them carries.
    held = (row_of(one, 0), row_of(two, 0)) if number == 0 else (one.values(), two.values())
    scene.hold([*held[0], *held[1]])
    mu = [0.0, 0.0, 0.1, 0.2][number]
    scene.contact(1, 2, mu)
    scene.contact(1, 3, mu)
    scene.gravity(3.0)
    return scene


def wedge(number, rnd):
    """A wedge is driven between two free blocks, its tip blunt or sharp."""
    scene = Scene("wedge", dt=1e-4, steps=200)
    tip = [0.1, 0.02, 0.2][number]

    def shape(a, b):
        return (a - 0.5) * (tip + 0.6 * b), 0.605 + b

    scene.body(2, 4, shape, (0.0, -3.0), density=5e-3)
    for k, x in enumerate((-1.002 - tip / 2 - 0.02 * number, tip / 2 + 0.002)):
        scene.body(3, 3 + k, box(x, 0, 1, 0.6 - 0.05 * k), (0.0, 1.0), triangles=k == number)
    mu = [0.0, 0.3, 0.1][number]
    scene.contact(1, 2, mu)
    scene.contact(3, 1, mu)
    return scene


FAMILIES = (
    (block_on_block, 8), (free_blocks, 5), (corner_on_edge, 6), (corner_on_corner, 3), (into_l, 4),
    (walls, 4), (stack, 4), (pressed, 4), (slide, 4), (groove, 3), (special, 6), (together, 2),
    (crowd, 8), (options, 4), (folding, 2), (tables, 4), (wedge, 3),
)
COUNT = sum(count for _, count in FAMILIES)


def make(number):
    """Returns scene number 1..COUNT."""
    place = number - 1
    for family, count in FAMILIES:
        if place < count:
            return family(place, random.Random(1000 * number))
        place -= count
    raise IndexError(number)


def main():
    if len(sys.argv) > 1:
        number = int(sys.argv[1])
        make(number).write(sys.argv[2] if len(sys.argv) > 2 else f"scene{number:02d}.k")
        return
    for number in range(1, COUNT + 1):
        scene = make(number)
        span = np.ptp(np.array(scene.nodes), axis=0)
        print(f"{number:3d} {len(scene.nodes):4d} nodes {scene.steps:4d} steps "
              f"{span[0]:5.2f} x {span[1]:5.2f}  {scene.title}")


if __name__ == "__main__":
    main()
