"""Meshes in space and decks around them: boxes of hexahedra, wedges, pyramids or tetrahedra, with
nodes moved at random."""

import itertools
import random

import numpy as np

HEX_FACES = np.array(
    [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
)
# ELFORM of each form of element.
FORMS = {
    "HEX8": 1, "HEX8MEAN": 2, "HEX8MODE": -1, "WEDGE6": 15, "PYRAMID5": 1, "TET4": 10,
    "TET10": 16, "HEX27": 24,
}
# Corners between which the other nodes of a quadratic element lie.
TET_MIDDLES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
HEX_MIDDLES = [
    (0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7),
    *map(tuple, HEX_FACES.tolist()), tuple(range(8)),
]


def tetrahedra(cell):
    """Six tetrahedra around the diagonal of a cell: one for each way along its edges."""
    place = {
        (0, 0, 0): 0, (1, 0, 0): 1, (1, 1, 0): 2, (0, 1, 0): 3,
        (0, 0, 1): 4, (1, 0, 1): 5, (1, 1, 1): 6, (0, 1, 1): 7,
    }
    out = []
    for order in itertools.permutations(range(3)):
        at, corners = [0, 0, 0], [0]
        for d in order:
            at[d] = 1
            corners.append(place[tuple(at)])
        a, b, c, d = (cell[k] for k in corners)
        even = order in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        out.append([a, b, c, d] if even else [a, c, b, d])
    return [[a, b, c, d, d, d, d, d] for a, b, c, d in out]


class Box:
    """A box of nx x ny x nz cells at `origin`; x (n, 3), elements as eight rows of x. shift: how
    far nodes are moved, in parts of a cell: those inside, with faces=True all; nodes on a plane
    of the box stay there."""

    def __init__(self, cells, size=(1.0, 1.0, 1.0), form="HEX8", shift=0.0, seed=1,
                 origin=(0.0, 0.0, 0.0), free=False):
        self.cells, self.form = cells, form
        chance = random.Random(seed)
        grid, x = {}, []
        for p in itertools.product(*(range(n + 1) for n in cells)):
            move = [shift * chance.uniform(-1.0, 1.0) for _ in range(3)]
            inside = [0 < i < n for i, n in zip(p, cells)]
            move = [m * (free or k) for m, k in zip(move, inside)]
            grid[p] = len(x)
            x.append([o + s * (i + m) / n for o, s, i, m, n in zip(origin, size, p, move, cells)])
        self.grid, self.elements, self.hexahedra = grid, [], []
        for i, j, k in itertools.product(*(range(n) for n in cells)):
            cell = [
                grid[i + a, j + b, k + c]
                for c in (0, 1)
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))
            ]
            self.hexahedra.append(cell)
            if form == "WEDGE6":
                h = cell
                self.elements += [[h[0], h[1], h[2], h[3], h[5], h[5], h[6], h[6]]]
                self.elements += [[h[0], h[5], h[6], h[3], h[4], h[4], h[7], h[7]]]
            elif form == "PYRAMID5":
                x.append(list(np.mean([x[n] for n in cell], axis=0)))
                for face in HEX_FACES:
                    base = [cell[n] for n in face[::-1]]
                    self.elements.append(base + 4 * [len(x) - 1])
            elif form in ("TET4", "TET10"):
                self.elements += tetrahedra(cell)
            else:
                self.elements.append(cell)
        if form in ("TET10", "HEX27"):
            self.add_middles(x, TET_MIDDLES if form == "TET10" else HEX_MIDDLES)
        self.x = np.array(x)

    def add_middles(self, x, middles):
        """The further nodes of quadratic elements, each between its corners."""
        at = {row: np.array(p) for p, row in self.grid.items()}
        corners = 4 if len(middles) == 6 else 8
        for e, element in enumerate(self.elements):
            nodes = list(element[:corners])
            for of in middles:
                p = tuple(sum(at[nodes[k]] for k in of) / len(of))
                if p not in self.grid:
                    self.grid[p] = len(x)
                    x.append(list(np.mean([x[nodes[k]] for k in of], axis=0)))
                nodes.append(self.grid[p])
            self.elements[e] = nodes

    def on(self, axis, value):
        """Rows of the nodes whose coordinate along an axis has a value."""
        return [k for k, p in enumerate(self.x) if abs(p[axis] - value) < 1e-12]

    def boundary(self):
        """Rows of the nodes on the faces of the box."""
        return [
            row
            for p, row in self.grid.items()
            if any(i in (0, n) for i, n in zip(p, self.cells))
        ]


def cards(x, elements, part=1, first=1, two=False):
    """*NODE and *ELEMENT_SOLID; ids from `first` on. two: the form of two cards, which elements
    of ten nodes always have."""
    two = two or len(elements[0]) == 10
    lines = ["*NODE"] + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(x)]
    if len(elements[0]) == 27:
        lines += ["*ELEMENT_SOLID_H27"]
        for e, nodes in enumerate(elements):
            lines.append("%d,%d" % (first + e, part))
            lines += [",".join(str(first + n) for n in nodes[k : k + 10]) for k in (0, 10, 20)]
        return lines
    lines += ["*ELEMENT_SOLID" + (" (ten nodes format)" if two else "")]
    for e, nodes in enumerate(elements):
        lines.append("%d,%d,%s" % (first + e, part, "\n" if two else ""))
        lines[-1] = lines[-1].rstrip("\n") + ",".join(str(first + n) for n in nodes)
        if two:
            lines[-1:] = ["%d,%d" % (first + e, part), ",".join(str(first + n) for n in nodes)]
    return lines


def part(form="HEX8", young=1000.0, poisson=0.3, density=1.0e-3, number=1):
    """*PART, *SECTION_SOLID, *MAT_ELASTIC."""
    return [
        "*PART",
        form,
        "%d,%d,%d" % (number, number, number),
        "*SECTION_SOLID",
        "%d,%d" % (number, FORMS[form]),
        "*MAT_ELASTIC",
        "%d,%r,%r,%r" % (number, density, young, poisson),
    ]


def node_set(number, rows, first=1):
    """*SET_NODE_LIST of rows of nodes."""
    ids = [str(first + r) for r in rows]
    lines = [",".join(ids[k : k + 8]) + "," for k in range(0, len(ids), 8)]
    return ["*SET_NODE_LIST", "%d," % number] + lines


def curve(number, *points):
    """*DEFINE_CURVE."""
    return ["*DEFINE_CURVE", "%d," % number] + ["%r,%r" % p for p in points]


def deck(lines, dt, tend, scheme="THETA,0.5,0.5", mass="CONSISTENT,0", tables=("GLSTAT", "MATSUM"),
         every=None, static=False):
    """A whole deck around mesh and loads."""
    out = ["*KEYWORD", "*TITLE", "in space", "*CONTROL_TERMINATION", "%r," % tend]
    out += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % dt, "*CONTROL_IMPLICIT_DYNAMICS"]
    out += ["0,"] if static else ["1,", "*BIPACT_TIME", scheme + ",", "*BIPACT_MASS", mass + ","]
    out += list(lines)
    for name in tables:
        out += ["*DATABASE_" + name, "%r," % (every or dt)]
    return "\n".join(out + ["*END", ""])
