#!/usr/bin/env python3
"""Write decks of scenes with exact solutions: make_scenes.py SCENE [name=value]... [-o FILE]
--mesh: what a deck of input/catalogue includes, the nodes, elements and sets of one.

    wall           a bar flies at a rigid wall (the half of the two-bar impact)
    bouncing       a bar falls on a rigid wall under gravity, again and again
    sliding        a block slides to rest on a rigid plane
    incline        a block on a plane; gravity turns it by an angle near that of friction
    pushed         a block on a plane, pushed by a force that grows
    chain          a bar hits a row of equal bars: the last one flies off
    oblique        the middle of a wide block that meets a held body obliquely
    block          a block thrown obliquely at a rigid plane: its foot slips and sticks
    disc           a disc thrown obliquely at a rigid plane: contact that grows, as of Hertz
    drift          a body at gap 0 (or 1e-15) over a plane, at rest or gliding along it
    mass_on_rod    a rigid wall with a mass, or a rigid part, strikes a rod that is held at its
                   other end
    bowl           a stiff block that swings on its two lower corners in a smooth bowl
    rigid_bowl     the same block as a rigid part, released from a swing
    belt           a block set down on a belt that runs
    patch, hertz, cylinder, westergaard, punch, rod    static contact: see contact_scenes.py

Every scene takes n (elements along), dt or courant, scheme and the fields of its cards (theta, xi,
rest, rhoinf, rule, pbeta, gamma, beta, alpha), mass, redist, output, angle (turns it, degrees),
mirror=1 (y to -y), triangles=1, and its own names (see the functions).
write(path, scene, ...) returns the data that a comparison needs.
"""

import argparse
import inspect
import math

import startup  # noqa: F401  before what is no part of Python

from cards import SCHEME, scheme_cards
import contact_scenes
from placed import turned


def grid(o, x0, y0, width, height, nx, ny, part, node, element):
    """Nodes, elements of a rectangle: ([(id, x, y)], [(id, part, nodes...)])."""
    nodes = [
        (node + i * (ny + 1) + j, x0 + width * i / nx, y0 + height * j / ny)
        for i in range(nx + 1)
        for j in range(ny + 1)
    ]
    elements = []
    for i in range(nx):
        for j in range(ny):
            a = node + i * (ny + 1) + j
            b, c, d = a + ny + 1, a + ny + 2, a + 1
            for corner in [(a, b, c), (a, c, d)] if o["triangles"] else [(a, b, c, d)]:
                elements.append(
                    (element + len(elements), part) + (corner[::-1] if o["mirror"] else corner)
                )
    return nodes, elements


def deck(o, title, nodes, elements, parts, control, extra):
    """The whole text; parts: [(density, E, nu)], one part a body, or (density,) of a rigid one."""
    c = control
    out = [
        "*KEYWORD",
        "*TITLE",
        title,
        "*CONTROL_TERMINATION",
        "%r," % c["tend"],
        "*CONTROL_IMPLICIT_GENERAL",
        "1,%r" % c["dt"],
    ]
    out += scheme_cards(c["scheme"], **c["setting"])
    out += ["*BIPACT_MASS", "%s,%d" % (c["mass"], c["redist"])]
    out += ["*BIPACT_CONTACT", ",%r" % o["tol"]] if o["tol"] else []
    out += ["*NODE"] + ["%d,%r,%r" % ((i,) + turned(o, x, y)) for i, x, y in nodes]
    out += ["*ELEMENT_SHELL"] + [",".join(map(str, e)) for e in elements]
    for k, material in enumerate(parts, 1):
        out += [
            "*PART",
            "body %d" % k,
            "%d,%d,%d" % (k, k, k),
            "*SECTION_SHELL",
            "%d,13,,4" % k,
            "%r," % c["thickness"],
        ]
        if len(material) == 1:
            out += ["*MAT_RIGID", "%d,%r" % ((k,) + material), "0.0,0,0", ","]
        else:
            out += ["*MAT_ELASTIC", "%d,%r,%r,%r" % ((k,) + material)]
        out += ["*SET_PART_LIST", "%d," % (10 + k), "%d," % k]
    out += extra
    for table in c["tables"]:
        name, _, interval = table.partition("=")
        out += ["*DATABASE_" + name, "%s," % (interval or repr(c["output"]))]
    return "\n".join(out + ["*END", ""])


