#!/usr/bin/env python3
"""Write a deck of two elastic bars that meet in the plane (needs only the standard library).

Bar 1 lies left of the gap and moves at v1 = +v0, bar 2 right of it at v2 = -v0.  The default
data are our reading of the paper's test: L = 10, H = 1, E = 1000, rho = 0.001, Poisson 0, gap
0.02, v0 = 1, 100 x 1 elements per bar, dt = 1e-5, T = 0.04.

Speeds [L T-1]: the 1-D exact solution uses the bar speed c, c^2 = E/(rho (1 - nu^2)) in plane
strain and E/rho in plane stress; the Courant number uses c_p of the element's law, c_p^2 =
(lambda + 2G)/rho in plane strain and E/(rho (1 - nu^2)) in plane stress.  Both are sqrt(E/rho)
at nu = 0, where the plane test is one-dimensional.

Every number in the deck reads back equal: a card whose numbers do not fit its columns is
written in comma form.  The scene is mirrored, then turned, then moved, then rescaled.

    import make_bars
    meta = make_bars.write("bars.k", nx=50, mass="DISPERSION", courant=1.0)
    meta["touch"], meta["dt"], meta["steps"], meta["bars"][0]["speed"]
"""

import argparse
import json
import math
import os
import random
import sys
from fractions import Fraction
from types import SimpleNamespace

import startup  # noqa: F401  before what is no part of Python
from cards import (
    NODE,
    SHELL,
    TEN,
    block,
    card,
    listed,
    names,
    parameter_lines,
    scheme_cards,
    text_of,
)

DEFAULTS = dict(
    nx=100,
    nx2=None,
    ny=1,
    ny2=None,
    length=10.0,
    length2=None,
    height=1.0,
    thickness=1.0,
    young=1000.0,
    young2=None,
    density=1.0e-3,
    density2=None,
    poisson=0.0,
    plane_stress=False,
    gap=0.02,
    v0=1.0,
    v1=None,
    v2=None,
    mu=0.0,
    pairing=None,
    side=None,
    courant=None,
    dt=None,
    tend=None,
    touch=None,
    scheme="THETA",
    theta=0.5,
    xi=None,
    alpha=-0.3,
    rho=0.8,
    setting={},
    pbeta=0.25,
    mass="CONSISTENT",
    redist=0,
    angle=0.0,
    mirror=None,
    offset=(0.0, 0.0),
    slide=0.0,
    swap=False,
    renumber=None,
    random=None,
    scale_length=1.0,
    scale_mass=1.0,
    scale_time=1.0,
    output=None,
    ledger_every=None,
    split=False,
    tables=("glstat", "matsum", "nodout", "rcforc", "sleout"),
)

TABLES = (
    "glstat",
    "matsum",
    "nodout",
    "elout",
    "rcforc",
    "rwforc",
    "spcforc",
    "ncforc",
    "sleout",
    "timing",
)
SPACING = 1.0e-9  # a time is a whole number of steps when within this fraction of a step


# ---------------------------------------------------------------- data of the scene


def exact(x):
    """The decimal number that a float is printed as, as a fraction."""
    return Fraction(repr(float(x)))


def bar_speed(o, young, density):
    """Speed of long waves in the bar [L T-1], see the head of this file."""
    return math.sqrt(young / (density * (1.0 if o.plane_stress else 1.0 - o.poisson**2)))


def element_speed(o, young, density):
    """c_p of the element's law [L T-1], see the head of this file."""
    nu = o.poisson
    if o.plane_stress:
        return math.sqrt(young / (density * (1.0 - nu * nu)))
    return math.sqrt(young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * density))


def check_positive(o):
    """Refuse sizes, materials and times that make no scene."""
    for name in (
        "nx",
        "nx2",
        "ny",
        "ny2",
        "length",
        "length2",
        "height",
        "thickness",
        "young",
        "young2",
        "density",
        "density2",
        "dt",
        "tend",
        "courant",
        "scale_length",
        "scale_mass",
        "scale_time",
    ):
        value = getattr(o, name)
        if value is not None and value <= 0:
            raise ValueError("%s must be positive" % name)
    if not -1.0 < o.poisson < 0.5:
        raise ValueError("poisson must lie in (-1, 0.5)")


