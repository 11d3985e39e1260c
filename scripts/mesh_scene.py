"""A small main deck for a mesh: its bodies fly down at a rigid wall and bounce. Lines that
begin with '$ edit' say what to change for a scene of one's own."""

import math
from decimal import Decimal

import numpy as np

from cards import TEN, block, card, heading, names, parameter_lines

YOUNG, DENSITY, POISSON, FRICTION = 1000.0, 0.001, 0.3, 0.2  # [F L-2], [M L-3], -, -
SPEED = math.sqrt(YOUNG / DENSITY)  # of waves in a bar [L T-1]
STEEP = 250  # bodies fly SPEED/STEEP: they turn by less than 5 degrees before the end
FLIGHT = 10  # steps before the touch
CROSSINGS = 5  # of the largest body by a wave, from the touch to the end: beyond the bounce
FRAMES = 50


def times(mesh, parted):
    """Step, end, interval of fields [T], of few digits; gap [L]."""
    a, b = mesh.x[mesh.corners, :2], mesh.x[np.roll(mesh.corners, -1, axis=1), :2]
    edges = np.hypot(*np.moveaxis(b - a, 2, 0))
    edge = float(np.median(edges[edges > 0.0]))
    dt = Decimal("%.1e" % (0.5 * edge / SPEED))  # a wave crosses half an edge in a step
    size = max(float(np.ptp(mesh.x[rows, :2], axis=0).max()) for rows in parted)
    steps = FLIGHT + CROSSINGS * size / SPEED / float(dt)
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

    for corners in mesh.corners.tolist():
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
    out += material_lines(found) + motion_lines(mesh, gap, len(parted))
    return out + example_lines(found) + output_lines(every) + ["*END"]


INTRODUCTION = (
    "A scene for a mesh, written by mesh2deck.py --scene. It runs as it is: the bodies fly",
    "down at a rigid wall and bounce. Lines that begin with '$ edit' say what to change.",
    "Units: any consistent set, mass M, length L, time T.",
)


def material_lines(found):
    """One section for all parts, a material for each."""
    out = ["$", "$ edit: elform 13 plane strain, 12 plane stress; t1 thickness [L]"]
    out += block("*SECTION_SHELL", "secid elform shrf nip", 1, 13, None, 4)
    out += [names(TEN, "t1"), card(TEN, 1.0)]
    out += ["$", "$ edit: density [M/L3], Young modulus [M/(L T2)], Poisson ratio of each part"]
    for p in found.parts:
        out += ["*MAT_ELASTIC_TITLE", p.title, names(TEN, *"mid ro e pr".split())]
        out += [card(TEN, p.id, DENSITY, YOUNG, POISSON)]
    return out


def motion_lines(mesh, gap, count):
    """Initial velocity, the wall, contact where there are several bodies."""
    low, high = mesh.x[:, 1].min(), mesh.x[:, 1].max()
    wall, ahead = float(low - gap), float("%.6g" % (high - low))
    out = ["$", "$ edit: all nodes fly down; nsid: a node set of the mesh instead of 0"]
    out += block("*INITIAL_VELOCITY", "nsid", 0)
    out += [names(TEN, "vx", "vy"), card(TEN, 0.0, "-&v0")]
    out += ["$", "$ edit: the wall, through a point (xt, yt), faces a point (xh, yh)"]
    out += block("*RIGIDWALL_PLANAR", "nsid", 0)
    out += [names(TEN, *"xt yt zt xh yh zh fric".split())]
    out += [card(TEN, None, wall, None, None, wall + ahead, None, FRICTION)]
    if count > 1:
        out += ["$", "$ edit: contact of all %d bodies, friction fs; surfa: a part set" % count]
        keyword = "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE"
        out += block(keyword, "surfa surfb sfact freq fs", 0, None, None, None, FRICTION)
    return out


def example_lines(found):
    """Cards to take into use."""
    if not found.node_sets:
        return []
    s = found.node_sets[0]
    edit = "$ edit: to hold the nodes of '%s', take the '$ ' off both lines" % s.title
    return ["$", edit, "$ *BOUNDARY_SPC_SET", "$ %d,,1,1" % s.id]


def output_lines(every):
    """Tables of every step, fields for pictures."""
    out = ["$", "$ edit: intervals of the tables [T]; doc/output.md lists all tables"]
    for name in ("GLSTAT", "MATSUM", "RWFORC"):
        out += block("*DATABASE_" + name, "dt", "&dt")
    out += ["$", "$ edit: interval of the fields that scripts/plot_fields.py draws [T]"]
    return out + block("*BIPACT_FIELD", "dt", every)