def controls(tend, dt, o, tables):
    """Time, scheme, mass from the common options."""
    return {
        "tend": tend,
        "dt": dt,
        "scheme": o["scheme"].upper(),
        "setting": {k: o[k] for k in SETTING if o[k] is not None},
        "mass": o["mass"].upper(),
        "redist": o["redist"],
        "thickness": 1.0,
        "output": o["output"] or dt,
        "tables": tables,
    }


SETTING = ("gamma", "beta", "alpha") + tuple(SCHEME[1:])
COMMON = {
    **dict.fromkeys(SETTING),
    "scheme": "THETA",
    "mass": "CONSISTENT",
    "redist": 0,
    "output": None,
    "dt": None,
    "courant": 0.5,
    "angle": 0.0,
    "mirror": 0,
    "triangles": 0,
    "tol": None,
}


def step(o, h, c):
    """The step: as given, or Courant number x h/c."""
    return o["dt"] if o["dt"] else o["courant"] * h / c


def curve(number, *points):
    """Cards of a curve."""
    return ["*DEFINE_CURVE", "%d," % number] + ["%r,%r" % p for p in points]


def plane(o, x, y, nx, ny, mu):
    """A wall through a point with a normal, in front of all nodes."""
    at, ahead = turned(o, x, y), turned(o, x + nx, y + ny)
    return ["*RIGIDWALL_PLANAR", "0,", "%r,%r,,%r,%r,,%r" % (at + ahead + (mu,))]


def geometric(o, shape, x, y, mu, size, motion=None, ahead=(0.0, 1.0)):
    """A wall of *RIGIDWALL_GEOMETRIC_...; size: radius of a cylinder, (x, y, length) of a point of
    a flat one and its length from x, y, or None; motion: (curve, OPT, direction)."""
    name = "*RIGIDWALL_GEOMETRIC_" + shape + ("_MOTION" if motion else "")
    at, mark = turned(o, x, y), turned(o, x + ahead[0], y + ahead[1])
    if "CYLINDER" in shape:
        out = [name, "0,", "%r,%r,,%r,%r,1.0,%r" % (at + at + (mu,)), "%r," % size]
    else:
        out = [name, "0,", "%r,%r,,%r,%r,,%r" % (at + mark + (mu,))]
        out += ["%r,%r,,%r" % (turned(o, *size[:2]) + (size[2],)) if size else "0.0,"]
    if motion:
        out += ["%d,%d,%r,%r" % (motion[:2] + turned(o, *motion[2]))]
    return out


def moving(o, vx, vy):
    """Initial velocity of all nodes."""
    return ["*INITIAL_VELOCITY", "0,", "%r,%r" % turned(o, vx, vy)]


def gravity(o, number, gx, gy):
    """Acceleration (gx, gy) x curve of everything."""
    return [
        x
        for name, g in zip("XY", turned(o, gx, gy))
        if g
        for x in ("*LOAD_BODY_" + name, "%d,%r" % (number, -g))
    ]


def history(ids):
    """Cards of a history of nodes."""
    ids = list(ids)
    return ["*DATABASE_HISTORY_NODE"] + [
        ",".join(map(str, ids[k : k + 8])) + "," for k in range(0, len(ids), 8)
    ]


def node_set(number, ids):
    """Cards of a node set."""
    ids = list(ids)
    return ["*SET_NODE_LIST", "%d," % number] + [
        ",".join(map(str, ids[k : k + 8])) + "," for k in range(0, len(ids), 8)
    ]


