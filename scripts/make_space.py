#!/usr/bin/env python3
"""Write the decks of input/space that hold meshes of contact and impact.

Each deck's head has a sketch, units, the result to expect and its error, and how to draw it. A test
runs them all; another writes them again and compares."""

import argparse
import itertools
import os
from math import cos, pi, sin, sqrt

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from solid_forms import split


def rotation(axis, angle):
    """Rodrigues' matrix."""
    k = np.array(axis) / np.linalg.norm(axis)
    m = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + sin(angle) * m + (1 - cos(angle)) * m @ m


def real(x, width=10):
    """A number in a field, with as many digits as it holds."""
    x = float(x)
    for digits in range(17, 0, -1):
        text = "%.*g" % (digits, x)
        text = text.replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
        if "." not in text and "e" not in text:
            text += ".0"
        if len(text) < width or (len(text) == width and x < 0):
            return text.rjust(width)
    raise ValueError(x)


def fields(*values):
    """A card of fields of 10 columns; None is blank."""
    return "".join(
        (
            " " * 10
            if v is None
            else (
                "%10d" % v
                if isinstance(v, int)
                else "%10s" % v if isinstance(v, str) else real(v)
            )
        )
        for v in values
    ).rstrip()


def nodes(x, first=1):
    return ["%8d%s" % (first + k, "".join(real(c, 16) for c in p)) for k, p in enumerate(x)]


def solids(elements, part, first_node, first=1):
    return [
        "%8d%8d" % (first + k, part) + "".join("%8d" % (first_node + n) for n in e)
        for k, e in enumerate(elements)
    ]


def grid(counts, place):
    """Hexahedra on a grid of nx x ny x nz cells: place(i, j, k) of a node -> (places, elements)."""
    number = {p: n for n, p in enumerate(itertools.product(*(range(c + 1) for c in counts)))}
    x = np.array([place(*p) for p in number])
    ring = ((0, 0), (1, 0), (1, 1), (0, 1))
    cells = itertools.product(*(range(c) for c in counts))
    return x, [
        [number[i + a, j + b, k + c] for c in (0, 1) for a, b in ring] for i, j, k in cells
    ]


def head(title, end, step, mass="CONSISTENT", theta=0.5, static=False):
    out = ["*KEYWORD", "*TITLE", title, "*CONTROL_TERMINATION", "$#  endtim", fields(end)]
    out += ["*CONTROL_IMPLICIT_GENERAL", "$#  imflag       dt0", fields(1, step)]
    out += ["*CONTROL_IMPLICIT_DYNAMICS", "$#   imass", fields(1)]
    out += ["*BIPACT_TIME", "$#  scheme     theta", fields("THETA", theta)]
    return out + ["*BIPACT_MASS", "$#    type", fields(mass)]


NODE = ["*NODE", "$#   nid               x               y               z"]
SOLID = [
    "*ELEMENT_SOLID",
    "$#   eid     pid      n1      n2      n3      n4      n5      n6      n7      n8",
]


def part(number, name, form, density, young, poisson):
    return [
        "*PART",
        name,
        "$#     pid     secid       mid",
        fields(number, number, number),
        "*SECTION_SOLID",
        "$#   secid    elform",
        fields(number, form),
        "*MAT_ELASTIC",
        "$#     mid        ro         e        pr",
        fields(number, density, young, poisson),
    ]


def node_set(number, ids):
    out = ["*SET_NODE_LIST", "$#     sid", fields(number)]
    ids = list(ids)
    return out + [fields(*ids[k : k + 8]) for k in range(0, len(ids), 8)]


def contact(mu, a=1, b=2):
    return [
        "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE",
        "$#   surfa     surfb  surfatyp  surfbtyp: 3 = parts",
        fields(a, b, 3, 3),
        "$#      fs",
        fields(mu),
    ]


def velocity(ids, v):
    return ["%10d" % i + "".join(real(c) for c in w) for i, w in zip(ids, v)]


def tables(step, *names, every=1):
    out = []
    for name in names:
        out += ["*DATABASE_" + name, fields(every * step)]
    return out


def history(ids):
    ids = list(ids)
    return ["*DATABASE_HISTORY_NODE"] + [fields(*ids[k : k + 8]) for k in range(0, len(ids), 8)]


VELOCITY = ["*INITIAL_VELOCITY_NODE", "$#     nid        vx        vy        vz"]