def check_scene(o):
    """Refuse scenes without an impact and options that contradict each other."""
    if o.dt is not None and o.courant is not None:
        raise ValueError("give dt or courant, not both")
    if o.v1 <= o.v2:
        raise ValueError("the bars do not meet: v1 must exceed v2")
    if o.gap < 0.0:
        raise ValueError("gap must not be negative")
    if o.random and not 0.0 <= o.random[0] < 1.0:
        raise ValueError("random: the part R of the spacing must lie in [0, 1)")
    unknown = [name for name in o.tables if name.split("=")[0] not in TABLES]
    if unknown:
        raise ValueError("unknown table %s; known: %s" % (unknown[0], " ".join(TABLES)))


def fill_bars(o):
    """Bar 2 like bar 1 where not given; its elements with the same h/c, so that both bars have
    the same Courant number."""
    for name in ("length", "young", "density", "ny"):
        if getattr(o, name + "2") is None:
            setattr(o, name + "2", getattr(o, name))
    o.v1 = o.v0 if o.v1 is None else o.v1
    o.v2 = -o.v0 if o.v2 is None else o.v2
    check_positive(o)
    o.lengths, o.ny_of = (o.length, o.length2), (o.ny, o.ny2)
    pairs = ((o.young, o.density), (o.young2, o.density2))
    o.speeds = [bar_speed(o, *pair) for pair in pairs]
    o.c_p = [element_speed(o, *pair) for pair in pairs]
    if o.nx2 is None:
        o.nx2 = max(1, round(o.nx * (o.length2 / o.c_p[1]) / (o.length / o.c_p[0])))
    o.nx_of = (o.nx, o.nx2)


def fill_times(o):
    """Step, touch and end.  dt = C h_x/c_p; with `touch` F the gap becomes
    (k + F) dt (v1 - v2), k nearest; the default end is L/c after the release, rounded up to
    whole steps."""
    if o.courant is not None:
        o.dt = float(exact(o.courant) * exact(o.length) / o.nx / exact(o.c_p[0]))
    elif o.dt is None:
        o.dt = 1.0e-5
    closing, dt = exact(o.v1) - exact(o.v2), exact(o.dt)
    if o.touch is not None:
        fraction = exact(o.touch)
        k = max(0, round(exact(o.gap) / (closing * dt) - fraction))
        o.gap = float((k + fraction) * dt * closing)
    o.touch_time = float(exact(o.gap) / closing)
    if o.tend is None:
        transit = [length / c for length, c in zip(o.lengths, o.speeds)]
        o.tend = o.touch_time + 2.0 * max(transit) + transit[0]
        o.steps = whole_steps(o.tend, o.dt)
        o.tend = float(o.steps * dt)
    o.steps = whole_steps(o.tend, o.dt)
    if o.output is None:
        o.output = 0.01 * o.length / o.speeds[0]


def whole_steps(span, dt):
    """Number of steps that reach the span; the last one may be cut."""
    near = round(span / dt)
    return near if abs(span / dt - near) <= SPACING else math.ceil(span / dt)


def fill_units(o):
    """Factors of a change of units: L [L], T [T], V velocity, E stress, R density, F force,
    W energy, Z impedance.  Powers of two leave every digit as it is."""
    a, b, s = float(o.scale_length), float(o.scale_mass), float(o.scale_time)
    o.unit = {
        "L": a,
        "T": s,
        "V": a / s,
        "E": b / (a * s * s),
        "R": b / a**3,
        "F": a * b / (s * s),
        "W": a * a * b / (s * s),
        "Z": b / s,
    }


def resolve(options):
    """All data of the scene from the options, defaults filled in."""
    unknown = set(options) - set(DEFAULTS)
    if unknown:
        raise ValueError("unknown option %s" % sorted(unknown)[0])
    o = SimpleNamespace(**{**DEFAULTS, **options})
    o.scheme, o.mass = o.scheme.upper(), o.mass.upper()
    fill_bars(o)
    check_scene(o)
    fill_times(o)
    fill_units(o)
    return o


# ---------------------------------------------------------------- mesh


def spaced(start, length, n, shift):
    """n + 1 positions; inner ones are shifted by a random part of the spacing."""
    step = exact(length) / n
    inner = [Fraction(shift()) if 0 < i < n else Fraction(0) for i in range(n + 1)]
    return [float(start + step * (i + part)) for i, part in enumerate(inner)]