def wall(o, n=100, ny=1, gap=0.01, v=1.0, poisson=0.0, mu=0.0, touch=None, tend=0.04):
    """Length 10, c 1000, rho c 1; exact: the two-bar impact with twice the gap."""
    c, length = 1000.0, 10.0
    dt = step(o, length / n, c)
    if touch is not None:
        gap = (max(0, round(gap / (v * dt) - touch)) + touch) * dt * v
    nodes, elements = grid(o, -length, 0.0, length, 1.0, n, ny, 1, 1, 1)
    face = [i for i, x, _ in nodes if x == 0.0]
    text = deck(
        o,
        "bar on a rigid wall",
        nodes,
        elements,
        [(1.0e-3, 1000.0, poisson)],
        controls(tend, dt, o, ["GLSTAT", "MATSUM", "NODOUT", "RWFORC=%r" % dt, "SLEOUT"]),
        plane(o, gap, 0.0, -1.0, 0.0, mu) + moving(o, v, 0.0) + history(face),
    )
    bar = {"length": length, "speed": c, "impedance": 1.0, "velocity": v}
    return text, {
        "case": "wall",
        "bars": [bar, dict(bar, velocity=-v)],
        "gap": gap,
        "v0": v,
        "L": length,
        "c": c,
        "axis": list(turned(o, 1.0, 0.0)),
        "sides": [1, 2],
        "face1": face,
        "dt": dt,
        "tend": tend,
    }


def bouncing(o, n=100, periods=1.0):
    """The bar of analytic.BouncingBar, lying along x; gravity acts toward the wall x = 0."""
    from analytic import BouncingBar  # needs numpy, which the other scenes do not

    exact = BouncingBar()
    dt = step(o, exact.length / n, exact.speed)
    tend = max(1, round(periods * exact.period / dt)) * dt
    nodes, elements = grid(o, exact.height, 0.0, exact.length, 1.0, n, 1, 1, 1, 1)
    face = [i for i, x, _ in nodes if x == exact.height]
    text = deck(
        o,
        "bouncing bar",
        nodes,
        elements,
        [(exact.density, exact.young, 0.0)],
        controls(tend, dt, o, ["GLSTAT", "NODOUT", "RWFORC=%r" % dt, "SLEOUT"]),
        curve(1, (0.0, exact.gravity), (2.0 * tend, exact.gravity))
        + gravity(o, 1, -1.0, 0.0)
        + plane(o, 0.0, 0.0, 1.0, 0.0, 0.0)
        + history(face),
    )
    return text, {"face": face, "dt": dt, "tend": tend, "exact": exact}