def two_bars():
    """Bars of 20 x 2 x 2 hexahedra along a skew axis."""
    turn, n, length, gap = rotation((1, 2, 3), 1.1), 20, 10.0, 0.02
    axis = turn @ np.array([1.0, 0.0, 0.0])
    step = length / n / 1000.0
    x, e = grid((n, 2, 2), lambda i, j, k: turn @ [length * i / n, j / 2, k / 2])
    y = x + (length + gap) * axis
    face = [1 + r for r in range(9 * n, 9 * n + 9)]
    text = r"""Two elastic bars meet end to end along an axis that is none of the frame: a wave in space, exact.

     v ->           gap            <- v
   +----------------+ +----------------+     20 x 2 x 2 hexahedra each, 10 x 1 x 1, gap .02, v = +-1
   |                | |                |     axis: x turned by 1.1 rad about (1, 2, 3)
   +----------------+ +----------------+     units: any consistent set
          bar 1              bar 2

E 1000, density 1e-3 (speed of waves c = 1000), PR 0, friction .3, DISPERSION, steps of one element. The faces touch at
t = .01, stay for 2 L/c = .02 with the force rho c v A = 1, and part with the first velocities exchanged. Places and
velocities of ten columns have six digits, so that the axes of the bars differ by 1e-7 and the bars turn a little: the
digits of the deck, not of the scheme, whose error is 1e-14 (tests/decks/space_contact.py).
Drawn by: scripts/plot_fields.py two_bars_turned.out --field PRESSURE
expect: rcforc side=1 iy last %.9f +- 1e-7
expect: glstat total last 0.01 +- 1e-7
expect: matsum part=1 vx last %.8f +- 1e-6""" % (
        -2.0e-2 * axis[1],
        -axis[0],
    )
    out = head("two bars in space", 0.04, step, "DISPERSION")
    out += NODE + nodes(x) + nodes(y, 1001) + SOLID + solids(e, 1, 1) + solids(e, 2, 1001, 1001)
    out += part(1, "left", 1, 1e-3, 1000.0, 0.0) + part(2, "right", 1, 1e-3, 1000.0, 0.0)
    out += VELOCITY + velocity(range(1, 1 + len(x)), [axis] * len(x))
    out += velocity(range(1001, 1001 + len(x)), [-axis] * len(x)) + contact(0.3)
    out += history(face) + tables(step, "GLSTAT", "RCFORC", "NODOUT", "MATSUM")
    return text, out


def spinning_tube():
    """A tube on a regular polygon of 16 corners that spins onto a plane."""
    corners, inner, outer, length, n, scale, mu = 16, 0.9, 1.1, 4.0, 40, 1e-3, 0.3
    step = length / n

    def node(k, ring, a):
        return (k * 2 + ring) * corners + a % corners

    x = np.zeros((2 * corners * (n + 1), 3))
    for k, ring, a in itertools.product(range(n + 1), (0, 1), range(corners)):
        r, angle = (inner, outer)[ring], 2 * pi * a / corners
        x[node(k, ring, a)] = r * cos(angle), r * sin(angle), length * k / n
    e = [
        [
            node(m, ring, b)
            for m in (k, k + 1)
            for b, ring in ((a, 0), (a, 1), (a + 1, 1), (a + 1, 0))
        ]
        for k in range(n)
        for a in range(corners)
    ]
    v = scale * (np.cross([0, 0, 1], x) - [0, 0, 1])
    area = corners / 2 * sin(2 * pi / corners) * (outer**2 - inner**2)
    lever = 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)
    text = r"""A tube that spins onto a rigid plane: Coulomb friction in space, exact for slip.

        |  v = -1e-3, spin 1e-3 about z          a tube on a polygon of 16 corners, radii .9 and 1.1, length 4,
     ___v___                                      one element through the wall, 40 along it
    (_______)   |  |                              E = density = 1, PR 0, friction .3
     |     |    |  | 4                            units: any consistent set
     |_____|    v
   =============== z = 0

The wave along the axis carries the force rho c v A (A = N/2 sin(2 pi/N) (Ro^2 - Ri^2)) for 2 L/c = 8. All of the foot
slips: the torque is mu rho c v A r_F, r_F = 2/3 (Ro^3 - Ri^3)/(Ro^2 - Ri^2), whatever the shear waves do. The tube leaves
with its velocity reversed and its angular momentum less by torque times 8. Exact with DISPERSION and steps of one element;
the bounds are the six digits of the velocities here. Sticking (friction .8) it comes back turning the other way.
expect: rwforc iz last %.9g +- 1e-8
expect: matsum vz last 1e-3 +- 1e-9
expect: glstat residual last 0.0 +- 1e-11""" % (8 * scale * area)
    text += "\nThe angular momentum falls by %.6g (column angz of glstat)." % (
        8 * mu * scale * area * lever
    )
    out = head("a tube that spins on a wall", step * (2 * n + 20), step, "DISPERSION")
    out += NODE + nodes(x) + SOLID + solids(e, 1, 1) + part(1, "tube", 1, 1.0, 1.0, 0.0)
    out += VELOCITY + velocity(range(1, 1 + len(x)), v)
    out += ["*RIGIDWALL_PLANAR", "$#    nsid: 0 = all", fields(0)]
    out += ["$#      xt        yt        zt        xh        yh        zh      fric"]
    out += [fields(0.0, 0.0, 0.0, 0.0, 0.0, 1.0, mu)]
    return text, out + tables(step, "GLSTAT", "MATSUM", "RWFORC")