def grid_lines(o):
    """Per bar the x and the y of its grid lines [L], before turning."""
    amount, seed = o.random or (0.0, 0)
    source = random.Random(int(seed))
    lines = []
    for b in (0, 1):

        def shift():  # random part of the spacing
            return float(amount) * (source.random() - 0.5)

        half = exact(o.gap) / 2
        x0 = -half - exact(o.lengths[b]) if b == 0 else half
        y0 = exact(o.slide) if b == 1 else Fraction(0)
        lines.append(
            (
                spaced(x0, o.lengths[b], o.nx_of[b], shift),
                spaced(y0, o.height, o.ny_of[b], shift),
            )
        )
    return lines


def direction(angle):
    """cos, sin of an angle in degrees; exact at quarter turns."""
    quarter, rest = divmod(angle, 90.0)
    if rest == 0.0:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarter) % 4]
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))


def turn(o, x, y):
    """Mirror a vector, then turn it about the origin."""
    x, y = (-x if o.mirror == "x" else x), (-y if o.mirror == "y" else y)
    c, s = direction(o.angle)
    return c * x - s * y + 0.0, s * x + c * y + 0.0


def place(o, x, y):
    """Coordinates of a point in the deck [L]."""
    x, y = turn(o, x, y)
    return (x + o.offset[0]) * o.unit["L"], (y + o.offset[1]) * o.unit["L"]


def numbering(count, seed):
    """Ids 1..count, or random ids with holes."""
    if seed is None:
        return list(range(1, count + 1))
    return random.Random(seed).sample(range(1, 4 * count + 1), count)


def node_table(o):
    """Ordered {(bar, i, j): (id, x, y)}."""
    lines = grid_lines(o)
    order = (1, 0) if o.swap else (0, 1)
    keys = [
        (b, i, j) for b in order for i in range(o.nx_of[b] + 1) for j in range(o.ny_of[b] + 1)
    ]
    ids = numbering(len(keys), o.renumber)
    return {
        key: (n,) + place(o, lines[key[0]][0][key[1]], lines[key[0]][1][key[2]])
        for key, n in zip(keys, ids)
    }


def element_list(o, nodes):
    """Elements (id, part, n1, n2, n3, n4), counter-clockwise also when mirrored."""
    order = (1, 0) if o.swap else (0, 1)
    cells = [(b, i, j) for b in order for i in range(o.nx_of[b]) for j in range(o.ny_of[b])]
    ids = numbering(len(cells), None if o.renumber is None else o.renumber + 1)
    elements = []
    for e, (b, i, j) in zip(ids, cells):
        corner = [nodes[b, i + p, j + q][0] for p, q in ((0, 0), (1, 0), (1, 1), (0, 1))]
        if o.mirror:
            corner[1], corner[3] = corner[3], corner[1]
        elements.append((e, b + 1, *corner))
    return elements


def make_mesh(o):
    """Nodes, elements and node sets of the scene."""
    nodes = node_table(o)

    def face(b, i):  # nodes of grid line i of bar b
        return [nodes[b, i, j][0] for j in range(o.ny_of[b] + 1)]

    mesh = SimpleNamespace(
        nodes=list(nodes.values()),
        elements=element_list(o, nodes),
        face1=face(0, o.nx),
        face2=face(1, 0),
        ends=face(0, 0) + face(1, o.nx2),
    )
    if o.renumber is not None:  # lines in random order, too
        source = random.Random(o.renumber + 2)
        source.shuffle(mesh.nodes)
        source.shuffle(mesh.elements)
    return mesh


# ---------------------------------------------------------------- deck


def mesh_lines(o, mesh):
    """Nodes, elements and sets."""
    out = ["*NODE", names(NODE, *"nid x y z tc rc".split())]
    out += [card(NODE, n, x, y, 0.0) for n, x, y in mesh.nodes]
    out += ["*ELEMENT_SHELL", names(SHELL, *"eid pid n1 n2 n3 n4".split())]
    out += [card(SHELL, *element) for element in mesh.elements]
    for sid, title, ids in (
        (1, "left bar, contact face", mesh.face1),
        (2, "right bar, contact face", mesh.face2),
        (3, "free ends", mesh.ends),
    ):
        out += ["*SET_NODE_LIST_TITLE", title, names(TEN, "sid"), card(TEN, sid)]
        out += [names(TEN, *("nid%d" % k for k in range(1, 9)))] + listed(ids)
    return out


