#!/usr/bin/env python3
"""Extreme decks at finite deformation, judged from outside.

    extreme_finite.py [--count N] [--seed S] [--jobs J] [--keep DIR] [--family WORD] [--only K]

Bodies at up to three times their wave speed, steps of up to 100 elements, Poisson ratios up to
.49999, masses of 1e6 to 1, elements of 1000 to 1, nearly inverted meshes, loads and motions that
no body bears, any units, metals without hardening, explicit steps beyond their limit. A scene is
made from (seed, its number) alone. Exit 0 is believed only as far as the tables bear it out:
numbers are finite, the ledger closes, energy has a source, bodies and walls do not overlap at
their present places, momenta of free flight stay, strain energy of laws and equilibrium of statics
are those of formulas written here, det F > 0 at every point of every written state; else a WARNING
of that kind must stand there. Exit 1 must name step, element or node and give a hint, exit 2 must
write nothing. Full size: tests/fuzz/extreme_finite.py --count 2000 --keep build/extreme
"""

import argparse
import math
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
os.environ.setdefault("ROOT", ROOT)
os.environ.setdefault("BIPACT", os.path.join(ROOT, "bin", "bipact"))
os.environ.setdefault("TMP", tempfile.gettempdir())
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "tests", "support")]
import startup  # noqa: F401  before what is no part of Python
import numpy as np

import collide_judge
import tables
from finite_scenes import FINITE, Disc, Grid, spinning, thrown, turn
from solids import Box, FORMS, cards as solid_cards, curve, deck, node_set

LIMIT = 60.0  # seconds of a run
LEDGER = 1.0e-8  # of the largest term, beyond it WARNING balance is due
GROWTH = 1.0e-7  # of the largest term, as the accuracy of columns; the program warns of 1e-9
OVERLAP = 2.0e-2  # of the shorter edge; the program warns of 1e-2
FLIGHT = 1.0e-8  # of momenta: where Newton's method stops, 1e-9 of the motion
ENERGY = 1.0e-7  # of the strain energy: digits of places in the table


# ---------------------------------------------------------------- laws

KEEPS_VOLUME = ("rubber", "mooney", "ogden", "neo-hooke", "plastic", "piecewise")
HYPERELASTIC = ("elastic", "foam", "rubber", "mooney", "ogden", "neo-hooke")


class Law:
    """A law with its numbers, stresses in units of 100."""

    def __init__(
        self,
        name,
        nu=0.3,
        unit=1.0,
        terms=((20.0, 3.0), (-1.0, -2.0)),
        sigy=1.0,
        etan=5.0,
        beta=0.5,
    ):
        self.name, self.unit, self.terms = name, unit, terms
        self.nu = {"foam": 0.25, "rubber": 0.463}.get(name, nu)
        self.sigy, self.etan, self.beta = sigy, etan, beta
        self.shear = {
            "foam": 40.0,
            "rubber": 34.0,
            "mooney": 34.0,
            "neo-hooke": 34.0,
            "ogden": sum(m * a for m, a in terms) / 2,
        }.get(name, 50.0 / (1 + self.nu))
        self.bulk = 2 * self.shear * (1 + self.nu) / (3 * (1 - 2 * self.nu))

    def cards(self, number, density):
        u, n = self.unit, self.nu
        first = "%d,%r" % (number, density)
        if self.name == "elastic":
            return ["*MAT_ELASTIC", first + ",%r,%r" % (100.0 * u, n)]
        if self.name in ("foam", "rubber"):
            return ["*MAT_BLATZ-KO_" + self.name.upper(), first + ",%r" % (self.shear * u)]
        if self.name == "mooney":
            return ["*MAT_MOONEY-RIVLIN_RUBBER", first + ",%r,%r,%r" % (n, 14.0 * u, 3.0 * u)]
        if self.name == "neo-hooke":
            return ["*MAT_HYPERELASTIC_RUBBER", first + ",%r" % n, "%r," % (17.0 * u)]
        if self.name == "ogden":
            mu, alpha = zip(*self.terms)
            return [
                "*MAT_OGDEN_RUBBER",
                first + ",%r" % n,
                ",".join("%r" % (m * u) for m in mu) + ",",
                ",".join("%r" % a for a in alpha) + ",",
            ]
        sy, et = self.sigy * u, self.etan * u
        if self.name == "plastic":
            return [
                "*MAT_PLASTIC_KINEMATIC",
                first + ",%r,%r,%r,%r,%r" % (100.0 * u, n, sy, et, self.beta),
            ]
        return [
            "*MAT_PIECEWISE_LINEAR_PLASTICITY",
            first + ",%r,%r" % (100.0 * u, n),
            "0.0,",
            "0.0,0.05,0.5",
            "%r,%r,%r" % (sy, 1.5 * sy, 1.5 * sy + 0.1 * et),
        ]

    def speed(self, density):
        """Of pressure waves."""
        return math.sqrt((self.bulk + 4 * self.shear / 3) * self.unit / density)

    def energy(self, f):
        """Strain energy of F (..., 3, 3), per reference volume."""
        c = np.swapaxes(f, -1, -2) @ f
        j = np.linalg.det(f)
        i1 = np.trace(c, axis1=-2, axis2=-1)
        if self.name == "elastic":
            e = (c - np.eye(3)) / 2
            lam = self.bulk - 2 * self.shear / 3
            w = lam / 2 * np.trace(e, axis1=-2, axis2=-1) ** 2 + self.shear * (e * e).sum(
                (-1, -2)
            )
        elif self.name == "foam":
            w = self.shear / 2 * (np.trace(np.linalg.inv(c), axis1=-2, axis2=-1) + 2 * j - 5)
        elif self.name == "rubber":
            b = 2 * 0.463 / (1 - 2 * 0.463)
            w = self.shear / 2 * (i1 - 3 + 2 / b * (j**-b - 1))
        elif self.name == "mooney":
            a, b, n = 14.0, 3.0, self.nu
            q = a / 2 + b
            p = (a * (5 * n - 2) + b * (11 * n - 5)) / (2 * (1 - 2 * n))
            i2 = (i1**2 - (c * c).sum((-1, -2))) / 2
            w = a * (i1 - 3) + b * (i2 - 3) + q * (j**-4.0 - 1) + p * (j**2 - 1) ** 2
        elif self.name == "neo-hooke":
            w = 17.0 * (i1 * j ** (-2 / 3) - 3) + self.bulk / 2 * (j - 1) ** 2
        else:
            bar = np.sqrt(np.linalg.eigvalsh(c)) * j[..., None] ** (-1 / 3)
            w = self.bulk * (j - 1 - np.log(j))
            for m, a in self.terms:
                w = w + m / a * ((bar**a).sum(-1) - 3)
        return w * self.unit