def graded(n, ratio):
    """n + 1 places from 0 to 1, each cell `ratio` times the one before."""
    size = ratio ** np.arange(n)
    return np.concatenate([[0.0], np.cumsum(size)]) / size.sum()


def ball_on_plate():
    """A quarter of a ball, graded to its pole, on a quarter of a plate."""
    radius, young, poisson, density, speed = 1.0, 1000.0, 0.3, 1e-3, 1.0
    side, height = graded(6, 1.5), graded(10, 1.35)

    def ball(i, j, k):
        a, b, c = side[i], side[j], 2 * height[k] - 1
        q = np.array(
            [
                a * sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3),
                b * sqrt(1 - a * a / 2 - c * c / 2 + a * a * c * c / 3),
                c * sqrt(1 - a * a / 2 - b * b / 2 + a * a * b * b / 3),
            ]
        )
        return radius * (q + [0, 0, 1]) + [0, 0, 1e-3]

    x, e = grid((6, 6, 10), ball)
    wide, deep = graded(8, 1.5), graded(6, 1.7)
    y, f = grid((8, 8, 6), lambda i, j, k: [2 * wide[i], 2 * wide[j], -2 * deep[6 - k]])
    stiff = young / (1 - poisson**2) / 2
    mass = density * 4 / 3 * pi * radius**3
    time = 2.86827 * (mass**2 / (radius * stiff**2 * speed)) ** 0.2
    force = (
        4
        / 3
        * stiff
        * sqrt(radius)
        * (15 * mass * speed**2 / (16 * stiff * sqrt(radius))) ** 0.6
    )
    step = time / 200
    text = r"""An elastic ball falls on an elastic plate: a quarter of both, non-matching meshes, Hertz's impact.

        .---.     | 1           ball of radius 1, 6 x 6 x 10 hexahedra graded to the pole, gap 1e-3
       (     )    v             plate 4 x 4 x 2 around the pole, its far faces held
     ___`---'___                E 1000, PR .3, density 1e-3, no friction
    |___________|               supports on x = 0 and y = 0, the planes of symmetry
                                units: any consistent set

Hertz, with 1/E* = 2 (1 - PR^2)/E: the contact lasts 2.86827 (m^2/(R E*^2 v))^(1/5) = %.5f, its largest force is
4/3 E* R^(1/2) d^(3/2), d = (15 m v^2/(16 E* R^(1/2)))^(2/5): %.4f of the whole ball, a quarter of it here. The ball comes
back with nearly its speed: it is slow against its waves, some of which stay in the plate. The plate is 2 deep, which
makes it stiffer than a half space by .45 a/2 (design of Hertz tests): bounds of 6 %%.
Drawn by: scripts/plot_fields.py ball_on_plate.out --field PRESSURE
expect: rcforc side=1 fn max %.4f at least
expect: rcforc side=1 fz last 0.0 +- 1e-9
expect: matsum part=1 vz last 0.97 +- 0.05
expect: glstat residual last 0.0 +- 1e-11""" % (
        time,
        force,
        0.94 * force / 4,
    )
    out = head("a ball on a plate", 1.5e-3 + 1.2 * time, step)
    out += NODE + nodes(x) + nodes(y, 2001) + SOLID + solids(e, 1, 1) + solids(f, 2, 2001, 2001)
    out += part(1, "ball", 1, density, young, poisson) + part(
        2, "plate", 1, density, young, poisson
    )
    both = [(1 + k, p) for k, p in enumerate(x)] + [(2001 + k, p) for k, p in enumerate(y)]
    out += node_set(1, [i for i, p in both if abs(p[0]) < 1e-9])
    out += node_set(2, [i for i, p in both if abs(p[1]) < 1e-9])
    out += node_set(
        3, [i for i, p in both if i > 2000 and (max(p[0], p[1]) > 2 - 1e-9 or p[2] < -2 + 1e-9)]
    )
    out += ["*BOUNDARY_SPC_SET", "$#    nsid       cid      dofx      dofy      dofz"]
    out += [fields(1, 0, 1, 0, 0), fields(2, 0, 0, 1, 0), fields(3, 0, 1, 1, 1)]
    out += VELOCITY + velocity(range(1, 1 + len(x)), [[0, 0, -speed]] * len(x)) + contact(0.0)
    out += ["*BIPACT_FIELD", fields(20 * step), fields("U", "PRESSURE", "STRESS")]
    return text, out + tables(step, "GLSTAT", "MATSUM", "RCFORC")