def block_on_plane(
    o, n, young, extra, tend, tables, mu, density=1.0, size=(1.0, 0.5), title="block", base=0, ground=None
):
    """A block with its foot on the plane y = 0: a rigid wall, or with base=1 a body that is
    fixed in all its nodes, or what `ground` says."""
    c = (young / density) ** 0.5
    dt = step(o, size[0] / n, c)
    tend = math.ceil(tend / dt - 1.0e-9) * dt
    nodes, elements = grid(o, 0.0, 0.0, size[0], size[1], n, max(1, n // 2), 1, 1, 1)
    materials, ground = [(density, young, 0.0)], ground or plane(o, 0.0, 0.0, 0.0, 1.0, mu)
    if base:
        low, cells = grid(
            o, -0.5, -0.5, 2.5, 0.5, 2 * n, 1, 2, 1 + len(nodes), 1 + len(elements)
        )
        ground = ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,%r" % mu]
        ground += node_set(9, [i for i, _, _ in low]) + ["*BOUNDARY_SPC_SET", "9,,1,1"]
        nodes, elements, materials = nodes + low, elements + cells, 2 * materials
        tables = [name.replace("RWFORC", "RCFORC") for name in tables]
    text = deck(
        o,
        title,
        nodes,
        elements,
        materials,
        controls(tend, dt, o, tables),
        ground + extra(nodes),
    )
    return text, {
        "nodes": nodes,
        "dt": dt,
        "tend": tend,
        "mass": density * size[0] * size[1],
        "bounce": 4.0 * size[1] / c,
        "mu": mu,
    }


def sliding(o, n=4, v=1.0, mu=0.2, g=10.0, young=1.0e5, tend=0.7, base=0):
    """Set down without stress: the normal force oscillates about m g with period 4 H/c
    (`bounce`); the friction impulse differs from mu m g t by at most mu m g times that, so the
    velocity by mu g 4 H/c and the place by v 4 H/c."""
    text, meta = block_on_plane(
        o,
        n,
        young,
        lambda nodes: curve(1, (0.0, g), (2 * tend, g))
        + gravity(o, 1, 0.0, -1.0)
        + ["*INITIAL_VELOCITY_GENERATION", "1,2,,%r,%r" % turned(o, v, 0.0), ""],
        tend,
        ["GLSTAT", "MATSUM", "RWFORC"],
        mu,
        title="sliding block",
        base=base,
    )
    return text, dict(meta, v=v, g=g)


def incline(o, n=4, mu=0.3, ratio=1.0, g=10.0, young=1.0e5, tend=0.6, ramp=0.2):
    """Gravity (g_t, -g) with g_t = ratio mu g, both grown together over `ramp`: sticks for
    ratio < 1, accelerates with (ratio - 1) mu g after it for ratio > 1."""
    text, meta = block_on_plane(
        o,
        n,
        young,
        lambda nodes: curve(1, (0.0, 0.0), (ramp, g), (2 * tend, g))
        + gravity(o, 1, ratio * mu, -1.0),
        tend,
        ["GLSTAT", "MATSUM", "RWFORC"],
        mu,
        title="block on an incline",
    )
    return text, dict(meta, ramp=ramp, g=g, ratio=ratio)


def pushed(o, n=4, mu=0.2, g=10.0, rate=5.0, young=1.0e5, tend=0.8, ramp=0.2):
    """Gravity grows over `ramp`; then a force rate x (t - ramp) pushes at the height of the
    foot's rows: it sticks until rate (t - ramp) = mu m g, then m v' = rate (t - ramp) - mu m
    g."""

    def loads(nodes):
        left = [i for i, x, _ in nodes if x == 0.0]
        out = curve(1, (0.0, 0.0), (ramp, g), (2 * tend, g)) + gravity(o, 1, 0.0, -1.0)
        out += curve(
            2,
            (0.0, 0.0),
            (ramp, 0.0),
            (tend, rate * (tend - ramp)),
            (2 * tend, rate * (tend - ramp)),
        )
        out += node_set(5, left)
        for dof, f in enumerate(turned(o, 1.0 / len(left), 0.0), 1):
            out += ["*LOAD_NODE_SET", "5,%d,2,%r" % (dof, f)] if f else []
        return out

    text, meta = block_on_plane(
        o, n, young, loads, tend, ["GLSTAT", "MATSUM", "RWFORC"], mu, title="pushed block"
    )
    return text, dict(meta, ramp=ramp, g=g, rate=rate)


def chain(o, bars=3, n=20, v=1.0, steps_apart=5):
    """Equal bars in a row, gaps of whole steps: momentum passes from bar to bar without loss;
    at Courant number 1 and with the mass DISPERSION exactly."""
    c, length = 1000.0, 10.0
    dt = step(o, length / n, c)
    gap = steps_apart * dt * v
    nodes, elements, extra = [], [], []
    for k in range(bars):
        more, cells = grid(
            o,
            k * (length + gap),
            0.0,
            length,
            1.0,
            n,
            1,
            k + 1,
            1 + len(nodes),
            1 + len(elements),
        )
        nodes, elements = nodes + more, elements + cells
        if k:
            extra += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "%d,%d" % (10 + k, 11 + k)]
    # Each bar is struck steps_apart after the one before has started: gap/v; the pulse takes 2
    # L/c.
    tend = (bars * (2 * n + steps_apart) + n) * dt
    text = deck(
        o,
        "chain of %d bars" % bars,
        nodes,
        elements,
        bars * [(1.0e-3, 1000.0, 0.0)],
        controls(tend, dt, o, ["GLSTAT", "MATSUM", "RCFORC", "SLEOUT"]),
        extra + ["*INITIAL_VELOCITY_GENERATION", "1,2,,%r,%r" % turned(o, v, 0.0), ""],
    )
    return text, {"dt": dt, "tend": tend, "bars": bars, "v": v}


def oblique(o, n=12, wide=40, v=1.0, vt=1.0, mu=0.3, poisson=1.0 / 3.0, touch=0.0, tend=None):
    """A block of wide x n elements of side h falls on a held body at (vt, -v): until sides and
    back are heard of, its middle is a layer on a wall (analytic.Oblique). c_p 1000, rho c_p 1,
    plane strain; n elements are always 12 long. The touch is a fraction of a step after t = 0.
    """
    from analytic import Layer, Oblique  # needs numpy, which the other scenes do not

    c, length, density = 1000.0, 12.0, 1.0e-3
    h = length / n
    dt, width = step(o, h, c), wide * h
    tend = tend if tend else math.floor(0.5 * width / c / dt + 1.0e-9) * dt
    young = density * c**2 * (1.0 + poisson) * (1.0 - 2.0 * poisson) / (1.0 - poisson)
    nodes, elements = grid(o, 0.0, touch * dt * v, width, length, wide, n, 1, 1, 1)
    low, cells = grid(
        o, -h, -h, width + 4.0 * h, h, 1, 1, 2, 1 + len(nodes), 1 + len(elements)
    )
    foot = [i for i, _, y in nodes[:: n + 1]]
    middle = foot[wide // 2]
    text = deck(
        o,
        "oblique impact",
        nodes + low,
        elements + cells,
        2 * [(density, young, poisson)],
        controls(
            tend, dt, o, ["GLSTAT", "NODOUT=%r" % dt, "NCFORC=%r" % dt, "RCFORC=%r" % dt]
        ),
        ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,%r" % mu]
        + node_set(9, [i for i, _, _ in low])
        + ["*BOUNDARY_SPC_SET", "9,,1,1"]
        + ["*INITIAL_VELOCITY_GENERATION", "1,2,,%r,%r" % turned(o, vt, -v), ""]
        + history([middle]),
    )
    shear = (0.5 * (1.0 - 2.0 * poisson) / (1.0 - poisson)) ** 0.5  # c_s/c_p
    layer = Layer(1.0, shear, v, vt, 2.0 * length / c, 2.0 * length / (shear * c))
    return text, {
        "dt": dt,
        "tend": tend,
        "middle": middle,
        "share": h,
        "touch": touch * dt,
        "exact": Oblique(layer, mu),
    }


def thrown(o, nodes, elements, h, title, lowest, mu, v, vt, gap, poisson, tend):
    """A body of density 1 and c_p 100 thrown at the plane y = -gap."""
    c, density = 100.0, 1.0
    dt = step(o, h, c)
    tend = math.ceil(tend / dt - 1.0e-9) * dt
    young = density * c**2 * (1.0 + poisson) * (1.0 - 2.0 * poisson) / (1.0 - poisson)
    text = deck(
        o,
        title,
        nodes,
        elements,
        [(density, young, poisson)],
        controls(tend, dt, o, ["GLSTAT", "MATSUM", "NODOUT", "RWFORC=%r" % dt]),
        plane(o, 0.0, -gap, 0.0, 1.0, mu) + moving(o, vt, -v) + history([lowest]),
    )
    return text, {"dt": dt, "tend": tend, "lowest": lowest, "v": math.hypot(v, vt)}


def block(o, n=16, mu=0.3, v=1.0, vt=0.3, gap=0.01, poisson=0.3, tend=0.05):
    """A unit block of n x n elements; no closed solution: compared with a fine mesh."""
    nodes, elements = grid(o, 0.0, 0.0, 1.0, 1.0, n, n, 1, 1, 1)
    middle = 1 + (n // 2) * (n + 1)
    return thrown(
        o, nodes, elements, 1.0 / n, "thrown block", middle, mu, v, vt, gap, poisson, tend
    )


def disc(o, n=8, mu=0.3, v=1.0, vt=0.3, gap=0.01, poisson=0.3, tend=0.12, radius=0.5):
    """A disc: a square of n x n elements (n even) in n/2 rings of 4 n; no closed solution in the
    plane: compared with a fine mesh. Courant number with the side of the elements at the rim."""
    core, rings, around = 0.5 * radius / math.sqrt(2.0), max(1, n // 2), 4 * n
    nodes, elements = grid(
        o, -core, radius - core, 2.0 * core, 2.0 * core, n, n, 1, 1, 1
    )

    def on_core(k):  # node of the square's edge, counter-clockwise from its lower left corner
        side, m = divmod(k % around, n)
        i, j = ((m, 0), (n, m), (n - m, n), (0, n - m))[side]
        return 1 + i * (n + 1) + j

    place = {i: (x, y) for i, x, y in nodes}
    ring = [[on_core(k) for k in range(around)]]
    for r in range(1, rings + 1):
        ring.append([(n + 1) ** 2 + (r - 1) * around + k + 1 for k in range(around)])
        for k, number in enumerate(ring[-1]):
            x, y = place[ring[0][k]]
            angle = math.pi * (-0.75 + 2.0 * k / around)
            w = r / rings
            edge = radius * math.cos(angle), radius + radius * math.sin(angle)
            nodes.append((number, x + w * (edge[0] - x), y + w * (edge[1] - y)))
    for inner, outer in zip(ring, ring[1:]):
        for k in range(around):
            m = (k + 1) % around
            a, b, c, d = inner[k], outer[k], outer[m], inner[m]
            for corner in [(a, b, c), (a, c, d)] if o["triangles"] else [(a, b, c, d)]:
                elements.append(
                    (len(elements) + 1, 1) + (corner[::-1] if o["mirror"] else corner)
                )
    side = 2.0 * math.pi * radius / around
    lowest = ring[-1][n // 2]
    return thrown(o, nodes, elements, side, "thrown disc", lowest, mu, v, vt, gap, poisson, tend)


def drift(o, gap=0.0, v=0.0, mu=0.5, n=4, tend=0.01):
    """A body over a plane at a gap of 0 or 1e-15, without load: no force may appear."""
    dt = step(o, 1.0 / n, 100.0)
    nodes, elements = grid(o, 0.0, gap, 1.0, 0.5, n, 2, 1, 1, 1)
    text = deck(
        o,
        "grazing",
        nodes,
        elements,
        [(1.0, 1.0e4, 0.3)],
        controls(tend, dt, o, ["GLSTAT", "RWFORC"]),
        plane(o, 0.0, 0.0, 0.0, 1.0, mu) + moving(o, v, 0.0),
    )
    return text, {"dt": dt, "tend": tend}


def mass_on_rod(o, n=100, ratio=1.0, v=1.0, tend=1.9, mu=0.0, part=0):
    """Length 10, c 1000, rho c 1; the mass is `ratio` of the rod's, the end `tend` transits;
    part=1: a rigid part, 1 x 1, in the place of a wall that moves."""
    c, length = 1000.0, 10.0
    dt = step(o, length / n, c)
    tend = round(tend * length / c / dt) * dt
    nodes, elements = grid(o, 0.0, 0.0, length, 1.0, n, 1, 1, 1, 1)
    mass = ratio * length / c
    materials, tables = [(1.0e-3, 1000.0, 0.0)], ["GLSTAT", "MATSUM"]
    held = node_set(9, [i for i, x, _ in nodes if x == 0.0]) + ["*BOUNDARY_SPC_SET", "9,,1,1"]
    if part:
        more, cell = grid(o, length, 0.0, 1.0, 1.0, 1, 1, 2, 1 + len(nodes), 1 + len(elements))
        nodes, elements, materials = nodes + more, elements + cell, materials + [(mass,)]
        striker = ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,%r" % mu]
        striker += ["*INITIAL_VELOCITY_RIGID_BODY", "2,%r,%r" % turned(o, -v, 0.0)]
        tables += ["RCFORC=%r" % dt, "RBDOUT=%r" % dt]
    else:
        at, ahead = turned(o, length, 0.0), turned(o, length - 1.0, 0.0)
        striker = ["*RIGIDWALL_PLANAR_MOVING", "0,", "%r,%r,,%r,%r,,%r" % (at + ahead + (mu,))]
        striker += ["%r,%r" % (mass, v)]
        tables += ["RWFORC=%r" % dt]
    text = deck(
        o,
        "a mass on a rod",
        nodes,
        elements,
        materials,
        controls(tend, dt, o, tables),
        held + striker,
    )
    return text, {"dt": dt, "tend": tend, "mass": mass, "impedance": 1.0, "v": v}


def bowl(o, n=2, steps=5000, periods=2.5, swing=1.0e-3, young=1.0e4, mu=0.0, frame="MID", ramp=0.25):
    """The block of analytic.GlidingBlock, density 1e-3, starts at the bottom; gravity grows over
    `ramp` of a period. frame: field of *BIPACT_CONTACT."""
    from analytic import GlidingBlock  # needs numpy, which the other scenes do not

    exact = GlidingBlock()
    dt = periods * exact.period() / steps
    width = 2.0 * exact.half_width
    nodes, elements = grid(
        o, -exact.half_width, -exact.depth, width, exact.height, n, n, 1, 1, 1
    )
    spin = swing * 2.0 * math.pi / exact.period()
    extra = ["*INITIAL_VELOCITY_NODE"]
    extra += ["%d,%r,%r" % ((i,) + turned(o, -spin * y, spin * x)) for i, x, y in nodes]
    extra += curve(1, (0.0, 0.0), (ramp * exact.period(), exact.gravity), (1.0e3, exact.gravity))
    extra += gravity(o, 1, 0.0, -1.0)
    extra += geometric(o, "CYLINDER_INTERIOR", 0.0, 0.0, mu, exact.radius)
    text = deck(
        o,
        "a block in a bowl",
        nodes,
        elements,
        [(1.0e-3, young, 0.3)],
        controls(steps * dt, dt, o, ["GLSTAT", "NODOUT", "RWFORC"]),
        extra + ["*BIPACT_CONTACT", "AUTO,", ",%s" % frame] + history([i for i, _, _ in nodes]),
    )
    meta = {"nodes": nodes, "dt": dt, "tend": steps * dt, "exact": exact}
    return text, dict(meta, ramp=ramp * exact.period())


def rigid_bowl(o, steps=5000, periods=2.5, sine=0.28, mu=0.0, frame="MID"):
    """A rigid block of one element on two corners in a bowl of radius 1, released at rest from
    an angle with this sine; .28: corners on the circle in whole thousandths."""
    from analytic import GlidingBlock  # needs numpy, which the other scenes do not

    exact = GlidingBlock(radius=1.0, half_width=0.6, height=0.5)
    swing = math.asin(sine)
    period = exact.period(False, swing)
    dt = periods * period / steps
    nodes, elements = grid(o, -0.6, -exact.depth, 1.2, exact.height, 1, 1, 1, 1, 1)
    c, s = math.cos(swing), math.sin(swing)
    nodes = [(i, round(c * x - s * y, 12), round(s * x + c * y, 12)) for i, x, y in nodes]
    extra = curve(1, (0.0, exact.gravity), (1.0e3, exact.gravity)) + gravity(o, 1, 0.0, -1.0)
    extra += geometric(o, "CYLINDER_INTERIOR", 0.0, 0.0, mu, exact.radius)
    text = deck(
        o,
        "a rigid block in a bowl",
        nodes,
        elements,
        [(1.0e-3,)],
        controls(steps * dt, dt, o, ["GLSTAT", "RBDOUT", "RWFORC"]),
        extra + ["*BIPACT_CONTACT", "AUTO,", ",%s" % frame],
    )
    return text, {"dt": dt, "tend": steps * dt, "exact": exact, "swing": swing, "period": period}


def belt(o, n=4, v=1.0, mu=0.2, g=10.0, young=1.0e5, tend=0.7, ends=None):
    """Density 1, 1 x 0.5; set down without stress (see sliding) on a flat wall that moves along
    itself at v; ends: (from, to) of a finite one."""
    motion = (2, 0, (1.0, 0.0))
    size = (ends[1], 0.0, ends[1] - ends[0]) if ends else None
    text, meta = block_on_plane(
        o,
        n,
        young,
        lambda nodes: curve(1, (0.0, g), (2 * tend, g))
        + gravity(o, 1, 0.0, -1.0)
        + curve(2, (0.0, v), (2 * tend, v)),
        tend,
        ["GLSTAT", "MATSUM", "RWFORC"],
        mu,
        title="block on a belt",
        ground=geometric(o, "FLAT", ends[0] if ends else 0.0, 0.0, mu, size, motion),
    )
    return text, dict(meta, v=v, g=g)


SCENES = {
    f.__name__: f
    for f in (
        wall,
        bouncing,
        sliding,
        incline,
        pushed,
        chain,
        oblique,
        block,
        disc,
        drift,
        mass_on_rod,
        bowl,
        rigid_bowl,
        belt,
    )
}
SCENES.update(contact_scenes.SCENES)


def write(path, scene, mesh=False, **options):
    """Writes the deck of a scene, or its mesh alone; returns its data."""
    common = dict(COMMON, **{k: v for k, v in options.items() if k in COMMON})
    text, meta = SCENES[scene](common, **{k: v for k, v in options.items() if k not in COMMON})
    with open(path, "w", encoding="ascii") as out:
        if mesh:
            said = "".join(" %s=%s" % item for item in options.items())
            text = "$ Mesh, written by make_scenes.py %s%s --mesh\n" % (scene, said) + mesh_of(text)
        out.write(text)
    return meta


MESH = ("*NODE", "*ELEMENT_SHELL", "*SET_NODE_LIST", "*SET_SEGMENT")


def mesh_of(text):
    """The cards of a deck that describe its mesh, in columns; coordinates to nine digits."""
    out, name = ["*KEYWORD"], ""
    for line in text.split("\n"):
        if line.startswith("*"):
            name = line
            out += [line] if line in MESH else []
        elif name == "*NODE":
            number, x, y = line.split(",")
            out += ["%8s%16.9g%16.9g" % (number, float(x), float(y))]
        elif name in MESH:
            width = "%8s" if name == "*ELEMENT_SHELL" else "%10s"
            out += ["".join(width % field for field in line.rstrip(",").split(","))]
    return "\n".join(out + ["*END", ""])


def value_of(text):
    """A number where it reads as one."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", choices=sorted(SCENES))
    parser.add_argument("options", nargs="*", metavar="name=value")
    parser.add_argument("-o", metavar="FILE", default="scene.k", help="deck (scene.k)")
    parser.add_argument("--mesh", action="store_true", help="only nodes, elements and their sets")
    a = parser.parse_args()
    options = dict(x.split("=", 1) for x in a.options)
    known = set(COMMON) | set(inspect.signature(SCENES[a.scene]).parameters) - {"o"}
    for name in sorted(set(options) - known):
        parser.error("%s has no %s; it has: %s" % (a.scene, name, " ".join(sorted(known))))
    meta = write(a.o, a.scene, a.mesh, **{k: value_of(v) for k, v in options.items()})
    print("%s: dt %r, end %r" % (a.o, meta["dt"], meta["tend"]))


if __name__ == "__main__":
    main()
