"""Kinds of cells of a mesh: nodes, sides, and the order of nodes on the cards of a deck."""

from types import SimpleNamespace

from solid_forms import HEX_FACES, HEX_MIDDLES, TET_MIDDLES

HEXAHEDRON = [tuple(face) for face in HEX_FACES.tolist()]
TETRAHEDRON = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
WEDGE = [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
PYRAMID = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
LINEAR, TEN_NODES, TWENTY_SEVEN = 1, 16, 24  # sections of solids, of the number of their ELFORM
SOLIDS_TAKEN = (
    "It takes tetrahedra with 4 or 10 nodes, hexahedra with 8 or 27, wedges with 6, pyramids with "
    "5: mesh with linear elements (gmsh -3 -order 1), tetrahedra with 10 nodes or hexahedra with 27"
)


def shape(dim, corners, sides=(), middles=(), nodes=None, card=None, back=None, section=0):
    """dim; corners, nodes: how many; sides: corners of each edge of a plane element, of each
    face of a solid turned outward; middles: corners between which the other nodes lie; card:
    nodes on the card; back: the corners of the element turned over; section: of its part."""
    return SimpleNamespace(
        dim=dim,
        corners=corners,
        nodes=nodes or corners + len(middles),
        sides=[tuple(s) for s in sides],
        middles=[tuple(m) for m in middles],
        card=card or list(range(corners + len(middles))),
        back=back,
        section=section,
    )


TURNED = {4: [0, 2, 1, 3], 5: [0, 3, 2, 1, 4], 6: [0, 2, 1, 3, 5, 4]}
TURNED[8] = [0, 3, 2, 1, 4, 7, 6, 5]


def solid(corners, faces, card=None, middles=(), section=LINEAR):
    back = TURNED[corners]
    return shape(3, corners, faces, middles, card=card, back=back, section=section)


SHAPES = {
    "vertex": shape(0, 1),
    "line": shape(1, 2),
    "line3": shape(1, 2, nodes=3),
    "triangle": shape(2, 3, [(0, 1), (1, 2), (2, 0)]),
    "triangle6": shape(2, 3, nodes=6),
    "quad": shape(2, 4, [(0, 1), (1, 2), (2, 3), (3, 0)]),
    "quad8": shape(2, 4, nodes=8),
    "quad9": shape(2, 4, nodes=9),
    "tetra": solid(4, TETRAHEDRON, [0, 1, 2, 3, 3, 3, 3, 3]),
    "pyramid": solid(5, PYRAMID, [0, 1, 2, 3, 4, 4, 4, 4]),
    "wedge": solid(6, WEDGE, [0, 2, 5, 3, 1, 1, 4, 4]),  # a side, and the ridge opposite
    "hexahedron": solid(8, HEXAHEDRON),
    "tetra10": solid(4, TETRAHEDRON, middles=TET_MIDDLES, section=TEN_NODES),
    "hexahedron27": solid(8, HEXAHEDRON, middles=HEX_MIDDLES, section=TWENTY_SEVEN),
}
KINDS = list(SHAPES)  # a cell's kind is a number of this list
WIDEST = 27
QUADRATIC = [k for k, s in SHAPES.items() if s.dim < 3 and s.nodes > s.corners]  # no element
SINGULAR = {"tetra": "tetrahedron", "tetra10": "10-node tetrahedron", "quad": "quadrilateral"}
SINGULAR["hexahedron27"] = "27-node hexahedron"


def dimension(kind):
    """0 to 3; of an unknown kind None."""
    return SHAPES[kind].dim if kind in SHAPES else None


def counted(number, kind):
    """'1 tetrahedron', '3 wedges'."""
    name = SINGULAR.get(kind, kind)
    plural = name[:-2] + "a" if name.endswith("hedron") else name + "s"
    return "%d %s" % (number, name if number == 1 else plural)


def all_of_side(kind, side):
    """The nodes of a side, corners first: those between its corners too."""
    of = SHAPES[kind]
    between = [k for k, m in enumerate(of.middles) if set(m) <= set(side)]
    return list(side) + [of.corners + k for k in between]


def turned_over(kind):
    """The nodes of the element in the order that turns it inside out."""
    of = SHAPES[kind]
    middles = [frozenset(m) for m in of.middles]
    moved = [middles.index(frozenset(of.back[c] for c in m)) for m in of.middles]
    return of.back + [of.corners + k for k in moved]