def parameters(o):
    """Parameters {name: value} of the numbers that fit their 10 columns; v0 only where it sets
    both velocities."""
    values = {"tend": o.tend * o.unit["T"], "dt": o.dt * o.unit["T"]}
    if o.v1 == -o.v2 and direction(o.angle)[1] == 0.0:
        values["v0"] = o.v1 * o.unit["V"]
    values["mu"] = float(o.mu)
    return {name: value for name, value in values.items() if len(text_of(value)) <= 10}


def named(o, name, value):
    """'&name' or '-&name' where the parameter holds the value, else the number."""
    known = parameters(o).get(name)
    if known is None or abs(value) != abs(known):
        return value
    return ("&" if value == known else "-&") + name


def scheme_setting(o):
    """{field of the scheme's cards: value}; fields that the scheme does not use stay blank."""
    own = {
        "THETA": {"theta": float(o.theta), "xi": None if o.xi is None else float(o.xi)},
        "NEWMARK": {"gamma": 0.5, "beta": 0.25},
        "HHT": {"alpha": float(o.alpha)},
        "GENALPHA": {"rhoinf": float(o.rho)},
        "PAOLI": {"pbeta": 0.0 if o.pbeta == 0.0 else None},
    }
    return dict(own.get(o.scheme, {}), **o.setting)


def control_lines(o):
    """Time, scheme and mass; fields that the scheme does not use stay blank."""
    out = block(
        "*CONTROL_TERMINATION",
        "endtim endcyc dtmin endeng endmas",
        named(o, "tend", o.tend * o.unit["T"]),
    )
    out += block(
        "*CONTROL_IMPLICIT_GENERAL",
        "imflag dt0 imform nsbs igs cnstn form zero_v",
        1,
        named(o, "dt", o.dt * o.unit["T"]),
    )
    out += scheme_cards(o.scheme, **scheme_setting(o))
    out += block("*BIPACT_MASS", "type redist courant", o.mass, o.redist or None)
    if o.ledger_every is not None:
        out += block("*BIPACT_LEDGER", "every growth action", o.ledger_every)
    return out


def part_lines(o):
    """Parts, section and materials; one material if the bars are alike."""
    same = (o.young, o.density) == (o.young2, o.density2)
    labels = names(TEN, *"pid secid mid eosid hgid grav adpopt tmid".split())
    out = [
        "*PART",
        "left bar",
        labels,
        card(TEN, 1, 1, 1),
        "right bar",
        card(TEN, 2, 1, 1 if same else 2),
    ]
    out += block(
        "*SECTION_SHELL",
        "secid elform shrf nip propt qr/irid icomp setyp",
        1,
        12 if o.plane_stress else 13,
        None,
        4,
    )
    t = o.thickness * o.unit["L"]
    out += [names(TEN, *"t1 t2 t3 t4 nloc marea idof edgset".split()), card(TEN, t, t, t, t)]
    materials = [(1, o.density, o.young)] + ([] if same else [(2, o.density2, o.young2)])
    for mid, density, young in materials:
        out += block(
            "*MAT_ELASTIC",
            "mid ro e pr da db",
            mid,
            density * o.unit["R"],
            young * o.unit["E"],
            float(o.poisson),
        )
    return out


def velocity_lines(o, part, speed):
    """Initial velocity of one part [L T-1]; the mandatory second card is blank."""
    vx, vy = (v * o.unit["V"] for v in turn(o, speed, 0.0))
    fields = (named(o, "v0", vx),) if vy == 0.0 else (vx, vy)
    out = block(
        "*INITIAL_VELOCITY_GENERATION",
        "id styp omega vx vy vz ivatn icid",
        part,
        2,
        None,
        *fields
    )
    return out + [names(TEN, *"xc yc zc nx ny nz phase irigid".split()), ""]


def contact_lines(o):
    """Part sets 11 (left bar), 12 (right bar) and their contact."""
    out = []
    for sid, part in ((11, 1), (12, 2)):
        out += block("*SET_PART_LIST", "sid", sid) + [names(TEN, "pid1"), card(TEN, part)]
    mu = named(o, "mu", float(o.mu))
    out += block(
        "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE",
        "surfa surfb sfact freq fs fd dc",
        *((12, 11) if o.swap else (11, 12)),
        None,
        None,
        mu,
        mu
    )
    out += [names(TEN, *"tbirth tdeath soa sob nda ndb cof init".split()), ""]
    if o.pairing or o.side:
        fields = 1, o.side, None, None, None, o.pairing
        out += block("*BIPACT_PAIR", "cid side atyp btyp rest pairing", *fields)
    return out