def oblique_block():
    """A block that hits a slab obliquely and slips all the time."""
    x, e = grid((4, 4, 3), lambda i, j, k: [0.37 + i / 4, 0.41 + j / 4, 0.05 + 0.6 * k / 3])
    y, f = grid((5, 5, 2), lambda i, j, k: [2 * i / 5, 2 * j / 5, -0.8 + 0.4 * k])
    mu, v = 0.1, np.array([3.0, 4.0, -1.0])
    text = r"""A block hits a slab obliquely and slides away: the friction force lies against the velocity, not along an axis.

            ____
           |    |  v = (3, 4, -1)            block 1 x 1 x .6 of 4 x 4 x 3 hexahedra, gap .05
           |____|                            slab 2 x 2 x .8 of 5 x 5 x 2 hexahedra, its bottom held
      ______________                         E 1000, density 1, PR .3; friction .1
     |              |                        units: any consistent set
     |______________|

It slips fast all the time, in the direction (.6, .8, 0) but for what its own waves add (their velocity is the normal one,
1 against 5, and of changing sign): the impulses of friction are .1 x .6 and .1 x .8 of the normal one. With a limit for
each tangent alone (a box in place of the cone) they would be .1 both.
Drawn by: scripts/plot_fields.py oblique_block.out --field FORCE
expect: glstat residual last 0.0 +- 1e-11
expect: rcforc side=1 iz max 0.6 at least"""
    out = head("an oblique impact", 0.12, 0.001)
    out += NODE + nodes(x) + nodes(y, 1001) + SOLID + solids(e, 1, 1) + solids(f, 2, 1001, 1001)
    out += part(1, "block", 1, 1.0, 1000.0, 0.3) + part(2, "slab", 1, 1.0, 1000.0, 0.3)
    out += node_set(1, [1001 + k for k, p in enumerate(y) if p[2] < -0.79])
    out += ["*BOUNDARY_SPC_SET", fields(1, 0, 1, 1, 1)]
    out += VELOCITY + velocity(range(1, 1 + len(x)), [v] * len(x)) + contact(mu)
    return text, out + tables(0.001, "GLSTAT", "MATSUM", "RCFORC")


