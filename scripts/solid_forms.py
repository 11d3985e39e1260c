"""Other solids from meshes of hexahedra: tetrahedra, wedges, and nodes between corners for
quadratic elements. Elements are rows of places, as cards name them."""

import itertools

import startup  # noqa: F401  before what is no part of Python
import numpy as np

HEX_FACES = np.array(
    [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]]
)
# Corners between which the other nodes of a quadratic element lie.
TET_MIDDLES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
HEX_MIDDLES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
HEX_MIDDLES += [
    (0, 4),
    (1, 5),
    (2, 6),
    (3, 7),
    *map(tuple, HEX_FACES.tolist()),
    tuple(range(8)),
]
CORNER = {
    (0, 0, 0): 0,
    (1, 0, 0): 1,
    (1, 1, 0): 2,
    (0, 1, 0): 3,
    (0, 0, 1): 4,
    (1, 0, 1): 5,
    (1, 1, 1): 6,
    (0, 1, 1): 7,
}


def split(elements):
    """Six tetrahedra around one diagonal of each hexahedron: one for each way along its edges."""
    out = []
    for h in elements:
        for order in itertools.permutations(range(3)):
            at, path = [0, 0, 0], [0]
            for d in order:
                at[d] = 1
                path.append(CORNER[tuple(at)])
            a, b, c, d = (h[k] for k in path)
            if order in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
                out.append([a, b, c] + 5 * [d])
            else:
                out.append([a, c, b] + 5 * [d])
    return out


def wedges(elements):
    """Two wedges of each hexahedron."""
    out = []
    for h in elements:
        out.append([h[0], h[1], h[2], h[3], h[5], h[5], h[6], h[6]])
        out.append([h[0], h[5], h[6], h[3], h[4], h[4], h[7], h[7]])
    return out


def with_middles(x, elements):
    """Quadratic elements of tetrahedra or hexahedra: (places with those between the corners,
    elements of 10 or 27)."""
    tetrahedra = elements[0][3] == elements[0][4]
    corners, middles = (4, TET_MIDDLES) if tetrahedra else (8, HEX_MIDDLES)
    x, number, out = list(map(np.array, x)), {}, []
    for element in elements:
        nodes = list(element[:corners])
        for of in middles:
            between = tuple(sorted(nodes[k] for k in of))
            if between not in number:
                number[between] = len(x)
                x.append(np.mean([x[n] for n in between], axis=0))
            nodes.append(number[between])
        out.append(nodes)
    return np.array(x), out


def cards(elements, part, first_node=1, first=1):
    """Lines of elements of any kind, after their keyword."""
    if len(elements[0]) == 27:
        out = ["*ELEMENT_SOLID_H27"]
    elif len(elements[0]) == 10:
        out = ["*ELEMENT_SOLID (ten nodes format)"]
    else:
        out = ["*ELEMENT_SOLID"]
    for k, element in enumerate(elements):
        ids = [str(first_node + n) for n in element]
        if len(ids) == 8:
            out.append(",".join(["%d,%d" % (first + k, part)] + ids))
        else:
            out.append("%d,%d" % (first + k, part))
            out += [",".join(ids[m : m + 10]) for m in range(0, len(ids), 10)]
    return out