def interval(o, given):
    """Output interval [T] in deck units: a number, or 'step' for every step."""
    return (o.dt if given == "step" else float(given)) * o.unit["T"]


def output_lines(o, mesh):
    """Histories and tables."""
    history = mesh.face1 + mesh.face2 + mesh.ends
    ids = names(TEN, *("id%d" % k for k in range(1, 9)))
    out = ["*DATABASE_HISTORY_NODE", ids] + listed(history)
    for entry in o.tables:
        name, _, own = entry.partition("=")
        if name == "elout":
            near = [e[0] for e in mesh.elements if set(e[2:]) & set(mesh.face1 + mesh.face2)]
            out += ["*DATABASE_HISTORY_SHELL", ids] + listed(near)
        dt = interval(o, own or o.output)
        if name == "timing":
            out += block("*BIPACT_TIMING", "dt", dt)
        else:
            out += block("*DATABASE_" + name.upper(), "dt binary lcur ioopt", dt)
    return out


def main_lines(o, mesh, include):
    """The deck; with `include` the mesh is in that file."""
    out = [
        "$ two elastic bars, written by make_bars.py",
        "*KEYWORD",
        "*TITLE",
        "two-bar impact, %s scheme, %s mass" % (o.scheme, o.mass),
    ]
    out += parameter_lines(parameters(o))
    out += ["*INCLUDE", include] if include else mesh_lines(o, mesh)
    out += control_lines(o) + part_lines(o)
    bars = ((1, o.v1), (2, o.v2))
    for part, speed in reversed(bars) if o.swap else bars:
        out += velocity_lines(o, part, speed)
    return out + contact_lines(o) + output_lines(o, mesh) + ["*END"]


# ---------------------------------------------------------------- what tests need to know


def bar_data(o, b):
    """Bar b for the exact solution, in deck units; impedance Z = rho c A [M T-1]."""
    density = (o.density, o.density2)[b] * o.unit["R"]
    speed = o.speeds[b] * o.unit["V"]
    area = o.height * o.thickness * o.unit["L"] ** 2
    return {
        "length": o.lengths[b] * o.unit["L"],
        "speed": speed,
        "density": density,
        "young": (o.young, o.young2)[b] * o.unit["E"],
        "area": area,
        "impedance": density * speed * area,
        "velocity": (o.v1, o.v2)[b] * o.unit["V"],
        "elements": [o.nx_of[b], o.ny_of[b]],
        "courant": o.dt * o.c_p[b] * o.nx_of[b] / o.lengths[b],
    }


def scene_case(o):
    """'two_bars' for identical bars that meet head on, else 'unequal'."""
    same = (o.length, o.young, o.density) == (o.length2, o.young2, o.density2)
    return "two_bars" if same and o.v1 == -o.v2 else "unequal"


def make_meta(o, mesh):
    """Data of the scene in deck units, as a dictionary that json can hold."""
    axis = turn(o, 1.0, 0.0)
    meta = {
        "case": scene_case(o),
        "bars": [bar_data(o, 0), bar_data(o, 1)],
        "gap": o.gap * o.unit["L"],
        "v0": 0.5 * (o.v1 - o.v2) * o.unit["V"],
        "touch": o.touch_time * o.unit["T"],
        "dt": o.dt * o.unit["T"],
        "steps": o.steps,
        "tend": o.tend * o.unit["T"],
        "output": interval(o, o.output),
        "height": o.height * o.unit["L"],
        "thickness": o.thickness * o.unit["L"],
        "poisson": o.poisson,
        "mu": o.mu,
        "angle": o.angle,
        "axis": list(axis),
        "lateral": list(turn(o, 0.0, 1.0)),
        "sides": [2, 1] if o.swap else [1, 2],
        "scheme": o.scheme,
        "theta": o.theta,
        "xi": o.theta if o.xi is None else o.xi,
        "mass": o.mass,
        "redist": o.redist,
        "scales": [o.scale_length, o.scale_mass, o.scale_time],
        "face1": mesh.face1,
        "face2": mesh.face2,
        "free_ends": mesh.ends,
    }
    bar1, bar2 = meta["bars"]
    meta["c"], meta["L"], meta["Z"] = bar1["speed"], bar1["length"], bar1["impedance"]
    meta["release"] = meta["touch"] + 2.0 * meta["L"] / meta["c"]
    meta["energy"] = sum(
        0.5 * b["impedance"] / b["speed"] * b["length"] * b["velocity"] ** 2
        for b in (bar1, bar2)
    )
    return meta


