"""mesh2deck.py on meshes of solids: what became what in the deck, and what bipact makes of it:
mass, pressure, a bounce. Files of Gmsh: gmsh_tests.py."""

import os
import sys
import warnings

import meshio
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mesh_cases import (
    NODES,
    PARTS,
    SEGMENTS,
    around,
    convert,
    flux,
    headings,
    is_valid,
    named,
    path,
    put,
    refused,
    three,
)

from scenes import at_most, bipact, check, finish, table
from solids import Box

warnings.simplefilter("ignore")
# Kinds of meshio with the form of tests/support, the corners in the order of meshio, and an
# order that turns the element inside out, written by hand.
WEDGE = [0, 4, 1, 3, 6, 2]  # the side 1 2 3 4 with the ridge 5, 6 as two triangles
KINDS = {
    "tetra": ("TET4", range(4), [1, 0, 2, 3]),
    "hexahedron": ("HEX8", range(8), [4, 5, 6, 7, 0, 1, 2, 3]),
    "wedge": ("WEDGE6", WEDGE, [3, 4, 5, 0, 1, 2]),
    "pyramid": ("PYRAMID5", range(5), [1, 0, 3, 2, 4]),
    "tetra10": ("TET10", range(10), [1, 0, 2, 3, 4, 6, 5, 8, 7, 9]),
    "hexahedron27": (
        "HEX27",
        range(27),
        [4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11, 16, 17, 18, 19]
        + [20, 21, 22, 23, 25, 24, 26],
    ),
}
CORNERS = {"tetra10": 4, "hexahedron27": 8}
SIZE = (1.0, 1.5, 0.5)
# Sums of some hundred products of numbers of size 1.
ROUND_OFF = 1.0e-13


# ---------------------------------------------------------------- each kind in each format


def box(kind):
    """A box of 2 x 2 x 2 cells with moved nodes: (places, elements, faces of its boundary by
    corners); every third element is inside out, the first node belongs to none."""
    form, order, back = KINDS[kind]
    # Mid nodes of the boundary stay on it: cells of the box are straight but for those inside.
    made = Box((2, 2, 2), SIZE, form, shift=0.1)
    x = np.vstack([[(9.0, 9.0, 9.0)], made.x])
    elements = 1 + np.array(made.elements)[:, list(order)]
    for k in range(0, len(elements), 3):
        elements[k] = elements[k][back]
    return x, elements, made


