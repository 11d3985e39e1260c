"""Decks at finite deformation: laws with their closed forms, plane meshes, runs."""

import os
import re

import numpy as np
from scenes import check, run_text
import solids

# (MU, ALPHA) of the terms of the Ogden law.
OGDEN = ((20.0, 3.0), (-1.0, -2.0))
# Cards of each law at a scale of stress of 100, number and density left open.
LAWS = {
    "elastic": ["*MAT_ELASTIC", "%d,%r,100.0,0.3"],
    "hencky": ["*MAT_ELASTIC", "%d,%r,100.0,0.3"],
    "foam": ["*MAT_BLATZ-KO_FOAM", "%d,%r,40.0"],
    "rubber": ["*MAT_BLATZ-KO_RUBBER", "%d,%r,34.0"],
    "mooney": ["*MAT_MOONEY-RIVLIN_RUBBER", "%d,%r,0.49,14.0,3.0"],
    "ogden": ["*MAT_OGDEN_RUBBER", "%d,%r,0.49", "20.0,-1.0", "3.0,-2.0"],
    "neo-hooke": ["*MAT_HYPERELASTIC_RUBBER", "%d,%r,0.45", "17.0,"],
    "plastic": ["*MAT_PLASTIC_KINEMATIC", "%d,%r,100.0,0.3,1.0,5.0,0.5"],
    "piecewise": [
        "*MAT_PIECEWISE_LINEAR_PLASTICITY",
        "%d,%r,100.0,0.3,1.0",
        "0.0,",
        "0.0,0.05,0.5",
        "1.0,1.5,2.0",
    ],
}
HYPERELASTIC = tuple(LAWS)[:7]
PLASTIC = tuple(LAWS)[7:]
FINITE = ["*CONTROL_IMPLICIT_SOLUTION", "12,"]


def law(name, number=1, density=1.0e-3):
    """Cards of a law."""
    lines = list(LAWS[name])
    lines[1] = lines[1] % (number, density)
    return lines


def finite(force="", qp0="", name=""):
    """NSOLVR 12, with *BIPACT_KINEMATICS where it says something, also of the law of a name."""
    law = "HENCKY" if name == "hencky" else ""
    if not force + qp0 + law:
        return list(FINITE)
    return FINITE + ["*BIPACT_KINEMATICS", "%s,%s,%s" % (force, law, qp0)]


def turn(angle):
    """The matrix of a turn in the plane."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


class Grid:
    """A rectangle of nx x ny quadrilaterals, or of twice as many triangles; x (n, 2), elements as
    rows of x. shift: how far inner nodes are moved, in parts of a cell."""

    def __init__(
        self, nx, ny, size=(1.0, 1.0), origin=(0.0, 0.0), form="QUAD4", shift=0.0, seed=1
    ):
        chance = np.random.default_rng(seed)
        self.form, self.x, self.elements = form, [], []
        for j in range(ny + 1):
            for i in range(nx + 1):
                move = shift * chance.uniform(-1.0, 1.0, 2) * (0 < i < nx and 0 < j < ny)
                cell = (np.array([i, j]) + move) / (nx, ny)
                self.x.append(np.array(origin) + np.array(size) * cell)
        self.x = np.array(self.x)
        for j in range(ny):
            for i in range(nx):
                a = i + (nx + 1) * j
                four = [a, a + 1, a + nx + 2, a + nx + 1]
                self.elements += [four] if form == "QUAD4" else [four[:3], [four[0], *four[2:]]]

    def on(self, axis, value):
        """Rows of the nodes whose coordinate along an axis has a value."""
        return [k for k, p in enumerate(self.x) if abs(p[axis] - value) < 1e-9]


class Disc(Grid):
    """A disc of radius 1 with n x n quadrilaterals, a square mapped to it."""

    def __init__(self, n, centre):
        super().__init__(n, n, (2.0, 2.0), (-1.0, -1.0))
        a, b = self.x.T.copy()
        self.x = np.stack([a * np.sqrt(1 - b * b / 2), b * np.sqrt(1 - a * a / 2)], axis=1)
        self.x += np.array(centre)


def body(mesh, name, number=1, first=1, plane=13, density=1.0e-3, form=None):
    """Nodes, elements, part, section and law of a mesh, in the plane or in space, and a part set of
    its number."""
    if len(mesh.x[0]) == 3:
        lines = solids.cards(mesh.x, mesh.elements, number, first)
        section = ["*SECTION_SOLID", "%d,%d" % (number, solids.FORMS[mesh.form])]
    else:
        lines = ["*NODE"]
        lines += [
            "%d,%r,%r,0.0" % (first + k, float(p[0]), float(p[1])) for k, p in enumerate(mesh.x)
        ]
        lines += ["*ELEMENT_SHELL"]
        for k, e in enumerate(mesh.elements):
            ids = ",".join(str(first + n) for n in e)
            lines.append("%d,%d,%s" % (first + k, number, ids))
        section = ["*SECTION_SHELL", "%d,%d" % (number, plane), "1.0"]
    lines += ["*PART", name, "%d,%d,%d" % (number, number, number)] + section
    return (
        lines + law(name, number, density) + ["*SET_PART_LIST", "%d," % number, "%d," % number]
    )


def thrown(velocity, rows, first=1):
    """*INITIAL_VELOCITY_NODE of a velocity each row has."""
    lines = ["*INITIAL_VELOCITY_NODE"]
    for r, v in zip(rows, velocity):
        v = list(map(float, v)) + [0.0] * (3 - len(v))
        lines.append("%d,%r,%r,%r" % (first + r, *v))
    return lines


def spinning(x, spin, velocity=0.0, about=None):
    """Velocities of a turn about a point, the axis z in the plane."""
    about = x.mean(axis=0) if about is None else about
    if len(x[0]) == 2:
        return spin * (x - about) @ np.array([[0.0, 1.0], [-1.0, 0.0]]) + velocity
    return np.cross(spin, x - about) + velocity


def run(name, text, *options):
    """Runs a deck that must run; returns its folder."""
    folder, code, errors = run_text(name, text, "--quiet", *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder


def passes(folder):
    """Mean passes of Newton's method a step, and the most of a step, from bipact.log."""
    with open(os.path.join(folder, "bipact.log")) as log:
        words = re.search(r"Newton's method: passes \d+, (\S+) a step, most (\d+)", log.read())
    return float(words.group(1)), int(words.group(2))