def describe(**options):
    """The data that write() returns, without a deck."""
    o = resolve(options)
    return make_meta(o, make_mesh(o))


def deck_texts(path, options):
    """[(path, text)] of the files of the deck, main deck first, and its data."""
    o = resolve(options)
    mesh = make_mesh(o)
    mesh_name = os.path.splitext(os.path.basename(path))[0] + "_mesh.k"
    main_deck = main_lines(o, mesh, mesh_name if o.split else None)
    files = [(path, "\n".join(main_deck) + "\n")]
    if o.split:
        lines = ["$ mesh of two bars", "*KEYWORD"] + mesh_lines(o, mesh) + ["*END"]
        files.append((os.path.join(os.path.dirname(path), mesh_name), "\n".join(lines) + "\n"))
    return files, make_meta(o, mesh)


def write(path, meta_file=False, **options):
    """Write the deck (and PATH's .json with meta_file) and return its data in deck units:

    case, bars [{length, speed, impedance, velocity, ...}, ...], c, L, Z (of bar 1), gap, v0
    (half the closing speed), touch, release (of identical bars), dt, steps, tend, energy, axis,
    sides (contact side of bar 1 and bar 2), face1, face2, free_ends (node ids)."""
    path = os.fspath(path)
    files, meta = deck_texts(path, options)
    for name, text in files:
        with open(name, "w", encoding="ascii", newline="\n") as out:
            out.write(text)
    if meta_file:
        with open(os.path.splitext(path)[0] + ".json", "w", encoding="ascii") as out:
            json.dump(meta, out, indent=1)
            out.write("\n")
    return meta


# ---------------------------------------------------------------- command line


def number_or_step(text):
    """A number, or the word 'step'."""
    return text if text == "step" else float(text)


def point(text):
    """'DX,DY' as two numbers."""
    x, y = text.split(",")
    return float(x), float(y)


def field_value(text):
    """('pbeta', 0.0) of 'pbeta=0'; a word stays a word."""
    name, value = text.split("=")
    try:
        return name.lower(), float(value)
    except ValueError:
        return name.lower(), value


class Fields(argparse.Action):
    """Pairs of the command line as a dictionary."""

    def __call__(self, parser, namespace, values, option_string=None):
        setattr(namespace, self.dest, dict(values))


def add_scene_options(add):
    """Options of geometry, material and motion."""
    add("--nx", type=int, help="elements along bar 1 (100)")
    add("--nx2", type=int, help="along bar 2 (so that h/c equals that of bar 1)")
    add("--ny", type=int, help="elements across bar 1 (1)")
    add("--ny2", type=int, help="across bar 2 (as bar 1)")
    add("--length", type=float, help="of bar 1 [L] (10)")
    add("--length2", type=float, help="of bar 2 (as bar 1)")
    add("--height", type=float, help="of both bars [L] (1)")
    add("--thickness", type=float, help="of both bars [L] (1)")
    add("--young", type=float, help="of bar 1 [F L-2] (1000)")
    add("--young2", type=float, help="of bar 2 (as bar 1)")
    add("--density", type=float, help="of bar 1 [M L-3] (0.001)")
    add("--density2", type=float, help="of bar 2 (as bar 1)")
    add("--poisson", type=float, help="of both bars (0)")
    add("--plane-stress", action="store_true", help="plane stress instead of plane strain")
    add("--gap", type=float, help="[L] (0.02)")
    add("--v0", type=float, help="bar 1 at +v0, bar 2 at -v0 [L T-1] (1)")
    add("--v1", type=float, help="velocity of bar 1 instead of +v0")
    add("--v2", type=float, help="velocity of bar 2 instead of -v0")
    add("--mu", type=float, help="friction coefficient (0)")
    add("--pairing", choices=("NODE", "MORTAR"), help="rows of contact (NODE)")
    add("--side", choices=("AUTO", "A", "B", "BOTH"), help="SIDE of *BIPACT_PAIR (AUTO)")