def rings(kind):
    """Corners of the faces of an element in the order of meshio."""
    if kind.startswith("tetra"):
        return [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)]
    if kind == "wedge":
        return [(0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 2, 5, 3)]
    if kind == "pyramid":
        return [(0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
    bottom = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4)]
    return bottom + [(1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


def boundary(kind, x, elements):
    """Faces whose corners lie in one plane of the box: {(axis, value): [corners]}."""
    found = {}
    for element in elements:
        for ring in rings(kind):
            face = [element[k] for k in ring]
            for axis in range(3):
                for value in (0.0, SIZE[axis]):
                    if all(abs(x[n, axis] - value) < 1e-12 for n in face):
                        found.setdefault((axis, value), []).append(face)
    return found


def cells_of(kind, elements, faces, top):
    """Cells with the numbers of their groups: 7 the solids, 4 the boundary but 5 its top."""
    cells = [(kind, elements, 7)]
    for of, number in ((faces, 4), (top, 5)):
        for corners, name in ((3, "triangle"), (4, "quad")):
            rows = [f for f in of if len(f) == corners]
            if rows:
                cells.append((name, np.array(rows), number))
    return cells


def write(name, points, cells):
    """Numbers in VTK, sets in Abaqus, families in MED."""
    data = [np.full(len(c), n, dtype=np.int32) for _, c, n in cells]
    blocks = [(k, c) for k, c, _ in cells]
    if name.endswith("med"):  # which has one block of a kind
        names = list(dict.fromkeys(k for k, _ in blocks))
        data = [np.concatenate([d for (k, _), d in zip(blocks, data) if k == n]) for n in names]
        blocks = [(n, np.vstack([c for k, c in blocks if k == n])) for n in names]
        mesh = meshio.Mesh(points, blocks, {}, {"cell_tags": [-d for d in data]})
        mesh.point_data["point_tags"] = np.zeros(len(points), dtype=int)
        mesh.cell_tags = {-n: ["part %d" % n] for _, _, n in cells}
        mesh.point_tags = {}
    elif name.endswith("inp"):
        mesh = meshio.Mesh(points, blocks)
        for wanted in sorted({n for _, _, n in cells}):
            chosen = [np.arange(len(c)) if n == wanted else [] for _, c, n in cells]
            mesh.cell_sets["part %d" % wanted] = [np.array(c, dtype=int) for c in chosen]
    else:
        mesh = meshio.Mesh(points, blocks, cell_data={"part": data})
    meshio.write(path(name), mesh)


def each_kind():
    """All of a mesh is found again in the deck, whatever kind, whatever format."""
    unknown = {("pyramid", "inp"), ("hexahedron27", "inp"), ("hexahedron27", "med")}
    for kind in KINDS:
        x, elements, made = box(kind)
        planes = boundary(kind, x, elements)
        top = planes.pop((2, SIZE[2]))
        rest = [f for faces in planes.values() for f in faces]
        for ending in ("vtk", "vtu", "inp", "med"):
            if (kind, ending) in unknown:
                continue  # meshio does not write it
            name = "%s.%s" % (kind, ending)
            write(name, x, cells_of(kind, elements, rest, top))
            deck, out = convert(path(name))
            for text in (
                "nodes without element left out: 1",
                "negative volume turned: %d" % len(range(0, len(elements), 3)),
                'part 7": %d elements, volume 0.75' % len(elements),
            ):
                check(text in out, "%s: no '%s' in %s" % (name, text, out))
            compare(name, deck, x, elements, rest, top)
            node_sets = named(deck, NODES)
            on = {tuple(made.x[n]) for n in made.boundary()}
            both = node_sets["part 4"] + node_sets["part 5"]
            check({deck.points()[n] for n in both} == on, name + ": nodes, mid nodes too")
            pressed(name, out)


def compare(name, deck, x, elements, rest, top):
    """Every digit of the nodes, every element by its places, faces by theirs, outward."""
    at = [tuple(p) for p in x.tolist()]
    points, parts = deck.points(), headings(deck)
    check(sorted(points.values()) == sorted(at[1:]), name + ": coordinates")
    check(set(parts) == {"part 7"}, "%s: parts %s" % (name, parts))
    found = {frozenset(points[n] for n in c): p for p, c in deck.solids().values()}
    wanted = {frozenset(at[n] for n in e): parts["part 7"] for e in elements}
    check(found == wanted, name + ": elements")
    sets = named(deck, SEGMENTS)
    check(set(sets) == {"part 4", "part 5"}, "%s: segments %s" % (name, sorted(sets)))
    segments = {title: three(sets[title]) for title in sets}
    for title, faces in (("part 4", rest), ("part 5", top)):
        one = sorted(sorted(points[n] for n in s) for s in segments[title])
        two = sorted(sorted(at[n] for n in f) for f in faces)
        check(one == two, "%s: faces of %s" % (name, title))
    volume = flux(deck, segments["part 4"] + segments["part 5"]) / 3.0
    at_most(abs(volume / 0.75 - 1.0), ROUND_OFF, name + ": volume of the faces - 1")
    check(named(deck, PARTS) == {"part 7": [parts["part 7"]]}, name + ": part sets")


def pressed(name, out):
    """The deck runs; mass = volume; pressure p on the top for 1 s gives the impulse p A down."""
    number = next(
        line.split()[2]
        for line in out.split("\n")
        if "segment set" in line and '"part 5"' in line
    )
    load = ["*DEFINE_CURVE", "1", "0.0,0.003", "9.0,0.003", "*LOAD_SEGMENT_SET", number + ",1"]
    load += ["*DATABASE_GLSTAT", "0.1,", "*DATABASE_MATSUM", "0.1,"]
    code, errors, _ = bipact(around("out.k", *load), path("main"))
    check(code == 0 and not errors, "%s: exit %d: %s" % (name, code, errors))
    energy, mass = table(path("main"), "glstat"), table(path("main"), "matsum")["mass"]
    at_most(abs(mass[0] / 0.75 - 1.0), ROUND_OFF, name + ": mass / volume - 1")
    # Ten steps, each a solve to round-off of some hundred unknowns.
    at_most(abs(energy["momz"][-1] / -4.5e-3 - 1.0), 1e-12, name + ": impulse / p A t - 1")


# ---------------------------------------------------------------- shapes

CUBE = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"


def repeated():
    """Hexahedra and wedges with repeated nodes are what their different nodes make."""
    for corners, cards, volume in (
        ("1,2,3,3,5,6,7,7", 6, "0.5"),  # a wedge upright, one lying, pyramids, tetrahedra
        ("1,2,3,4,5,5,8,8", 6, "0.5"),
        ("1,2,3,4,5,5,5,5", 5, "0.333333"),
        ("5,5,5,5,1,4,3,2", 5, "0.333333"),
        ("1,2,3,3,5,5,5,5", 4, "0.166667"),
        ("1,1,2,3,5,5,5,5", 4, "0.166667"),
    ):
        deck, out = convert(put("r.inp", CUBE + "*ELEMENT,TYPE=C3D8R\n9,%s\n" % corners))
        nodes = deck.solids()[9][1]
        check(len(set(nodes)) == cards, "%s becomes %s" % (corners, nodes))
        check("volume %s\n" % volume in out and "repeated nodes" in out, corners + ": " + out)
        is_valid()
    deck, out = convert(put("r.inp", CUBE + "*ELEMENT,TYPE=C3D6\n9,1,2,3,1,6,7\n"))
    check(len(set(deck.solids()[9][1])) == 5 and "volume 0.333333\n" in out, "wedge: " + out)
    is_valid()
    for kind, corners in (
        ("C3D8", "1,2,2,1,5,6,6,5"),
        ("C3D8", "1,2,3,1,5,6,7,8"),
        ("C3D4", "1,2,3,3"),
        ("C3D10", "1,2,3,5,6,7,8,4,4,1"),
    ):
        text = CUBE + "*ELEMENT,TYPE=%s\n7,%s\n" % (kind, corners)
        refused(put("r.inp", text), "element 7, a ", "has a node twice")


def invalid():
    """Volume 0, elements that fold; elements that stand twice."""
    for kind, corners in (
        ("C3D4", "1,2,3,4"),  # flat
        ("C3D8", "1,2,3,4,5,6,8,7"),  # twisted
        ("C3D6", "1,2,3,5,7,6"),
        ("C3D5", "1,3,2,4,5"),
    ):
        text = CUBE + "*ELEMENT,TYPE=%s\n7,%s\n" % (kind, corners)
        refused(put("i.inp", text), "element 7: volume 0, or faces that cross")
    text = "*ELEMENT,TYPE=C3D8\n3,1,2,3,4,5,6,7,8\n4,5,6,7,8,1,2,3,4\n"
    deck, out = convert(put("i.inp", CUBE + text))
    check(list(deck.solids()) == [3] and "twice in the file: 1" in out, "one of two: " + out)


def kinds():
    """Serendipity elements and unknown ones are named, with the way out."""
    points = np.random.default_rng(1).random((20, 3))
    head = "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 20 double\n"
    head += "".join("%r %r %r\n" % tuple(p) for p in points.tolist())
    for kind, many, number in (
        ("hexahedron20", 20, 25),
        ("wedge15", 15, 26),
        ("pyramid13", 13, 27),
    ):
        row = "%d " % many + " ".join(str(k) for k in range(many))
        text = "CELLS 1 %d\n%s\nCELL_TYPES 1\n%d\n" % (many + 1, row, number)
        refused(put("k.vtk", head + text), "type " + kind, "linear elements", "with 27")
        text = "CELLS 2 %d\n%s\n4 0 1 2 3\nCELL_TYPES 2\n%d\n10\n" % (many + 6, row, number)
        refused(put("k.vtk", head + text), "type " + kind, "hexahedra with 27")
    nodes = "*NODE\n" + "".join(
        "%d,%r,%r,%r\n" % (k + 1, *p) for k, p in enumerate(points.tolist())
    )
    for kind, many in (("C3D20R", 20), ("C3D15", 15), ("C3D13", 13)):
        ids = ",".join(str(k + 1) for k in range(many))
        half = ids[: ids.index("9,")] + "\n" + ids[ids.index("9,") :]
        text = nodes + "*ELEMENT,TYPE=%s\n1,%s\n" % (kind, half)
        refused(put("k.inp", text), "1 of type " + kind, "linear elements", "with 27")


# ---------------------------------------------------------------- a mesh of all linear kinds

# A cube, a pyramid on it, a tetrahedron beside that, a wedge beside the cube.
MIXED = CUBE + """9,.5,.5,2
10,1.5,.5,1.6
11,2,0,0
12,2,1,0
*ELEMENT,TYPE=C3D8I,ELSET=body
1,1,2,3,4,5,6,7,8
*ELEMENT,TYPE=C3D5,ELSET=body
2,5,6,7,8,9
*ELEMENT,TYPE=C3D4,ELSET=body
3,6,10,7,9
*ELEMENT,TYPE=C3D6,ELSET=body
4,2,11,6,3,12,7
*ELEMENT,TYPE=S4,ELSET=inside
11,5,6,7,8
12,1,2,6,5
*ELEMENT,TYPE=T3D2,ELSET=edge
21,1,2
22,2,11
*NSET,NSET=point
9,
"""


def mixed():
    """One part of four kinds; faces between elements, lines, points are node sets."""
    deck, out = convert(put("m.inp", MIXED))
    check(headings(deck) == {"body": 1}, "one part: " + out)
    first = "12 nodes, 1 tetrahedron, 1 pyramid, 1 wedge, 1 hexahedron\n"
    check(first in out, "kinds: " + out)
    check('surfaces of "inside" between elements, so no segments: nodes alone: 1' in out, out)
    sets = named(deck, NODES)
    check(sets["inside"] == [1, 2, 5, 6, 7, 8], "inner and outer: %s" % sets)
    check(sets["edge"] == [1, 2, 11] and sets["point"] == [9], "lines, points: %s" % sets)
    segments = three(named(deck, SEGMENTS)["inside"])
    check([sorted(s) for s in segments] == [[1, 2, 5, 6]], "the outer one: %s" % segments)
    is_valid()
    shell = (
        "*ELEMENT,TYPE=S3,ELSET=skin\n31,1,2,7\n*ELEMENT,TYPE=S4,ELSET=far\n32,13,14,15,16\n"
    )
    far = "13,7,7,7\n14,8,7,7\n15,8,8,7\n16,7,8,7\n"
    text = MIXED.replace("12,2,1,0\n", "12,2,1,0\n" + far) + shell
    deck, out = convert(put("m.inp", text))
    check("surface elements on no solid left out: 1" in out, "a shell alone: " + out)
    check('"far" left out: its surfaces are on no element' in out, "far: " + out)
    check("no faces of elements: nodes alone: 1" in out, "a shell inside: " + out)
    check(named(deck, NODES)["skin"] == [1, 2, 7] and "skin" not in named(deck, SEGMENTS), out)
    is_valid()


def forms():
    """Linear and quadratic solids in one group become two parts of its set."""
    two, ten = Box((1, 1, 1)), Box((1, 1, 1), form="TET10", origin=(0.0, 0.0, 2.0))
    cells = [("hexahedron", np.array(two.elements))]
    cells.append(("tetra10", len(two.x) + np.array(ten.elements)))
    data = {"part": [np.full(len(c), 3) for _, c in cells]}
    meshio.write(path("f.vtu"), meshio.Mesh(np.vstack([two.x, ten.x]), cells, cell_data=data))
    deck, out = convert(path("f.vtu"))
    parts = headings(deck)
    check(set(parts) == {"part 3, linear", "part 3, 10 nodes"}, "two parts: " + out)
    check(named(deck, PARTS)["part 3"] == sorted(parts.values()), "their set: " + out)
    sections = {title: s for title, s, _ in deck.parts().values()}
    check(sections == {"part 3, linear": 1, "part 3, 10 nodes": 16}, "sections: %s" % sections)
    is_valid()


# ---------------------------------------------------------------- Abaqus by hand

# Elements in a unit cube and the planes of their faces S1, S2, ... by a coordinate that is
# constant there (axis, value); None: the one that is slanted.
FACES = {
    "C3D8": ("1,2,3,4,5,6,7,8", [(2, 0), (2, 1), (1, 0), (0, 1), (1, 1), (0, 0)], 1.0),
    "C3D6": ("1,2,4,5,6,8", [(2, 0), (2, 1), (1, 0), None, (0, 0)], 0.5),
    "C3D4": ("1,2,4,5", [(2, 0), (1, 0), None, (0, 0)], 1.0 / 6.0),
    "C3D5": ("1,2,3,4,5", [(2, 0), (1, 0), None, None, (0, 0)], 1.0 / 3.0),
}
# Places of the nodes of C3D27 as Abaqus counts them: the centre is 21, then faces S1 to S6.
EDGES = [(1, 2), (2, 3), (3, 4), (4, 1), (5, 6), (6, 7), (7, 8), (8, 5)]
EDGES += [(1, 5), (2, 6), (3, 7), (4, 8), range(1, 9)]
EDGES += [(1, 2, 3, 4), (5, 8, 7, 6), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 8, 4), (4, 8, 5, 1)]


def surfaces():
    """*SURFACE by faces of each kind; all of them close the element."""
    for kind, (nodes, planes, volume) in FACES.items():
        text = CUBE + "*ELEMENT,TYPE=%s,ELSET=e\n1,%s\n" % (kind, nodes)
        for k in range(len(planes)):
            text += "*SURFACE,NAME=s%d\n1,S%d\n" % (k + 1, k + 1)
        text += "*SURFACE,NAME=all\n" + "".join("e,S%d\n" % (k + 1) for k in range(len(planes)))
        deck, out = convert(put("s.inp", text))
        sets, points = named(deck, SEGMENTS), deck.points()
        for k, plane in enumerate(planes):
            at = np.array([points[n] for n in sets["s%d" % (k + 1)]])
            flat = {(a, int(v)) for a in range(3) for v in (0, 1) if (at[:, a] == v).all()}
            check(flat == ({plane} if plane else set()), "%s S%d: %s" % (kind, k + 1, flat))
        apart = abs(flux(deck, three(sets["all"])) / (3.0 * volume) - 1.0)
        at_most(apart, ROUND_OFF, kind + ": all faces close it")
        text += "*SURFACE,NAME=x\n1,S%d\n" % (len(planes) + 1)
        if len(planes) < 6:
            refused(put("s.inp", text), "no face S%d" % (len(planes) + 1))
    at = {
        k: np.array(p.split(",")[1:], dtype=float)
        for k, p in enumerate(CUBE.split("\n")[1:9], 1)
    }
    text = CUBE
    for k, of in enumerate(EDGES):
        text += "%d,%r,%r,%r\n" % (9 + k, *np.mean([at[n] for n in of], axis=0).tolist())
    ids = [str(k) for k in range(1, 28)]
    text += "*ELEMENT,TYPE=C3D27\n1," + ",".join(ids[:15]) + ",\n" + ",".join(ids[15:]) + "\n"
    deck, out = convert(put("s.inp", text + "*SURFACE,NAME=top\n1,S2\n"))
    check("order" not in out and "volume 1\n" in out, "27 nodes: " + out)
    top = {n for n, p in deck.points().items() if p[2] == 1.0}
    check(set(named(deck, NODES)["top"]) == top and len(top) == 9, "nine nodes of a face")
    is_valid()
    swapped = text.replace(",9,10,", ",10,9,")
    deck, out = convert(put("s.inp", swapped + "*SURFACE,NAME=top\n1,S2\n"))
    check("mid nodes have another order: 1" in out and "volume 1\n" in out, "order: " + out)
    code, errors, told = bipact(around("out.k"), path("main"), "--check")
    check(code == 0 and "another order" not in told + errors, "bipact: " + told + errors)


# ---------------------------------------------------------------- scenes


def scenes():
    """OUT_scene.k runs as it is, and its energy is m v^2/2."""
    for kind in KINDS:
        x, elements, _ = box(kind)
        meshio.write(path("scene_%s.vtu" % kind), meshio.Mesh(x, [(kind, elements)]))
        bounces("scene_%s.vtu" % kind, 0.75)
    x, elements, _ = box("hexahedron")
    for name, points in (("small", 1.0e-6 * x), ("far", x + np.array([1.0e3, -1.0e3, 1.0e3]))):
        meshio.write(path(name + ".vtu"), meshio.Mesh(points, [("hexahedron", elements)]))
        bounces(name + ".vtu", 0.75 * (1.0e-18 if name == "small" else 1.0))
    put("mixed.inp", MIXED)
    bounces("mixed.inp", 1.0 + 1.0 / 3.0 + 0.8 / 6.0 + 0.5)
    two, ten = Box((2, 2, 2)), Box((2, 2, 2), form="TET10", origin=(0.3, 0.2, 1.001))
    both = [("hexahedron", np.array(two.elements))]
    both.append(("tetra10", len(two.x) + np.array(ten.elements)))
    meshio.write(path("two.vtu"), meshio.Mesh(np.vstack([two.x, ten.x]), both))
    bounces("two.vtu", 2.0, bodies=2)


def bounces(name, volume, bodies=1):
    stem = name.split(".")[0]
    _, out = convert(path(name), "--scene", deck=stem + ".k")
    folder = path(stem)
    code, errors, told = bipact(path(stem + "_scene.k"), folder)
    check(code == 0 and not errors, "%s: exit %d: %s%s" % (name, code, errors, told))
    with open(path(stem + "_scene.k")) as file:
        contact = "CONTACT_AUTOMATIC_SINGLE_SURFACE" in file.read()
    check(contact == (bodies > 1), name + ": contact where there are two bodies")
    energy = table(folder, "glstat")
    kinetic = 0.5 * 0.001 * volume * 4.0**2
    # Sums of some thousand products, a place up to 1e3 from the origin.
    at_most(abs(energy["kinetic"][0] / kinetic - 1.0), 1e-12, name + ": energy / m v^2/2 - 1")
    check(energy.status == "done", name + ": " + energy.status)
    at_most(energy["total"].max() / energy["total"][0] - 1.0, 1e-12, name + ": growth")
    # Of energies: what solves of some thousand operations leave.
    at_most(np.abs(energy["residual"]).max(), 1e-12, name + ": ledger residual")
    check(table(folder, "rwforc")["fn"].max() > 0.0, name + ": it meets the wall")
    check(energy["momz"][-1] > 0.0 or bodies > 1, name + ": it flies up again at the end")


for test in (each_kind, repeated, invalid, kinds, mixed, forms, surfaces, scenes):
    test()
finish()
