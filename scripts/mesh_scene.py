"""A small main deck for a mesh: its bodies fly down at a rigid wall and bounce. Lines that
begin with '$ edit' say what to change for a scene of one's own."""

import functools
import math
from decimal import Decimal

import numpy as np

from cards import TEN, block, card, heading, names, parameter_lines
from mesh_parts import sides_of
from mesh_shapes import LINEAR, TEN_NODES, TWENTY_SEVEN

YOUNG, DENSITY, POISSON, FRICTION = 1000.0, 0.001, 0.3, 0.2  # [F L-2], [M L-3], -, -
SPEED = math.sqrt(YOUNG / DENSITY)  # of waves in a bar [L T-1]
STEEP = 250  # bodies fly SPEED/STEEP: they turn by less than 5 degrees before the end
FLIGHT = 10  # steps before the touch
# Of the largest body by a wave, from the touch to the end: beyond the bounce, which takes a ball
# longer than a disc.
CROSSINGS = {2: 5, 3: 9}
FRAMES = 50


def times(mesh, parted):
    """Step, end, interval of fields [T], of few digits; gap [L]."""
    rings = mesh.elements.nodes if mesh.dim == 2 else sides_of(mesh)[0]
    along = mesh.x[np.roll(rings, -1, axis=1)] - mesh.x[rings]
    edges = functools.reduce(np.hypot, np.moveaxis(along, 2, 0))
    edge = float(np.median(edges[edges > 0.0]))
    dt = Decimal("%.1e" % (0.5 * edge / SPEED))  # a wave crosses half an edge in a step
    size = max(float(np.ptp(mesh.x[rows], axis=0).max()) for rows in parted)
    steps = FLIGHT + CROSSINGS[mesh.dim] * size / SPEED / float(dt)
    steps = int(
        Decimal("%.2e" % math.ceil(1.005 * steps))
    )  # few digits: the end fits its field
    every = max(1, steps // FRAMES)
    return float(dt), float(dt * steps), float(dt * every), FLIGHT * float(dt) * SPEED / STEEP


def bodies(mesh):
    """Rows of the nodes of each body; bodies share no node."""
    up = list(range(len(mesh.x)))

    def root(n):
        while up[n] != n:
            up[n] = up[up[n]]
            n = up[n]
        return n

    for corners in mesh.elements.nodes.tolist():
        first = root(corners[0])
        for n in corners[1:]:
            up[root(n)] = first
    label = np.array([root(n) for n in range(len(up))])
    order = np.argsort(label, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(label[order])) + 1)


def scene_lines(mesh, found, include):
    """The main deck."""
    parted = bodies(mesh)
    dt, end, every, gap = times(mesh, parted)
    out = ["$ " + text for text in INTRODUCTION]
    out += ["*KEYWORD", "*TITLE", heading("the mesh %s falls on a rigid wall" % include, 80)]
    out += ["$", "$ edit: end, step [T], speed [L/T]; bipact DECK -D v0=5 sets one for a run"]
    out += parameter_lines({"tend": end, "dt": dt, "v0": SPEED / STEEP})
    out += ["*INCLUDE", include]
    out += block("*CONTROL_TERMINATION", "endtim", "&tend")
    out += block("*CONTROL_IMPLICIT_GENERAL", "imflag dt0", 1, "&dt")
    out += block("*CONTROL_IMPLICIT_DYNAMICS", "imass", 1)
    out += block("*BIPACT_TIME", "scheme theta", "THETA", 0.5)
    out += section_lines(mesh, found) + material_lines(found)
    out += motion_lines(mesh, gap, len(parted))
    return out + example_lines(mesh, found) + output_lines(every) + ["*END"]


INTRODUCTION = (
    "A scene for a mesh, written by mesh2deck.py --scene. It runs as it is: the bodies fly",
    "down at a rigid wall and bounce. Lines that begin with '$ edit' say what to change.",
    "Units: any consistent set, mass M, length L, time T.",
)