def add_time_options(add):
    """Options of time, scheme and mass."""
    add("--courant", type=float, metavar="C", help="dt = C h_x/c of bar 1")
    add("--dt", type=float, help="[T] (1e-5)")
    add("--tend", type=float, help="[T] (0.04; other data: L/c after the release)")
    add(
        "--touch",
        type=float,
        metavar="F",
        help="change the gap so that the touch is at fraction F of a step",
    )
    add(
        "--scheme",
        type=str.upper,
        help="as in *BIPACT_TIME (THETA)",
    )
    add("--alpha", type=float, help="of HHT (-0.3)")
    add("--rho", type=float, help="of GENALPHA (0.8)")
    add("--pbeta", type=float, choices=(0.0, 0.25), help="of PAOLI; 0: explicit (0.25)")
    add("--theta", type=float, help="(0.5)")
    add(
        "--setting",
        nargs="*",
        type=field_value,
        action=Fields,
        metavar="FIELD=VALUE",
        help="other fields of the scheme, by their names in *BIPACT_TIME: pbeta=0",
    )
    add("--xi", type=float, help="(theta)")
    add(
        "--mass",
        type=str.upper,
        choices=("CONSISTENT", "LUMPED", "DISPERSION"),
        help="(CONSISTENT)",
    )
    add("--redist", type=int, choices=(0, 1), help="1: massless contact nodes (0)")


def add_variant_options(add):
    """Options that write the same scene in another way."""
    add("--angle", type=float, metavar="DEGREES", help="turn the scene about the origin")
    add("--mirror", choices=("x", "y"), help="x: x -> -x, y: y -> -y")
    add("--offset", type=point, metavar="DX,DY", help="move the scene [L]; write --offset=-1,0")
    add("--slide", type=float, metavar="S", help="move bar 2 across its axis by S [L]")
    add("--swap", action="store_true", help="bar 2 first: nodes, elements, velocity, contact")
    add("--renumber", type=int, metavar="SEED", help="random ids in random order")
    add(
        "--random",
        nargs=2,
        type=float,
        metavar=("R", "SEED"),
        help="shift inner mesh lines by up to R/2 of the spacing, R < 1",
    )
    add("--scale-length", type=float, metavar="A", help="change of units; use powers of two")
    add("--scale-mass", type=float, metavar="A", help="the same for masses")
    add("--scale-time", type=float, metavar="A", help="the same for times")


def add_output_options(add):
    """Options of tables and files."""
    add(
        "--output",
        type=number_or_step,
        metavar="DT",
        help="interval of the tables [T], or the word step (L/c/100 = 1e-4)",
    )
    add(
        "--tables",
        nargs="*",
        metavar="NAME[=DT]",
        help="tables (glstat matsum nodout rcforc sleout); NAME=step or NAME=DT: own interval",
    )
    add("--ledger-every", type=int, metavar="N", help="*BIPACT_LEDGER every N steps")
    add("--split", action="store_true", help="mesh in its own file FILE_mesh.k")


def parse_arguments(argv):
    """Command line as a namespace; options not given are absent."""
    parser = argparse.ArgumentParser(
        argument_default=argparse.SUPPRESS,
        description="Write a deck of two elastic bars that meet. Defaults in parentheses.",
        epilog="Example: make_bars.py --mass DISPERSION --courant 1 --angle 37 --meta -o a.k",
    )
    for group, fill in (
        ("scene", add_scene_options),
        ("time and scheme", add_time_options),
        ("variants", add_variant_options),
        ("output", add_output_options),
    ):
        fill(parser.add_argument_group(group).add_argument)
    parser.add_argument("-o", dest="path", metavar="FILE", help="deck (default: to stdout)")
    parser.add_argument("--meta", action="store_true", help="also write FILE's data as .json")
    arguments = parser.parse_args(argv)
    if "path" not in arguments and ("meta" in arguments or "split" in arguments):
        parser.error("--meta and --split need -o FILE")
    return arguments


def main(argv=None):
    options = vars(parse_arguments(argv))
    path, meta_file = options.pop("path", None), options.pop("meta", False)
    try:
        if path is None:
            sys.stdout.write(deck_texts("bars.k", options)[0][0][1])
            return 0
        meta = write(path, meta_file=meta_file, **options)
    except (ValueError, OSError) as problem:
        print("make_bars.py: %s" % problem, file=sys.stderr)
        return 1
    print(
        "%s: dt %r, %d steps, touch at %r, contact faces %s and %s"
        % (path, meta["dt"], meta["steps"], meta["touch"], meta["face1"], meta["face2"])
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
