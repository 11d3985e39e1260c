"""Meshes turned about the y axis and decks around them: x is the radius."""

import random

import numpy as np


class Mesh:
    """nr x nz cells between two radii and two heights, quadrilaterals or two triangles each; x (n,
    2), elements as rows of x. shift: how far nodes inside are moved at random, in parts of a
    cell. shape: a function of (r, z) that the grid goes through."""

    def __init__(self, cells, radii=(0.0, 1.0), heights=(0.0, 1.0), triangles=False, shift=0.0,
                 seed=1, shape=None):
        nr, nz = cells
        chance = random.Random(seed)
        self.x, self.elements = [], []
        for j in range(nz + 1):
            for i in range(nr + 1):
                s, t = float(i), float(j)
                if 0 < i < nr and 0 < j < nz:
                    s += shift * chance.uniform(-1.0, 1.0)
                    t += shift * chance.uniform(-1.0, 1.0)
                p = (
                    radii[0] + (radii[1] - radii[0]) * s / nr,
                    heights[0] + (heights[1] - heights[0]) * t / nz,
                )
                self.x.append(shape(*p) if shape else p)
        for j in range(nz):
            for i in range(nr):
                a = j * (nr + 1) + i
                c = [a, a + 1, a + nr + 2, a + nr + 1]
                if not triangles:
                    self.elements.append(c)
                elif (i + j) % 2:
                    self.elements += [[c[0], c[1], c[2]], [c[0], c[2], c[3]]]
                else:
                    self.elements += [[c[0], c[1], c[3]], [c[1], c[2], c[3]]]
        self.x = np.array(self.x)
        self.cells = cells

    def row(self, i, j):
        """The node at corner (i, j) of the grid."""
        return j * (self.cells[0] + 1) + i

    def bottom(self):
        return [self.row(i, 0) for i in range(self.cells[0] + 1)]

    def top(self):
        return [self.row(i, self.cells[1]) for i in range(self.cells[0] + 1)]

    def inner(self):
        return [self.row(0, j) for j in range(self.cells[1] + 1)]

    def outer(self):
        return [self.row(self.cells[0], j) for j in range(self.cells[1] + 1)]

    def boundary(self):
        return sorted(set(self.bottom() + self.top() + self.inner() + self.outer()))


def ball(n, radius=1.0, centre=0.0, triangles=False):
    """A half disc of n x 2n cells: a solid sphere."""
    def shape(s, t):
        return (radius * s * np.sqrt(1.0 - 0.5 * t * t),
                centre + radius * t * np.sqrt(1.0 - 0.5 * s * s))

    return Mesh((n, 2 * n), (0.0, 1.0), (-1.0, 1.0), triangles=triangles, shape=shape)


def mesh_cards(mesh, part=1, first=1):
    """*NODE and *ELEMENT_SHELL; ids from `first` on."""
    lines = ["*NODE"] + ["%d,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(mesh.x)]
    lines.append("*ELEMENT_SHELL")
    for e, nodes in enumerate(mesh.elements):
        corners = list(nodes) + nodes[-1:] * (4 - len(nodes))
        lines.append("%d,%d,%s" % (first + e, part, ",".join(str(first + n) for n in corners)))
    return lines


def part_cards(number=1, form=15, material=1):
    """*PART with its *SECTION_SHELL."""
    return ["*PART", "part", "%d,%d,%d" % (number, number, material),
            "*SECTION_SHELL", "%d,%d" % (number, form), "1.0"]


def elastic(number=1, young=1000.0, poisson=0.3, density=1.0e-3):
    return ["*MAT_ELASTIC", "%d,%r,%r,%r" % (number, density, young, poisson)]


def node_set(number, rows, first=1):
    ids = [str(first + r) for r in rows]
    lines = [",".join(ids[k:k + 8]) + "," for k in range(0, len(ids), 8)]
    return ["*SET_NODE_LIST", "%d," % number] + lines


def curve(number, *points):
    return ["*DEFINE_CURVE", "%d," % number] + ["%r,%r" % p for p in points]


def pressed(rows, first=1, number=1, factor=1.0):
    """*LOAD_SEGMENT on a line of nodes by a curve."""
    return ["*LOAD_SEGMENT"] + [
        "%d,%r,,%d,%d" % (number, factor, first + a, first + b) for a, b in zip(rows, rows[1:])
    ]


def flight(number=1, vy=0.0, vx=0.0):
    """*INITIAL_VELOCITY of a node set."""
    return ["*INITIAL_VELOCITY", "%d," % number, "%r,%r" % (vx, vy)]


def deck(lines, dt, tend, scheme="THETA,0.5,0.5", mass="CONSISTENT,0", tables=("GLSTAT", "MATSUM"),
         every=None, static=False, finite=False):
    """A whole deck around mesh and loads."""
    out = ["*KEYWORD", "*TITLE", "around an axis", "*CONTROL_TERMINATION", "%r," % tend]
    out += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % dt if dt else "1,"]
    out += ["*CONTROL_IMPLICIT_DYNAMICS"]
    if finite:
        out[-1:] = ["*CONTROL_IMPLICIT_SOLUTION", "12,"] + out[-1:]
    out += ["0,"] if static else ["1,", "*BIPACT_TIME", scheme + ",", "*BIPACT_MASS", mass + ","]
    out += list(lines)
    for name in tables:
        out += ["*DATABASE_" + name, "%r," % (every or dt)]
    return "\n".join(out + ["*END", ""])