def rise(rows):
    """The largest gain of the total energy over its start, of the start."""
    return (rows["total"] / rows["total"][0]).max() - 1.0


# ---------------------------------------------------------------- closed forms


def kirchhoff(name, stretch):
    """Principal Kirchhoff stresses of the laws with a potential, for principal stretches."""
    c = np.array(stretch) ** 2
    j = np.sqrt(c.prod())
    if name == "elastic":
        lam, mu, e = 100 * 0.3 / (1.3 * 0.4), 100 / 2.6, (c - 1) / 2
        return c * (lam * e.sum() + 2 * mu * e)
    if name == "hencky":
        h = np.log(c) / 2
        return 100 * 0.3 / (1.3 * 0.4) * h.sum() + 100 / 1.3 * h
    if name == "foam":
        return 40.0 * (j - 1 / c)
    if name == "rubber":
        return 34.0 * (c - j ** (-2 * 0.463 / (1 - 2 * 0.463)))
    if name == "mooney":
        a, b, nu = 14.0, 3.0, 0.49
        q = a / 2 + b
        p = (a * (5 * nu - 2) + b * (11 * nu - 5)) / (2 * (1 - 2 * nu))
        w = -2 * q / j**4 + 2 * p * j**2 * (j**2 - 1)
        return 2 * (a * c + b * (c.sum() * c - c * c) + w)
    if name == "ogden":
        shear = sum(m * a for m, a in OGDEN) / 2
        bulk = 2 * shear * 1.49 / (3 * (1 - 2 * 0.49))
        bar = np.sqrt(c) * j ** (-1 / 3)
        parts = [m * (bar**a - (bar**a).mean()) for m, a in OGDEN]
        return np.sum(parts, axis=0) + bulk * (j - 1)
    if name == "neo-hooke":
        bulk = 4 * 17.0 * 1.45 / (3 * (1 - 2 * 0.45))
        return 2 * 17.0 * j ** (-2 / 3) * (c - c.sum() / 3) + bulk * j * (j - 1)
    raise KeyError(name)


def lateral(name, stretch, strain_free):
    """The three stretches of a bar pulled to a stretch: both others free, or with the third 1."""

    def stretches(m):
        return (stretch, m, m) if strain_free else (stretch, m, 1.0)

    low, high = 0.3, 3.0
    for _ in range(200):  # the lateral stress grows with the lateral stretch
        middle = 0.5 * (low + high)
        low, high = (
            (middle, high) if kirchhoff(name, stretches(middle))[1] < 0 else (low, middle)
        )
    return stretches(low)