def roofs():
    """Two roofs that meet ridge across ridge."""

    def roof(n=5, length=4.0):
        x, e = [], []
        for i in range(n + 1):
            at = -length / 2 + length * i / n
            x += [[at, -1.0, -1.0], [at, 1.0, -1.0], [at, 0.0, 0.0]]
        for i in range(n):
            a, b = 3 * i, 3 * (i + 1)
            e.append([a + 1, a, b, b + 1, a + 2, a + 2, b + 2, b + 2])
        return np.array(x), e

    x, e = roof()
    y = x @ (rotation((0, 0, 1), pi / 2) @ rotation((1, 0, 0), pi)).T + [0.13, -0.21, 0.05]
    text = r"""Two roofs meet ridge across ridge, between their nodes: contact of edges, which nodes alone would miss.

        \    upper, turned    /        bars of 5 wedges, 4 long, sections 2 wide and 1 high
         \__by 90 degrees____/         E 1000, density 1, PR .3, friction .3
              |  v -.5                 gap .05 between the ridges, which cross at none of the nodes
           ___^___                     units: any consistent set
          /   | v .5\   lower
         /___________\

The ridges touch at t = .05, one point each in the middle of an edge, and the bars rebound. Nodes alone would notice when
one of them is inside: the ridges would stand .12 in each other by then.
Drawn by: scripts/plot_fields.py roofs.out --field PART
expect: sleout penetration max 0.0 at least
expect: glstat residual last 0.0 +- 1e-12
expect: matsum part=1 vz last -0.314 +- 0.02"""
    out = head("roofs that cross", 0.4, 0.002)
    out += NODE + nodes(x) + nodes(y, 1001) + SOLID + solids(e, 1, 1) + solids(e, 2, 1001, 1001)
    out += part(1, "lower", 15, 1.0, 1000.0, 0.3) + part(2, "upper", 15, 1.0, 1000.0, 0.3)
    out += VELOCITY + velocity(range(1, 1 + len(x)), [[0, 0, 0.5]] * len(x))
    out += velocity(range(1001, 1001 + len(y)), [[0, 0, -0.5]] * len(y)) + contact(0.3)
    return text, out + tables(0.002, "GLSTAT", "MATSUM", "RCFORC", "SLEOUT")


def sliding_tetrahedra():
    """A block of tetrahedra on a plate of tetrahedra."""
    x, e = grid((3, 3, 1), lambda i, j, k: [0.25 + 0.2 * i, 0.6 + 0.2 * j, 0.1 * k])
    y, f = grid((8, 5, 1), lambda i, j, k: [0.3 * i, 0.36 * j, -0.2 + 0.2 * k])
    e, f = split(e), split(f)
    mu, gravity, speed, end = 0.3, 10.0, 1.0, 0.25
    left = speed - mu * gravity * end
    text = r"""A block of tetrahedra slides on a plate of tetrahedra over many facets, and friction slows it down.

          __
     v 1 |__| ->              block .6 x .6 x .1, 54 tetrahedra; plate 2.4 x 1.8 x .2, 240 tetrahedra, its bottom held
    _______________           E 1e4, density 1, PR .3 (tetrahedra are stiffer than that); friction .3, gravity 10
   |_______________|          units: any consistent set

The velocity falls by mu g t, to %.4g at t = .25, and the block has gone v t - mu g t^2/2 = %.5g. It is dropped with its
weight at once, so that it swings up and down by half of its weight, and friction with it: 1 %% of the velocity.
Drawn by: scripts/plot_fields.py sliding_tetrahedra.out --field FORCE
expect: matsum part=1 vx last %.4g +- 0.01
expect: glstat residual last 0.0 +- 1e-11""" % (
        left,
        speed * end - mu * gravity * end**2 / 2,
        left,
    )
    out = head("a block of tetrahedra", end, 0.0005, theta=0.6)
    out += NODE + nodes(x) + nodes(y, 1001) + SOLID + solids(e, 1, 1) + solids(f, 2, 1001, 1001)
    out += part(1, "block", 10, 1.0, 1e4, 0.3) + part(2, "plate", 10, 1.0, 1e4, 0.3)
    out += node_set(1, [1001 + k for k, p in enumerate(y) if p[2] < -0.19])
    out += ["*BOUNDARY_SPC_SET", fields(1, 0, 1, 1, 1)]
    out += VELOCITY + velocity(range(1, 1 + len(x)), [[speed, 0, 0]] * len(x)) + contact(mu)
    out += ["*DEFINE_CURVE", fields(1), "                 0.0                 1.0"]
    out += ["                10.0                 1.0", "*LOAD_BODY_Z", fields(1, gravity)]
    return text, out + tables(0.0005, "GLSTAT", "MATSUM", "RCFORC", every=5)


DECKS = {
    "two_bars_turned": two_bars,
    "spinning_tube": spinning_tube,
    "ball_on_plate": ball_on_plate,
    "oblique_block": oblique_block,
    "roofs": roofs,
    "sliding_tetrahedra": sliding_tetrahedra,
}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    space = os.path.join(startup.ROOT, "input", "space")
    parser.add_argument("folder", nargs="?", default=space, help="where to (input/space)")
    folder = parser.parse_args().folder
    for name, make in DECKS.items():
        text, out = make()
        lines = ["$ " + line if line else "$" for line in text.split("\n")] + out + ["*END", ""]
        with open(os.path.join(folder, name + ".k"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