# ---------------------------------------------------------------- kinematics

ROOT3 = 1 / math.sqrt(3)


def shapes(form, p):
    """Values (n) and slopes (n, dimension) of shape functions at a place of the parent element."""
    if form == "TRI3":
        return np.array([1 - p[0] - p[1], p[0], p[1]]), np.array([[-1.0, -1], [1, 0], [0, 1]])
    if form == "TET4":
        return (
            np.array([1 - sum(p), *p]),
            np.array([[-1.0, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        )
    if form == "QUAD4":
        s = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    else:
        s = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        s = np.array([[*a, b] for b in (-1, 1) for a in s])
    f = (1 + s * np.array(p)) / 2
    d = [np.prod(np.delete(f, k, axis=1), axis=1) * s[:, k] / 2 for k in range(s.shape[1])]
    return f.prod(axis=1), np.stack(d, axis=1)


POINTS = {
    "TRI3": [((1 / 3, 1 / 3), 0.5)],
    "TET4": [((0.25, 0.25, 0.25), 1 / 6)],
    "edges": [((0.5, 0.0), 1 / 6), ((0.5, 0.5), 1 / 6), ((0.0, 0.5), 1 / 6)],
    "QUAD4": [((ROOT3 * a, ROOT3 * b), 1.0) for a in (-1, 1) for b in (-1, 1)],
    "HEX8": [
        ((ROOT3 * a, ROOT3 * b, ROOT3 * c), 1.0)
        for a in (-1, 1)
        for b in (-1, 1)
        for c in (-1, 1)
    ],
}


class Body:
    """A mesh with its law and what the judge computes of it."""

    def __init__(self, mesh, law, first=1, plane=13, density=1.0e-3, number=1):
        self.mesh, self.law, self.first, self.plane = mesh, law, first, plane
        self.density, self.number, self.form = density, number, mesh.form
        self.x = np.asarray(mesh.x, float)
        self.elements = np.array(mesh.elements)[:, : 4 if self.form == "TET4" else None]

    def cards(self):
        x, n = self.x, self.number
        if x.shape[1] == 3:
            lines = solid_cards(x, self.mesh.elements, n, self.first)
            section = ["*SECTION_SOLID", "%d,%d" % (n, FORMS[self.form])]
        else:
            lines = ["*NODE"]
            lines += [
                "%d,%r,%r,0.0" % (self.first + k, *map(float, p)) for k, p in enumerate(x)
            ]
            lines += ["*ELEMENT_SHELL"]
            for k, e in enumerate(self.elements):
                lines.append(
                    "%d,%d," % (self.first + k, n) + ",".join(str(self.first + i) for i in e)
                )
            section = ["*SECTION_SHELL", "%d,%d" % (n, self.plane), "1.0"]
        lines += ["*PART", "body", "%d,%d,%d" % (n, n, n)] + section
        lines += self.law.cards(n, self.density)
        return lines + ["*SET_PART_LIST", "%d," % n, "%d," % n]

    def ids(self):
        return range(self.first, self.first + len(self.x))

    def points(self, places=None):
        """For each point: slopes (elements, n, dim), weights (elements), values (n), radii."""
        xe = self.x[self.elements]
        for p, w in POINTS[places or self.form]:
            value, slope = shapes(self.form, p)
            jacobian = np.einsum("ena,nb->eab", xe, slope)
            weight = np.linalg.det(jacobian) * w
            radius = np.einsum("n,en->e", value, xe[:, :, 0])
            if self.plane == 15 and xe.shape[2] == 2:
                weight = weight * 2 * math.pi * radius
            yield (
                np.einsum("nb,eba->ena", slope, np.linalg.inv(jacobian)),
                weight,
                value,
                radius,
            )

    def masses(self):
        m = np.zeros(len(self.x))
        for _, weight, value, _ in self.points("edges" if self.form == "TRI3" else None):
            np.add.at(m, self.elements, self.density * weight[:, None] * value)
        return m

    def gradients(self, u):
        """F (points, elements, 3, 3) and weights (points, elements)."""
        out, weights = [], []
        ue = u[self.elements]
        for slope, weight, value, radius in self.points():
            f = np.zeros((len(ue), 3, 3)) + np.eye(3)
            d = u.shape[1]
            f[:, :d, :d] += np.einsum("ena,enb->eab", ue, slope)
            if self.plane == 15 and d == 2:
                f[:, 2, 2] += np.einsum("n,en->e", value, ue[:, :, 0]) / radius
            out.append(f)
            weights.append(weight)
        return np.array(out), np.array(weights)

    def energy(self, u):
        f, w = self.gradients(u)
        if (
            self.law.name in KEEPS_VOLUME
            and self.form in ("QUAD4", "HEX8")
            and self.plane != 12
        ):
            j = np.linalg.det(f)
            theta = (w * j).sum(0) / w.sum(0)
            f = f * ((theta / j) ** (1 / 3))[..., None, None]
        return float((w * self.law.energy(f)).sum())

    def forces(self, u):
        """Slope of the energy, by differences of it element for element: digits of 1e-9."""
        g, size = np.zeros(u.shape), 1.0e-6 * np.ptp(self.x[self.elements], axis=1).min()
        for k in np.ndindex(u.shape):
            values = []
            for s in (2, 1, -1, -2):
                moved = u.copy()
                moved[k] += s * size
                values.append(self.energy(moved))
            g[k] = (-values[0] + 8 * values[1] - 8 * values[2] + values[3]) / (12 * size)
        return g

    def loop(self):
        """Rows of the outline in order, the body on the left."""
        edges = {}
        for e in self.elements:
            for a, b in zip(e, np.roll(e, -1)):
                edges[int(a), int(b)] = True
        after = {a: b for a, b in edges if (b, a) not in edges}
        start = next(iter(after))
        ring = [start]
        while after[ring[-1]] != start and len(ring) <= len(after):
            ring.append(after[ring[-1]])
        return ring if len(ring) == len(after) else None


# ---------------------------------------------------------------- scenes


class Scene:
    """A deck and what is known of it."""

    def __init__(
        self,
        bodies,
        lines=(),
        dt=1e-4,
        steps=20,
        scheme="THETA,0.5",
        static=False,
        walls=(),
        free=False,
        contact=False,
        force="EMC",
        qp0="",
        held=(),
        loads=(),
        mass="LUMPED,0",
        halve=None,
        every=1,
        smooth=True,
        own=False,
    ):
        self.bodies, self.static, self.walls = bodies, static, walls
        self.free, self.contact, self.scheme, self.force = free, contact, scheme, force
        self.held, self.loads, self.mass, self.smooth, self.own = held, loads, mass, smooth, own
        self.dt, self.steps, self.twin, self.every = dt, steps, None, every
        out = list(FINITE)
        if not static and scheme.startswith("THETA"):
            out += ["*BIPACT_KINEMATICS", "%s,,%s" % (force, qp0)]
        for b in bodies:
            out += b.cards()
        out += list(lines)
        if halve is not None:
            out += ["*BIPACT_STEP", "HALVE,,,,%s" % halve]
        out += ["*DATABASE_HISTORY_NODE"]
        ids = [str(i) for b in bodies for i in b.ids()]
        out += [",".join(ids[k : k + 8]) + "," for k in range(0, len(ids), 8)]
        names = ["GLSTAT", "NODOUT"]
        names += ["RWFORC"] if walls else []
        names += ["SLEOUT"] if walls or contact else []
        self.text = deck(
            out,
            dt,
            dt * steps,
            scheme=scheme,
            mass=mass,
            tables=names,
            static=static,
            every=every * dt,
        )

    @property
    def conserves(self):
        return (
            self.scheme in ("THETA,0.5", "THETA,0.5,0.5")
            and self.force == "EMC"
            and all(b.law.name in HYPERELASTIC for b in self.bodies)
        )


def power(rng, low, high):
    """A random number, its logarithm uniform."""
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def any_law(rng, names=None):
    """A law with numbers at random."""
    name = str(rng.choice(names or HYPERELASTIC + ("plastic", "piecewise")))
    nu = float(rng.choice([0.3, 0.0, 0.45, 0.49, 0.499, 0.49999]))
    if name == "mooney":
        nu = float(rng.choice([0.46, 0.49, 0.499, 0.49999]))
    terms = [
        ((20.0, 3.0), (-1.0, -2.0)),
        ((-20.0, -3.0),),
        ((-30.0, -2.0), (5.0, 1.3)),
        ((0.5, 20.0),),
        ((-1.0, -25.0), (10.0, 2.0)),
    ][rng.integers(5)]
    return Law(
        name,
        nu,
        terms=terms,
        sigy=power(rng, 1e-3, 10.0),
        etan=float(rng.choice([0.0, 1e-8, 1.0, 50.0])),
        beta=float(rng.choice([0, 0.5, 1])),
    )


def step_of(rng, body, size, low=0.1, high=100.0):
    return float(power(rng, low, high) * size / body.law.speed(body.density))


def scheme_of(rng):
    """Scheme, force."""
    k = rng.integers(8)
    if k < 5:
        return "THETA,0.5", "EMC"
    return [("THETA,0.6", "EMC"), ("THETA,0.5", "MIDPOINT"), ("THETA,0.5", "PAPER")][k - 5]


def throw(body, v):
    v = np.asarray(v, float)
    v = np.broadcast_to(v, body.x.shape) if v.ndim == 1 else v
    return thrown(v, range(len(body.x)), body.first)


def floor(mu=0.3, axis=1, y=0.0):
    n = [0.0, 0.0, 0.0]
    n[axis] = 1.0
    at = [y * c for c in n]
    return [
        "*RIGIDWALL_PLANAR",
        "0,",
        ",".join("%r" % c for c in at + [a + b for a, b in zip(at, n)] + [mu]),
    ]


def halvings(rng):
    return [None, 0, 1, 3, 10][rng.integers(5)]


def flight(rng):
    """Spin, stretch and shear at once, free."""
    form = str(rng.choice(["QUAD4", "TRI3"]))
    law = any_law(rng)
    body = Body(
        Grid(
            3,
            2,
            (1.5, 1.0),
            form=form,
            shift=float(rng.uniform(0, 0.4)),
            seed=int(rng.integers(1000)),
        ),
        law,
        plane=int(rng.choice([13, 13, 12])),
    )
    c = law.speed(body.density)
    pull = rng.uniform(-1, 1, (2, 2)) * power(rng, 1e-8, 3.0) * c
    v = (body.x - body.x.mean(axis=0)) @ pull.T + spinning(body.x, power(rng, 1e-6, 2.0) * c)
    scheme, force = scheme_of(rng)
    return Scene(
        [body],
        throw(body, v),
        step_of(rng, body, 0.5),
        20,
        scheme,
        free=True,
        force=force,
        halve=halvings(rng),
        own=True,
    )


def wall(rng):
    """A block thrown at a rough floor."""
    law = any_law(rng)
    mesh = Grid(3, 3)
    mesh.x = mesh.x @ turn(float(rng.choice([0.0, 0.0, rng.uniform(0, 1.5)]))).T
    gap = float(rng.choice([0.0, 1e-6, 0.01, 0.3]))
    mesh.x[:, 1] += gap - mesh.x[:, 1].min()
    body = Body(mesh, law, plane=int(rng.choice([13, 13, 12])))
    c = law.speed(body.density)
    v = power(rng, 1e-6, 3.0) * c * np.array([rng.uniform(-1, 1), -1.0])
    scheme, force = scheme_of(rng)
    mu = float(rng.choice([0.0, 0.3, 1.0, 1.0]))
    return Scene(
        [body],
        throw(body, v) + floor(mu),
        step_of(rng, body, 1 / 3, 0.05),
        25,
        scheme,
        walls=[(1, 0.0)],
        force=force,
        halve=halvings(rng),
        own=True,
    )


def two(
    rng,
    laws,
    ratio,
    mu,
    speed,
    courant,
    steps=25,
    scheme=("THETA,0.5", "EMC"),
    unit=(1.0, 1.0, 1.0),
    sides="1,2",
    halve=None,
    plane=13,
    offset=0.3,
    discs=False,
):
    """Two bodies that meet; units of length, time and mass."""
    length, span, weight = unit
    stress = weight / length / span**2
    bodies = []
    for number, law in enumerate(laws, start=1):
        law.unit = law.unit * stress * (ratio if number == 2 else 1.0)
        low = (0.0, 0.0) if number == 1 else (offset, 1.01)
        mesh = Grid(3 - number % 2, 2, origin=low)
        if discs:
            mesh = Disc(4, (0.0, 0.0) if number == 1 else (offset, 2.01))
        mesh.x = mesh.x * length
        density = 1.0e-3 * weight / length**3 * (ratio if number == 2 else 1.0)
        bodies.append(Body(mesh, law, 1 + 100 * (number - 1), plane, float(density), number))
    c = bodies[0].law.speed(bodies[0].density)
    lines = throw(bodies[1], np.array([0.2, -1.0]) * speed * c)
    lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", sides + ",,,%r" % mu]
    h = float(courant * 0.3 * length / max(b.law.speed(b.density) for b in bodies))
    scene = Scene(
        bodies,
        lines,
        h,
        steps,
        scheme[0],
        contact=True,
        force=scheme[1],
        halve=halve,
        smooth=mu == 0.0,
        own=True,
    )
    scene.length = length
    return scene


def pair(rng):
    return two(
        rng,
        [any_law(rng), any_law(rng)],
        1.0,
        float(rng.choice([0.0, 0.3, 2.0, 1e3])),
        power(rng, 1e-6, 3.0),
        power(rng, 0.05, 100.0),
        scheme=scheme_of(rng),
        sides=str(rng.choice(["1,2", "2,1"])),
        halve=halvings(rng),
        plane=int(rng.choice([13, 13, 12])),
        offset=float(rng.uniform(-0.9, 0.9)),
        discs=bool(rng.integers(2)),
    )


def heavy(rng):
    """Masses and moduli of 1e6 to 1."""
    return two(
        rng,
        [any_law(rng), any_law(rng)],
        power(rng, 1e-6, 1e6),
        0.3,
        power(rng, 1e-3, 0.5),
        power(rng, 0.05, 5.0),
        halve=halvings(rng),
    )


def units(rng):
    """Any units: what is without them stays."""
    names = ("elastic", "foam", "rubber", "plastic")
    state = int(rng.integers(1 << 30))
    scale = tuple(2.0 ** int(k) for k in rng.integers(-30, 31, 3))
    made = []
    for unit in ((1.0, 1.0, 1.0), scale):
        chance = np.random.default_rng(state)
        laws = [Law(str(chance.choice(names))) for _ in range(2)]
        made.append(
            two(
                chance,
                laws,
                1.0,
                0.3,
                power(chance, 1e-3, 0.3),
                power(chance, 0.1, 2.0),
                unit=unit,
                steps=15,
            )
        )
    made[1].twin = made[0]
    return made[1]


def thin(rng):
    """Elements of up to 1000 to 1."""
    law = any_law(rng, HYPERELASTIC)
    aspect = power(rng, 10.0, 1000.0)
    size = (1.0, 3.0 / aspect) if rng.integers(2) else (3.0 / aspect, 1.0)
    body = Body(Grid(3, 3, size, (0.0, 0.01 * min(size))), law)
    c = law.speed(body.density)
    v = power(rng, 1e-4, 0.5) * c
    if rng.integers(2):
        return Scene(
            [body],
            throw(body, (0.0, -v)) + floor(0.3),
            step_of(rng, body, min(size)),
            20,
            walls=[(1, 0.0)],
            halve=halvings(rng),
            own=True,
        )
    flow = spinning(body.x, v)
    return Scene(
        [body],
        throw(body, flow),
        step_of(rng, body, min(size)),
        20,
        free=True,
        halve=halvings(rng),
        own=True,
    )


def statics(rng):
    """Forces of up to 1000 moduli."""
    law = any_law(rng)
    body = Body(Grid(2, 2, shift=0.1), law, plane=int(rng.choice([13, 13, 12])))
    load = power(rng, 1e-4, 1e3) * 100.0 * float(rng.choice([-1, 1]))
    axis = int(rng.integers(2))
    rows = body.mesh.on(1, 1.0)
    lines = node_set(1, body.mesh.on(1, 0.0)) + ["*BOUNDARY_SPC_SET", "1,,1,1"]
    lines += node_set(2, rows) + curve(1, (0.0, 0.0), (1.0, 1.0))
    lines += ["*LOAD_NODE_SET", "2,%d,1,%r" % (axis + 1, load / len(rows))]
    held = [(r, k) for r in body.mesh.on(1, 0.0) for k in (0, 1)]
    return Scene(
        [body],
        lines,
        1 / 8,
        8,
        static=True,
        held=held,
        halve=halvings(rng),
        loads=[(r, axis, load / len(rows)) for r in rows],
        own=True,
    )


def driven(rng):
    """Motions that pull to 10 or turn elements inside out, static or not."""
    law = any_law(rng)
    plane = int(rng.choice([13, 12, 15]))
    mesh = Grid(2, 2)
    body = Body(mesh, law, plane=plane)
    low, top = mesh.on(1, 0.0), mesh.on(1, 1.0)
    way = float(rng.choice([-0.5, -0.9, -0.99, -1.0, -1.5, -3.0, 1.0, 4.0, 9.0, 99.0]))
    static = bool(rng.integers(2))
    end = 1.0 if static else step_of(rng, body, 0.5, 1.0, 1000.0)
    steps = int(rng.choice([2, 10, 50]))
    lines = node_set(1, low) + ["*BOUNDARY_SPC_SET", "1,,1,1"] + node_set(2, top)
    held = {(r, k) for r in low for k in (0, 1)} | {(r, 1) for r in top}
    if plane == 15:
        lines += node_set(3, mesh.on(0, 0.0)) + ["*BOUNDARY_SPC_SET", "3,,1,0"]
        held |= {(r, 0) for r in mesh.on(0, 0.0)}
    lines += curve(1, (0.0, 0.0), (end, way)) + [
        "*BOUNDARY_PRESCRIBED_MOTION_SET",
        "2,2,2,1,1.0",
    ]
    return Scene(
        [body],
        lines,
        end / steps,
        steps,
        static=static,
        held=sorted(held),
        halve=halvings(rng),
        own=True,
    )


def weight(rng):
    """A block under huge gravity on a floor, static start or not."""
    law = any_law(rng)
    body = Body(Grid(2, 3), law)
    g = power(rng, 1e-3, 100.0) * 1.0e5
    lines = curve(1, (0.0, 1.0), (1.0e9, 1.0)) + ["*LOAD_BODY_Y", "1,%r" % g]
    lines += floor(float(rng.choice([0.0, 0.3, 1.0])))
    return Scene(
        [body],
        lines,
        step_of(rng, body, 1 / 3, 0.05, 20.0),
        30,
        walls=[(1, 0.0)],
        halve=halvings(rng),
        own=True,
    )


def folding(rng):
    """A strip in the form of a U closes on itself."""
    law = any_law(rng)

    class Strip:
        form = "QUAD4"

    strip, number = Strip(), {}
    strip.x, strip.elements = [], []
    for j in range(3):
        for i in range(5):
            if i == 0 or j != 1:
                ring = []
                for p in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    if p not in number:
                        number[p] = len(strip.x)
                        strip.x.append((0.3 * p[0], 0.2 * p[1]))
                    ring.append(number[p])
                strip.elements.append(ring)
    body = Body(strip, law)
    c = law.speed(body.density)
    v = np.zeros(body.x.shape)
    v[:, 1] = -np.sign(body.x[:, 1] - 0.3 + 1e-9) * body.x[:, 0] * power(rng, 1e-2, 2.0) * c
    lines = throw(body, v)
    lines += [
        "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE",
        "1,,,,%r" % float(rng.choice([0.0, 0.2, 5])),
    ]
    h = float(min(step_of(rng, body, 0.2, 0.05, 5.0), 0.05 / np.abs(v).max()))
    return Scene(
        [body],
        lines,
        h,
        int(rng.integers(20, 60)),
        contact=True,
        smooth=False,
        halve=halvings(rng),
        own=True,
    )


def metal(rng):
    """Hardly any yield stress or hardening."""
    law = Law(
        str(rng.choice(["plastic", "piecewise"])),
        float(rng.choice([0.0, 0.3, 0.49])),
        sigy=power(rng, 1e-9, 1.0),
        etan=float(rng.choice([0.0, 1e-12, 1e-6, 1.0, 99.0])),
        beta=float(rng.choice([0.0, 0.5, 1.0])),
    )
    body = Body(Grid(2, 4, (1.0, 2.0), (0.0, 0.01)), law, plane=int(rng.choice([13, 12, 15])))
    c = law.speed(body.density)
    v = (0.0, -power(rng, 1e-4, 1.0) * c)
    lines = throw(body, v) + floor(float(rng.choice([0.0, 0.5])))
    if body.plane == 15:
        lines += node_set(3, body.mesh.on(0, 0.0)) + ["*BOUNDARY_SPC_SET", "3,,1,0"]
    return Scene(
        [body],
        lines,
        step_of(rng, body, 0.5, 0.05, 10.0),
        30,
        walls=[(1, 0.0)],
        halve=halvings(rng),
    )


def ring(rng):
    """Around the axis, nodes on it held or not."""
    law = any_law(rng)
    inner = float(rng.choice([0.0, 0.0, 1e-9, 1e-3, 1.0]))
    mesh = Grid(3, 2, (1.0, 1.0), (inner, 0.01), form=str(rng.choice(["QUAD4", "TRI3"])))
    body = Body(mesh, law, plane=15)
    c = law.speed(body.density)
    v = np.stack([body.x[:, 0] * rng.uniform(-1, 1), np.full(len(body.x), -1.0)], axis=1)
    v *= power(rng, 1e-4, 1.0) * c
    lines = throw(body, v) + floor(float(rng.choice([0.0, 0.3])))
    if inner == 0.0 and rng.integers(4):
        lines += node_set(3, mesh.on(0, 0.0)) + ["*BOUNDARY_SPC_SET", "3,,1,0"]
    return Scene(
        [body],
        lines,
        step_of(rng, body, 1 / 3, 0.05, 20.0),
        25,
        walls=[(1, 0.0)],
        halve=halvings(rng),
        own=True,
    )


def bent(rng):
    """Meshes with nearly or wholly inverted elements."""
    law = any_law(rng)
    mesh = Grid(2, 2, (2.0, 2.0), (0.0, 0.01))
    middle = mesh.on(0, 1.0)[1]
    mesh.x[middle] += float(rng.choice([0.3, 0.45, 0.49, 0.499, 0.4999, 0.6])) * rng.choice(
        [-1.0, 1.0], 2
    )
    body = Body(mesh, law)
    c = law.speed(body.density)
    lines = throw(body, (0.0, -power(rng, 1e-3, 0.5) * c)) + floor(0.3)
    return Scene(
        [body],
        lines,
        step_of(rng, body, 0.3, 0.05, 5.0),
        20,
        walls=[(1, 0.0)],
        halve=halvings(rng),
        own=True,
    )


def solid(rng):
    """In space: on a plate, in flight, two boxes."""
    kind, form = int(rng.integers(3)), str(rng.choice(["HEX8", "TET4"]))
    law, scheme = any_law(rng), scheme_of(rng)
    body = Body(Box((2, 1, 2), (1.0, 0.5, 1.0), form, shift=0.1, origin=(0, 0, 0.01)), law)
    c, halve = law.speed(body.density), halvings(rng)
    v = power(rng, 1e-5, 2.0) * c
    h = step_of(rng, body, 0.5, 0.05, 30.0)
    if kind == 0:
        lines = throw(body, (0.3 * v, 0.0, -v)) + floor(float(rng.choice([0.0, 0.5, 1.0])), 2)
        return Scene(
            [body],
            lines,
            h,
            15,
            scheme[0],
            walls=[(2, 0.0)],
            force=scheme[1],
            halve=halve,
            own=True,
        )
    if kind == 1:
        spin = spinning(body.x, v * np.array([0.6, 0.0, 0.8]))
        return Scene(
            [body],
            throw(body, spin),
            h,
            15,
            scheme[0],
            free=True,
            force=scheme[1],
            halve=halve,
            own=True,
        )
    other = Body(
        Box((1, 1, 1), (0.6, 0.6, 0.6), form, origin=(0.2, 0.1, 1.02)),
        any_law(rng),
        101,
        number=2,
    )
    mu = float(rng.choice([0.0, 0.3, 5.0]))
    lines = throw(other, (0.1 * v, 0.0, -v))
    lines += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,2,2", "%r," % mu]
    return Scene(
        [body, other],
        lines,
        h,
        15,
        scheme[0],
        contact=True,
        force=scheme[1],
        halve=halve,
        smooth=mu == 0.0,
        own=True,
    )


def explicit(rng):
    """Explicit steps below and beyond their limit, NEWMARK beside them."""
    law = any_law(rng)
    body = Body(Grid(3, 3, (1.0, 1.0), (0.0, 0.01)), law)
    c = law.speed(body.density)
    kind = int(rng.integers(2))
    v = power(rng, 1e-4, 1.0) * c
    scheme = str(rng.choice(["PAOLI,,,,,,0.0", "PAOLI,,,,,,0.0", "NEWMARK,"]))
    h = step_of(rng, body, 1 / 3, 0.1, 1.5 if scheme.startswith("PAOLI") else 10.0)
    if kind:
        return Scene(
            [body], throw(body, spinning(body.x, v)), h, 60, scheme, free=True, own=True
        )
    return Scene(
        [body], throw(body, (0.0, -v)) + floor(0.3), h, 60, scheme, walls=[(1, 0.0)], own=True
    )


def pulled_apart(rng):
    """Foam and Ogden's law with negative exponents, thrown apart."""
    law = any_law(rng, ("foam", "ogden"))
    body = Body(Grid(4, 2, (2.0, 1.0)), law, plane=int(rng.choice([13, 12])))
    v = (body.x - body.x.mean(axis=0)) * power(rng, 0.1, 3.0) * law.speed(body.density)
    v *= rng.choice([-1.0, 1.0], 2)
    return Scene(
        [body],
        throw(body, v),
        step_of(rng, body, 0.5, 0.05, 2.0),
        40,
        free=True,
        halve=halvings(rng),
        own=True,
    )


FAMILIES = [
    flight,
    wall,
    pair,
    heavy,
    units,
    thin,
    statics,
    driven,
    weight,
    folding,
    metal,
    ring,
    bent,
    solid,
    explicit,
    pulled_apart,
]


def scene_of(seed, number, families=FAMILIES):
    make = families[number % len(families)]
    return make.__name__, make(np.random.default_rng([seed, number]))


# ---------------------------------------------------------------- the judge


def run(text, folder):
    """(exit code or None after the limit, errors) of a deck in a folder."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "deck.k"), "w") as file:
        file.write(text)
    shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
    command = [os.environ["BIPACT"], "deck.k", "-o", "out", "--quiet"]
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=LIMIT,
        )
        return done.returncode, done.stderr.decode("utf-8", "replace")
    except subprocess.TimeoutExpired:
        return None, ""


def read(folder, name):
    _, names, numbers = None, None, None
    with open(os.path.join(folder, "out", name + ".tab")) as file:
        lines = file.read().splitlines()
    head = [x for x in lines if x.startswith("#")]
    names = head[-2].split()[1:] if head[-1].startswith("# end") else head[-1].split()[1:]
    numbers = np.array([x.split() for x in lines if not x.startswith("#")], float)
    return dict(zip(names, numbers.reshape(-1, len(names)).T)), head[-1]


def judge_words(code, errors, folder):
    """Faults of an exit other than 0."""
    if code is None:
        return ["no end within %g s" % LIMIT]
    low = errors.lower()
    for word in ("ortran runtime error", "backtrace", "sanitizer", "runtime error:"):
        if word in low:
            return ["run-time error"]
    if code not in (0, 1, 2):
        return ["exit code %d" % code]
    if code == 2 and os.path.exists(os.path.join(folder, "out")):
        return ["files after a deck error"]
    if code == 2 and "nothing was computed" not in errors:
        return ["exit 2 does not say that nothing was computed"]
    if code == 1:
        faults = []
        if not re.search(r"(step|element|node|cycle) \d", errors):
            faults.append("exit 1 names no step, element or node")
        if "hint" not in errors:
            faults.append("exit 1 without a hint")
        return faults
    return []


def judge(scene, folder, code, errors):
    """What is wrong with a run."""
    faults = judge_words(code, errors, folder)
    if code != 0 or faults:
        return faults
    warned = set(re.findall(r"WARNING ([a-z-]+)", errors))
    try:
        with open(os.path.join(folder, "out", "bipact.log")) as file:
            warned |= set(re.findall(r"WARNING ([a-z-]+)", file.read()))
        rows, end = read(folder, "glstat")
        nodes, _ = read(folder, "nodout")
    except (OSError, ValueError, IndexError) as error:
        return ["tables cannot be read: %s" % error]
    for name, table in (("glstat", rows), ("nodout", nodes)):
        if not all(np.isfinite(c).all() for c in table.values()):
            return ["not a number in %s" % name]
    if "done" not in end:
        faults.append("exit 0, but the table says: " + end)
    tend = scene.dt * scene.steps
    if abs(rows["time"][-1] / tend - 1) > 1e-9:
        faults.append("the table ends at %g, not at %g" % (rows["time"][-1], tend))
    return faults + judge_energy(scene, rows, warned) + judge_motion(scene, rows, nodes, warned)


def judge_energy(scene, rows, warned):
    faults = []
    names = (
        "total",
        "initial",
        "external",
        "motion",
        "friction",
        "contact",
        "algorithmic",
        "plastic",
        "kinetic",
        "internal",
    )
    scale = max(max(np.abs(rows[c]).max() for c in names if c in rows), 1e-300)
    worst = np.abs(rows["residual"]).max()
    if worst > LEDGER and "balance" not in warned:
        faults.append("ledger: residual %.2e without WARNING balance" % worst)
    signs = (
        ("total", 1),
        ("initial", -1),
        ("external", -1),
        ("motion", -1),
        ("friction", 1),
        ("contact", 1),
        ("unsolved", -1),
        ("algorithmic", 1),
        ("damping", 1),
        ("plastic", 1),
    )
    own = sum(s * rows[c] for c, s in signs if c in rows)
    if np.abs(own).max() / scale > LEDGER and "balance" not in warned:
        faults.append("ledger: its columns are open by %.2e" % (np.abs(own).max() / scale))
    # What kinematic hardening stored comes back in the work of reversed yielding; NEWMARK and
    # PAOLI count works with other velocities than those of the law.
    lost = ["friction"] if scene.scheme.startswith("THETA") or scene.static else []
    if not any(b.law.name == "plastic" and b.law.beta < 1.0 for b in scene.bodies):
        lost.append("plastic")
    for c in lost:
        if c in rows and np.diff(rows[c], prepend=0.0).min() < -GROWTH * scale:
            faults.append("ledger: %s gives %.2e back" % (c, -np.diff(rows[c]).min() / scale))
    if rows["contact"].min() < -GROWTH * scale and "energy-growth" not in warned:
        faults.append("ledger: contact gave %.2e" % (-rows["contact"].min() / scale))
    excess = rows["total"] - rows["initial"] - rows["external"] - rows["motion"]
    if not scene.static and "energy-growth" not in warned:
        if excess.max() > GROWTH * scale:
            faults.append(
                "energy above its sources by %.2e, no WARNING" % (excess.max() / scale)
            )
        if scene.conserves and not scene.contact and not scene.walls:
            rise = (excess - np.minimum.accumulate(excess)).max()
            if rise > GROWTH * scale:
                faults.append("energy rose in flight by %.2e" % (rise / scale))
            if -excess.min() > GROWTH * scale:
                faults.append("energy of flight fell by %.2e" % (-excess.min() / scale))
    return faults


def motions(scene, nodes):
    """Displacements and velocities of each body, (rows, nodes, dimension)."""
    count = sum(len(b.x) for b in scene.bodies)
    n = len(nodes["node"]) // count
    at, out = nodes["node"].reshape(n, count)[0], []
    for b in scene.bodies:
        rows = np.searchsorted(at, list(b.ids()))
        names = "xyz"[: b.x.shape[1]]
        pick = [
            np.stack([nodes[p + c].reshape(n, count)[:, rows] for c in names], axis=-1)
            for p in ("u", "v")
        ]
        out.append(pick)
    return out


def judge_motion(scene, rows, nodes, warned):
    faults, moved = [], motions(scene, nodes)
    for b, (u, _) in zip(scene.bodies, moved):
        faults += judge_inside_out(b, u)
    if faults:
        return faults
    if not scene.static:
        faults += judge_momenta(scene, rows, moved, warned)
    # The strain energy of PAOLI's ledger is between two places.
    own = scene.own and not scene.scheme.startswith("PAOLI")
    if own and all(b.law.name in HYPERELASTIC and b.plane != 12 for b in scene.bodies):
        faults += judge_strain_energy(scene, rows, moved)
        if scene.static and not scene.contact and not scene.walls and len(scene.bodies) == 1:
            faults += judge_equilibrium(scene, moved[0][0][-1], warned)
    if "overlap" not in warned:
        faults += judge_overlaps(scene, moved)
    return faults


def judge_inside_out(body, u):
    for k, place in enumerate(u):
        j = np.linalg.det(body.gradients(place)[0])
        if not (j > 0.0).all():
            e = int(np.argmin(j.min(axis=0)))
            return ["row %d: det F %.3e in element %d" % (k, j.min(), body.first + e)]
    return []


def judge_momenta(scene, rows, moved, warned):
    faults = []
    p, span, kinetic = 0.0, 0.0, 0.0
    turning, reach = 0.0, 0.0
    for b, (u, v) in zip(scene.bodies, moved):
        m = b.masses()[None, :, None]
        p = p + (m * v).sum(axis=1)
        span = span + (m[..., 0] * np.linalg.norm(v, axis=-1)).sum(axis=1).max()
        kinetic = kinetic + 0.5 * (m * v * v).sum(axis=(1, 2))
        x = b.x + u
        turns = np.cross(x, m * v) if x.shape[-1] == 3 else collide_judge.cross(x, m * v)
        turning = turning + turns.sum(axis=1)
        size = m[..., 0] * np.linalg.norm(x - 0.0, axis=-1) * np.linalg.norm(v, axis=-1)
        reach = reach + size.sum(axis=1).max()
    axis = any(b.plane == 15 for b in scene.bodies)
    scale = max(kinetic.max(), rows["total"].max(), 1e-300)
    if scene.mass.startswith("LUMPED"):
        off = np.abs(kinetic - rows["kinetic"]).max() / scale
        if off > ENERGY:
            faults.append("kinetic energy is not that of its velocities, by %.2e" % off)
    if (scene.free or scene.contact) and not axis:
        drift = np.abs(p - p[0]).max() / max(span, 1e-300)
        if drift > FLIGHT:
            faults.append("momentum drifts by %.2e" % drift)
    exact = scene.free or (scene.contact and scene.smooth and scene.conserves)
    keeps = scene.scheme.startswith("PAOLI") or (
        scene.scheme == "THETA,0.5" and scene.force in ("EMC", "MIDPOINT")
    )
    if exact and keeps and not axis and "overlap" not in warned:
        first = 1 if scene.scheme.startswith("PAOLI") else 0
        drift = np.abs(turning[first:] - turning[first]).max() / max(reach, 1e-300)
        if drift > FLIGHT:
            faults.append("angular momentum drifts by %.2e" % drift)
    return faults


def judge_strain_energy(scene, rows, moved):
    own = np.array(
        [
            sum(b.energy(u[k]) for b, (u, _) in zip(scene.bodies, moved))
            for k in range(len(rows["time"]))
        ]
    )
    size = sum(np.ptp(b.x, axis=0).prod() * b.law.shear * b.law.unit for b in scene.bodies)
    bulk = max(b.law.bulk / b.law.shear for b in scene.bodies)
    far = max(
        np.abs(u).max() / np.ptp(b.x, axis=0).min() for b, (u, _) in zip(scene.bodies, moved)
    )
    digits = 1e-13 * bulk * (1 + far)
    off = np.abs(own - rows["internal"])
    k = int(np.argmax(off - ENERGY * np.abs(own)))
    if not off[k] <= ENERGY * abs(own[k]) + digits * size * (1 + far):
        return [
            "row %d: strain energy %.10e, by formula %.10e" % (k, rows["internal"][k], own[k])
        ]
    return []


def judge_equilibrium(scene, u, warned):
    body = scene.bodies[0]
    force = body.forces(u)
    given = np.zeros(force.shape)
    for r, k, f in scene.loads:
        given[r, k] += f
    open_, scale = force - given, np.abs(force).max()
    for r, k in scene.held:
        open_[r, k] = 0.0
    off = np.abs(open_).max() / max(scale, 1e-300)
    floor_ = 1.0e-9 * body.law.bulk * body.law.unit * np.ptp(body.x)
    if np.abs(open_).max() > 1.0e-5 * scale + floor_:
        return ["statics: forces out of balance by %.2e" % off]
    return []


def judge_overlaps(scene, moved):
    faults = []
    for axis, level in scene.walls:
        for b, (u, _) in zip(scene.bodies, moved):
            edge = min(
                np.linalg.norm(b.x[e] - b.x[np.roll(e, 1)], axis=1).min() for e in b.elements
            )
            deep = (level - (b.x + u)[..., axis]).max() / edge
            if deep > OVERLAP:
                faults.append("%.2e edges below the wall, no WARNING" % deep)
    if not scene.contact:
        return faults
    outlines = []
    for b, (u, _) in zip(scene.bodies, moved):
        if b.x.shape[1] == 3:
            return faults + judge_solids(scene, moved)
        ring = b.loop()
        outlines.append((b.x + u)[:, ring])
    if len(outlines) == 2:
        deep, row = collide_judge.deepest_of(*outlines)
        if deep > OVERLAP:
            faults.append("row %d: bodies overlap by %.2e edges, no WARNING" % (row, deep))
        for one, other in (outlines, outlines[::-1]):
            gone = collide_judge.through(one, other)
            if gone:
                faults.append("row %d: a node went through the other body" % gone[0][0])
    else:
        faults += judge_crossings(outlines[0][-1:])  # all is looked at now and then, and last
    return faults


def judge_crossings(loop):
    """Edges of one outline that cross each other, deeper than the bound."""
    n = loop.shape[1]
    length = np.linalg.norm(np.roll(loop[0], -1, axis=0) - loop[0], axis=1).min()
    for k, ring_ in enumerate(loop):
        a, d = ring_, np.roll(ring_, -1, axis=0) - ring_
        for i in range(n):
            for j in range(i + 2, n if i else n - 1):
                s1 = collide_judge.cross(d[i], a[j] - a[i])
                s2 = collide_judge.cross(d[i], a[j] + d[j] - a[i])
                t1 = collide_judge.cross(d[j], a[i] - a[j])
                t2 = collide_judge.cross(d[j], a[i] + d[i] - a[j])
                if s1 * s2 < 0 and t1 * t2 < 0:
                    deep = (
                        min(
                            min(abs(s1), abs(s2)) / np.hypot(*d[i]),
                            min(abs(t1), abs(t2)) / np.hypot(*d[j]),
                        )
                        / length
                    )
                    if deep > OVERLAP:
                        return ["row %d: the outline crosses itself by %.2e edges" % (k, deep)]
    return []


CELL = [(0, 1, 3, 4), (1, 2, 3, 6), (4, 5, 6, 1), (4, 6, 7, 3), (1, 3, 4, 6)]


def judge_solids(scene, moved):
    """Nodes of a body inside tetrahedra of the other."""
    for one, other in ((0, 1), (1, 0)):
        body, points = scene.bodies[other], scene.bodies[one].x + moved[one][0]
        place = body.x + moved[other][0]
        cells = body.elements
        if body.form == "HEX8":
            cells = np.concatenate([cells[:, list(c)] for c in CELL])
        for k in range(len(points)):
            t = place[k][cells]
            frame = np.moveaxis(t[:, 1:] - t[:, :1], 1, 2)
            good = np.abs(np.linalg.det(frame)) > 1e-300
            s = np.linalg.solve(frame[good][None], (points[k][:, None] - t[good, 0])[..., None])
            s = s[..., 0]
            least = np.minimum(s.min(axis=-1), 1 - s.sum(axis=-1))
            if least.max() > 3 * OVERLAP:
                return ["row %d: a node is inside the other solid, %.2e" % (k, least.max())]
    return []


def judge_twin(scene, folder, code):
    """Other units: the same exit and the same motion in parts of a length."""
    twin = os.path.join(folder, "twin")
    other, errors = run(scene.twin.text, twin)
    if other != code:
        return ["exit %s, in other units %s: %s" % (code, other, errors.strip()[:200])]
    if code:
        return []
    one, two_ = read(folder, "nodout")[0], read(twin, "nodout")[0]
    off = max(np.abs(one[c] / scene.length - two_[c]).max() for c in ("ux", "uy"))
    return ["motion differs by %.2e in other units" % off] if off > 1e-6 else []


def work(task):
    """Judges scenes; returns codes by family and faults."""
    numbers, seed, keep, families = task
    codes, faults = {}, []
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            name, scene = scene_of(seed, number, families)
            start = time.time()
            code, errors = run(scene.text, folder)
            took = time.time() - start
            with np.errstate(all="ignore"):
                found = judge(scene, folder, code, errors)
                if scene.twin and not found:
                    found = judge_twin(scene, folder, code)
            codes.setdefault(name, []).append(code)
            if found:
                faults.append((number, name, code, took, found))
                if keep:
                    os.makedirs(keep, exist_ok=True)
                    shutil.copy(
                        os.path.join(folder, "deck.k"),
                        os.path.join(keep, "%s_%d.k" % (name, number)),
                    )
    return codes, faults


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=320, help="scenes (320)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", metavar="DIR", help="keep the decks that are at fault")
    parser.add_argument("--family", default="", help="families whose names hold a word")
    parser.add_argument("--only", type=int, help="one scene alone")
    a = parser.parse_args()
    families = [f for f in FAMILIES if a.family in f.__name__]
    numbers = [a.only] if a.only is not None else range(a.count)
    tasks = [(list(numbers)[k :: a.jobs], a.seed, a.keep, families) for k in range(a.jobs)]
    start = time.time()
    with multiprocessing.Pool(a.jobs) as pool:
        parts = pool.map(work, tasks)
    codes, faults = {}, []
    for some, more in parts:
        faults += more
        for name, found in some.items():
            codes.setdefault(name, []).extend(found)
    for number, name, code, took, found in sorted(faults):
        print(
            "FAIL seed %d scene %d, %s, exit %s, %.1f s: %s"
            % (a.seed, number, name, code, took, "; ".join(found))
        )
    for name, found in sorted(codes.items()):
        print(
            "%-14s %s"
            % (
                name,
                ", ".join(
                    "exit %s: %d" % (c, found.count(c)) for c in sorted(set(found), key=str)
                ),
            )
        )
    total = sum(map(len, codes.values()))
    print("%d scenes in %.0f s" % (total, time.time() - start))
    print("%d passed, %d failed" % (total - len(faults), len(faults)))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
