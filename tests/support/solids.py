"""Meshes in space and decks around them: boxes of hexahedra, wedges, pyramids or tetrahedra, with
nodes moved at random."""

import itertools
import random

import numpy as np
import solid_forms
from solid_forms import HEX_FACES, split, wedges, with_middles

# ELFORM of each form of element.
FORMS = {
    "HEX8": 1, "HEX8MEAN": 2, "HEX8MODE": -1, "WEDGE6": 15, "PYRAMID5": 1, "TET4": 10,
    "TET10": 16, "HEX27": 24,
}


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
                self.elements += wedges([cell])
            elif form == "PYRAMID5":
                x.append(list(np.mean([x[n] for n in cell], axis=0)))
                for face in HEX_FACES:
                    base = [cell[n] for n in face[::-1]]
                    self.elements.append(base + 4 * [len(x) - 1])
            elif form in ("TET4", "TET10"):
                self.elements += split([cell])
            else:
                self.elements.append(cell)
        if form in ("TET10", "HEX27"):
            at, elements = with_middles([list(p) for p in grid], self.elements)
            x, self.elements = with_middles(x, elements=self.elements)
            grid.update({tuple(at[k]): k for k in range(len(grid), len(at))})
        self.x = np.array(x)

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
    """*NODE and *ELEMENT_SOLID or what the elements need; ids from `first` on. two: the form of
    two cards."""
    lines = ["*NODE"] + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(x)]
    if not two or len(elements[0]) > 8:
        return lines + solid_forms.cards(elements, part, first, first)
    lines.append("*ELEMENT_SOLID (ten nodes format)")
    for e, nodes in enumerate(elements):
        lines += ["%d,%d" % (first + e, part), ",".join(str(first + n) for n in nodes)]
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