# ELFORM of each section of solids, and what else it may be.
SOLIDS = {
    LINEAR: (-1, "elform -1: hexahedra with incompatible modes; 1 full, 2 mean dilatation"),
    TEN_NODES: (16, "elform 16: tetrahedra of 10 nodes"),
    TWENTY_SEVEN: (24, "elform 24: hexahedra of 27 nodes"),
}


def section_lines(mesh, found):
    """One section for all plane parts, for solids one for each of the forms that there are."""
    if mesh.dim == 2:
        out = ["$", "$ edit: elform 13 plane strain, 12 plane stress; t1 thickness [L]"]
        out += block("*SECTION_SHELL", "secid elform shrf nip", 1, 13, None, 4)
        return out + [names(TEN, "t1"), card(TEN, 1.0)]
    out = []
    for section in sorted({p.section for p in found.parts}):
        elform, what = SOLIDS[section]
        out += ["$", "$ edit: " + what]
        out += block("*SECTION_SOLID", "secid elform", section, elform)
    return out


def material_lines(found):
    """A material for each part."""
    out = ["$", "$ edit: density [M/L3], Young modulus [M/(L T2)], Poisson ratio of each part"]
    for p in found.parts:
        out += ["*MAT_ELASTIC_TITLE", p.title, names(TEN, *"mid ro e pr".split())]
        out += [card(TEN, p.id, DENSITY, YOUNG, POISSON)]
    return out


def motion_lines(mesh, gap, count):
    """Initial velocity, the wall, contact where there are several bodies."""
    across, axis = [None] * (mesh.dim - 1), mesh.x[:, mesh.dim - 1]
    low, high = axis.min(), axis.max()
    wall, ahead = float(low - gap), float("%.6g" % (high - low))
    out = ["$", "$ edit: all nodes fly down; nsid: a node set of the mesh instead of 0"]
    out += block("*INITIAL_VELOCITY", "nsid", 0)
    out += [names(TEN, *"vx vy vz".split()[: mesh.dim])]
    out += [card(TEN, *[0.0] * (mesh.dim - 1), "-&v0")]
    points = "(xt, yt)", "(xh, yh)"
    if mesh.dim == 3:
        points = "(xt, yt, zt)", "(xh, yh, zh)"
    out += ["$", "$ edit: the wall, through a point %s, faces a point %s" % points]
    out += block("*RIGIDWALL_PLANAR", "nsid", 0)
    out += [names(TEN, *"xt yt zt xh yh zh fric".split())]
    rest = [None] * (3 - mesh.dim)
    places = across + [wall] + rest + across + [wall + ahead] + rest
    out += [card(TEN, *places, FRICTION)]
    return out + (contact_lines(mesh.dim, count) if count > 1 else [])


def contact_lines(dim, count):
    """Contact of all bodies."""
    out = ["$", "$ edit: contact of all %d bodies, friction fs; surfa: a part set" % count]
    if dim == 2:
        keyword = "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE"
        return out + block(keyword, "surfa surfb sfact freq fs", 0, *[None] * 3, FRICTION)
    out += block("*CONTACT_AUTOMATIC_SINGLE_SURFACE", "surfa", 0)
    return out + [names(TEN, "fs"), card(TEN, FRICTION)]


def example_lines(mesh, found):
    """Cards to take into use."""
    if not found.node_sets:
        return []
    s = found.node_sets[0]
    edit = "$ edit: to hold the nodes of '%s', take the '$ ' off both lines" % s.title
    return ["$", edit, "$ *BOUNDARY_SPC_SET", "$ %d,%s" % (s.id, ",1" * mesh.dim)]


def output_lines(every):
    """Tables of every step, fields for pictures."""
    out = ["$", "$ edit: intervals of the tables [T]; doc/output.md lists all tables"]
    for name in ("GLSTAT", "MATSUM", "RWFORC"):
        out += block("*DATABASE_" + name, "dt", "&dt")
    out += ["$", "$ edit: interval of the fields that scripts/plot_fields.py draws [T]"]
    return out + block("*BIPACT_FIELD", "dt", every)
