"""mesh2deck.py on meshes that meshio writes and on Abaqus files written by hand: what became
what, as a reader of the tests finds it in the deck. Files of Gmsh: gmsh_tests.py."""

import contextlib
import io
import os
import subprocess
import sys
import warnings

import meshio
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mesh_cases import (
    NODES,
    PARTS,
    SEGMENTS,
    areas,
    convert,
    headings,
    is_valid,
    named,
    path,
    places,
    put,
    refused,
    run,
)

from scenes import TMP, at_most, bipact, check, finish, table

warnings.simplefilter("ignore")
SMALL = 1.0e-14  # sums of a few products of numbers of size 1


# ---------------------------------------------------------------- one mesh in each format


def two_bodies():
    """Quadrilaterals left, 3 of 6 clockwise, triangles right, 6 of 12, a node of no element,
    the foot of both as lines, the last node as a point. Coordinates need all their digits."""
    source = np.random.default_rng(7)
    points, quads, triangles = [], [], []
    for body, shift in enumerate((0.0, 4.0)):
        first = len(points)
        for i in range(4):
            for j in range(3):
                points.append((shift + i, j) + 0.2 * (source.random(2) - 0.5))
        for i in range(3):
            for j in range(2):
                a = first + 3 * i + j
                ring = [a, a + 3, a + 4, a + 1][:: 1 if (i + j) % 2 else -1]
                if body == 0:
                    quads.append(ring)
                else:
                    triangles += [ring[:3], [ring[0], ring[3], ring[2]]]
    points.insert(5, np.array([9.0, 9.0]))  # in no element
    row = np.arange(len(points) - 1)
    row[5:] += 1
    foot = [[0, 3], [3, 6], [6, 9], [12, 15], [15, 18], [18, 21]]
    kinds = (("triangle", triangles), ("line", foot), ("quad", quads), ("vertex", [[23]]))
    points = np.column_stack([np.array(points), np.zeros(len(points))])
    return points, [(kind, row[np.array(cells)]) for kind, cells in kinds]


NUMBERS = (7, 4, 2, 5)  # of the groups "part 7", ... in the order of the cells


def write_numbers(name, points, cells):
    """VTK: a number for each cell."""
    data = [np.full(len(c), k, dtype=np.int32) for k, (_, c) in zip(NUMBERS, cells)]
    meshio.write(path(name), meshio.Mesh(points, cells, cell_data={"part": data}))


def write_sets(name, points, cells):
    """Abaqus: sets; it knows no cells of one node."""
    mesh = meshio.Mesh(points, cells[:3])
    for k, number in enumerate(NUMBERS[:3]):
        chosen = [np.arange(len(c)) if b == k else [] for b, (_, c) in enumerate(cells[:3])]
        mesh.cell_sets["part %d" % number] = [np.array(c, dtype=int) for c in chosen]
    mesh.point_sets["part %d" % NUMBERS[3]] = cells[3][1].ravel()
    meshio.write(path(name), mesh)


def write_families(name, points, cells):
    """MED: families of cells, negative numbers with names."""
    data = [np.full(len(c), -k) for k, (_, c) in zip(NUMBERS, cells)]
    nodes = np.zeros(len(points), dtype=int)
    mesh = meshio.Mesh(points, cells, {"point_tags": nodes}, {"cell_tags": data})
    mesh.cell_tags = {-k: ["part %d" % k] for k in NUMBERS}
    mesh.point_tags = {}
    meshio.write(path(name), mesh)


def each_format():
    points, cells = two_bodies()
    for name, write in (
        ("a.vtk", write_numbers),
        ("a.vtu", write_numbers),
        ("a.inp", write_sets),
        ("a.med", write_families),
    ):
        write(name, points, cells)
        deck, summary = convert(path(name))
        compare(name, deck, points, cells)
        for text in ("nodes without element left out: 1", "turned counter-clockwise: 9"):
            check(text in summary, "%s: no '%s' in %s" % (name, text, summary))
        is_valid()


def shoelace(ring):
    x, y = np.array(ring).T
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


def compare(name, deck, points, cells):
    """Every digit of the nodes, every element by the places of its corners, all sets."""
    xy = [tuple(p) for p in points[:, :2].tolist()]
    nodes, parts = deck.nodes(), headings(deck)
    check(sorted(nodes.values()) == sorted(xy[:5] + xy[6:]), name + ": coordinates")
    check(set(parts) == {"part 7", "part 2"}, "%s: parts %s" % (name, parts))
    wanted, area = {}, {parts[title]: 0.0 for title in parts}
    for block, title in ((0, "part 7"), (2, "part 2")):
        for ring in cells[block][1].tolist():
            wanted[frozenset(xy[n] for n in ring)] = parts[title]
            area[parts[title]] += abs(shoelace([xy[n] for n in ring]))
    found = {frozenset(nodes[n] for n in c): p for p, c in deck.elements().values()}
    check(found == wanted, name + ": elements")
    for part, sum_of in areas(deck).items():
        check(abs(sum_of - area[part]) <= 10 * SMALL * area[part], name + ": area")
    lines = {frozenset(xy[n] for n in line) for line in cells[1][1].tolist()}
    pairs = named(deck, SEGMENTS)["part 4"]
    found = {frozenset(nodes[n] for n in pairs[k : k + 2]) for k in range(0, len(pairs), 2)}
    check(found == lines, name + ": segments")
    sets = named(deck, NODES)
    check(set(sets) == {"part 4", "part 5"}, "%s: node sets %s" % (name, sorted(sets)))
    check(places(deck, sets["part 4"]) == {p for line in lines for p in line}, name + ": foot")
    check(places(deck, sets["part 5"]) == {xy[cells[3][1][0][0]]}, name + ": point")
    check(named(deck, PARTS) == {t: [p] for t, p in parts.items()}, name + ": part sets")


# ---------------------------------------------------------------- the plane


def plane():
    """z: constant, round-off, not constant, a mesh that stands upright."""
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    quad = [("quad", np.array([[0, 1, 2, 3]]))]

    def mesh(name, *columns, more=None):
        points = np.column_stack(np.broadcast_arrays(*columns))
        points = points if more is None else np.vstack([points, more])
        meshio.write(path(name), meshio.Mesh(points, quad))
        return path(name)

    x, y = square.T
    deck, _ = convert(mesh("z.vtu", x, y, 0.1))
    check([f[3] for f in deck.cards["*NODE"]] == ["0.1"] * 4, "a constant z is written")
    is_valid()
    deck, _ = convert(mesh("z.vtu", x, y, [0.0, 1e-17, -2e-16, 0.0]))
    check(not any(f[3:] and f[3] for f in deck.cards["*NODE"]), "round-off of z is left out")
    is_valid()
    deck, _ = convert(mesh("z.vtu", x, y, 0.0, more=[(0.5, 0.5, 3.0)]))
    check(len(deck.nodes()) == 4, "another z of a node of no element does not matter")
    refused(mesh("z.vtu", x, y, [0.0, 0.0, 0.25, 0.0]), "z is not constant", "0.25 at node 3")
    refused(mesh("z.vtu", x, y, [0.0, 1e-9, 0.0, 0.0]), "z is not constant", "1e-09 at node 2")
    refused(mesh("z.vtu", x, 0.0, y), "z is not constant", "stands across y")
    refused(mesh("z.vtu", x, [0.0, 0.0, np.nan, 1.0], 0.0), "node 3 is not finite")


def kinds():
    """Quadratic elements, pictures of nothing."""
    points = np.random.default_rng(1).random((10, 3))
    for kind, count in (
        ("triangle6", 6),
        ("quad8", 8),
        ("quad9", 9),
        ("line3", 3),
    ):
        cells = [(kind, np.arange(count)[None, :]), ("triangle", np.array([[0, 1, 2]]))]
        meshio.write(path("k.vtu"), meshio.Mesh(points, cells))
        refused(path("k.vtu"), "1 of type " + kind, "linear")
    meshio.write(path("k.vtu"), meshio.Mesh(points, [("line", np.array([[0, 1]]))]))
    refused(path("k.vtu"), "no triangle and no quadrilateral")
    refused(put("k.inp", NINE + "*ELEMENT,TYPE=CPE8R\n1,1,3,9,7,2,6,8,4\n"), "CPE8R", "linear")


def shapes():
    """What is no element, what is one twice, what is a triangle."""
    head = "*NODE\n1,0,0\n2,2,0\n3,2,2\n4,0,2\n5,0.5,0.5\n6,1,0\n*ELEMENT,TYPE=CPS4\n"
    refused(put("s.inp", head + "1,1,3,2,4\n"), "element 1:", "edges that cross")
    refused(put("s.inp", head + "7,1,2,5,4\n"), "element 7:", "inner angle")  # concave at 5
    refused(put("s.inp", head + "7,1,6,2,4\n"), "element 7:", "180 degrees")
    refused(put("s.inp", head + "7,1,2,1,4\n"), "element 7 has a node twice")
    refused(put("s.inp", head + "7,1,2,2,1\n"), "element 7 has a node twice")
    for corners in ("1,1,2,3", "1,2,2,3", "1,2,3,3", "1,2,3,1"):
        deck, _ = convert(put("s.inp", head + "7,%s\n" % corners))
        check(areas(deck) == {1: 2.0}, corners + " is a triangle: %s" % deck.cards)
        is_valid()
    deck, out = convert(put("s.inp", head + "7,1,2,3,4\n8,2,3,4,1\n9,4,3,2,1\n"))
    check(
        list(deck.elements()) == [7] and "twice in the file: 2" in out, "one of three: " + out
    )


# ---------------------------------------------------------------- names and numbers

NINE = "*NODE\n" + "".join(
    "%d,%d,%d\n" % (3 * j + i + 1, i, j) for j in range(3) for i in range(3)
)
FOUR = "*ELEMENT,TYPE=CPE4\n1,1,2,5,4\n2,2,3,6,5\n3,4,5,8,7\n4,5,6,9,8\n"
RIM = "*ELEMENT,TYPE=T2D2\n11,1,2\n12,2,3\n13,2,5\n14,1,9\n"


def groups():
    """Groups that share elements, that are one, rests, names for several dimensions."""
    sets = "*ELSET,ELSET=all\n1,2,3,4\n*ELSET,ELSET=low\n1,2\n*ELSET,ELSET=left\n1,3\n"
    deck, _ = convert(put("g.inp", NINE + FOUR + sets))
    parts = headings(deck)
    pieces = {"left & low & all", "rest of all", "low & all", "left & all"}
    check(
        {frozenset(p.split(" & ")) for p in parts}
        == {frozenset(p.split(" & ")) for p in pieces},
        "pieces: %s" % parts,
    )
    elements = {n: p for n, (p, _) in deck.elements().items()}
    sets_of = named(deck, PARTS)
    for title, members in (("all", {1, 2, 3, 4}), ("low", {1, 2}), ("left", {1, 3})):
        found = {n for n, p in elements.items() if p in sets_of[title]}
        check(found == members, "%s holds %s" % (title, found))
    is_valid()
    lines = FOUR.replace("CPE4", "CPE4,ELSET=Surface1")  # as Gmsh writes: sets of both kinds
    deck, out = convert(put("g.inp", NINE + lines + "*ELSET,ELSET=disc,GENERATE\n1,4\n"))
    check(headings(deck) == {"disc": 1}, "a set by *ELSET comes first: " + out)
    check(named(deck, PARTS) == {"disc": [1], "Surface1": [1]}, "both are part sets: " + out)
    mixed = "*ELEMENT,TYPE=CPE3\n5,5,6,9\n6,5,9,8\n*ELSET,ELSET=m,GENERATE\n2,3\n3,5,2\n6,6\n"
    deck, out = convert(put("g.inp", NINE + FOUR.replace("4,5,6,9,8\n", "") + mixed))
    part = headings(deck)["m"]
    found = {n for n, (p, _) in deck.elements().items() if p == part}
    check(found == {2, 3, 5, 6} and areas(deck)[part] == 3.0, "a mixed part: " + out)
    is_valid()
    both = "*ELSET,ELSET=low\n1,2\n*ELSET,ELSET=again\n2,1\n"
    deck, out = convert(put("g.inp", NINE + FOUR + both))
    check(set(headings(deck)) == {"low", "mesh"}, "the first of two equal groups: " + out)
    check(set(named(deck, PARTS)) == {"low", "again"}, "both are part sets: " + out)
    same = "*ELSET,ELSET=one\n1,11,12,13,14\n*NSET,NSET=one\n9,8\n*ELSET,ELSET=ONE\n4\n"
    deck, out = convert(put("g.inp", NINE + FOUR + RIM + same))
    part = headings(deck)["one"]
    check({n for n, (p, _) in deck.elements().items() if p == part} == {1, 4}, "one: " + out)
    check(named(deck, SEGMENTS) == {"one": [1, 2, 2, 3]}, "exposed edges alone: " + out)
    check(named(deck, NODES) == {"one": [1, 2, 3, 5, 9], "one (2)": [8, 9]}, "nodes: " + out)
    for text in (
        "between elements, so no segments: nodes alone: 1",
        "no edges of elements: nodes alone: 1",
    ):
        check(text in out, "told: '%s' in %s" % (text, out))
    is_valid()


def names():
    """Blanks, commas, marks of the format, other letters, too many letters."""
    long = "a name that is much longer than the seventy columns that a heading may have " * 2
    titles = ["contact face, left", "$dollar", "*star", "&amp", "Füße", long, long + "!", "-"]
    text = NINE + FOUR
    for k, title in enumerate(titles):
        text += '*NSET,NSET="%s"\n%d\n' % (title.replace(",", ";"), k + 1)
        text += '*ELSET,ELSET="%s"\n%d\n' % (title.replace(",", ";"), k % 4 + 1)
    deck, out = convert(put("n.inp", text))
    found = {n.strip(): m for n, m in named(deck, NODES).items()}
    check(found["contact face; left"] == [1] and found["$dollar"] == [2], "names: %s" % found)
    check(found["Füße"] == [5], "other letters: %s" % found)
    check(sorted(sum(found.values(), [])) == list(range(1, 9)), "every set: %s" % found)
    check(all(len(n.encode()) <= 70 for n in named(deck, NODES)), "at most 70 columns")
    check(out.count("a name is cut to 70 columns") == 1, "told once: " + out)
    is_valid()


def numbers():
    """No groups, huge ids, ids that no deck takes, ids in no order."""
    deck, _ = convert(put("i.inp", NINE + FOUR))
    check(
        headings(deck) == {"mesh": 1} and not deck.sets() and not deck.sets(PARTS), "no groups"
    )
    is_valid()
    text = "*NODE\n2147483647,0,0\n100000000,1,0.1\n7,0.1234567890123456,1\n"
    deck, _ = convert(
        put("i.inp", text + "*ELEMENT,TYPE=S3\n2000000000,2147483647,100000000,7\n")
    )
    check(set(deck.nodes()) == {7, 100000000, 2147483647}, "huge ids stay")
    check(deck.nodes()[7] == (0.1234567890123456, 1.0), "with all digits")
    check(list(deck.elements()) == [2000000000], "the element's too")
    is_valid()
    text = text.replace("2147483647", "2147483648").replace("7,0.12", "70,0.12")
    deck, out = convert(put("i.inp", text + "*ELEMENT,TYPE=S3\n5,2147483648,100000000,70\n"))
    check(set(deck.nodes()) == {1, 2, 3} and "nodes numbered anew" in out, "too large: " + out)
    check(list(deck.elements()) == [5], "elements keep theirs")
    is_valid()


def cell_data():
    """--parts, data that are no numbers of parts, a polygon."""
    points = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.0), (2.0, 1.0)])
    points = np.column_stack([points, np.zeros(6)])
    data = {
        "colour": [np.array([3.0, 8.0])],
        "Material": [np.array([0, 5])],
        "T": [np.array([0.5, 1])],
    }
    cells = [("quad", np.array([[0, 1, 2, 3], [1, 4, 5, 2]]))]
    meshio.write(path("c.vtu"), meshio.Mesh(points, cells, cell_data=data))
    deck, out = convert(path("c.vtu"))
    check(set(headings(deck)) == {"Material 5", "mesh"}, "0 is no part: " + out)
    check(headings(deck)["Material 5"] == 5 and "--parts NAME): colour\n" in out, out)
    deck, _ = convert(path("c.vtu"), "--parts", "colour")
    check(headings(deck) == {"colour 3": 3, "colour 8": 8}, "--parts colour")
    code, _, errors = run(path("c.vtu"), path("refused.k"), "--parts", "T")
    check(code == 2 and "Material colour" in errors, "--parts T: " + errors)


# ---------------------------------------------------------------- Abaqus by hand

INSTANCES = """*Heading
 a preprocessor's way
*Part, name=Bar
*Node
 1, 0., 0.
 2, 1., 0.
 3, 1., 1.
 4, , 1.
*Element, type=CPE4R
1, 1, 2,
 3, 4
*Nset, nset=_PickedSet2, internal, generate
 1, 4, 1
*Elset, elset=_PickedSet2, internal
 1,
*Nset, nset=Left
 1, 4
*Solid Section, elset=_PickedSet2, material=m
,
*End Part
*Assembly, name=Assembly
*Instance, name=Bar-1, part=Bar
*End Instance
*Instance, name=Bar-2, part=BAR
 1.5, 0.25
*End Instance
*Node
 1, 9., 9.
*Nset, nset="held end", instance=Bar-2
 2, 3
*Elset, elset=_Face_S2, internal, instance=Bar-1
 1,
*Surface, type=ELEMENT,
 name=Face
_Face_S2, S2
*Nset, nset=both
Bar-1.Left, bar-2.left
*End Assembly
*Material, name=m
*Elastic
1000., 0.3
*Step
*Static
1., 1.
*End Step
"""


def abaqus():
    """Instances, internal sets, surfaces, includes, and what is wrong."""
    deck, out = convert(put("p.inp", INSTANCES))
    check(set(headings(deck)) == {"Bar-1", "Bar-2"}, "a part for each instance: " + out)
    check(areas(deck) == {1: 1.0, 2: 1.0}, "areas: %s" % areas(deck))
    sets = named(deck, NODES)
    check(set(sets) == {"held end", "Face", "both", "Bar-1.Left", "Bar-2.Left"}, "sets: " + out)
    check(places(deck, sets["held end"]) == {(2.5, 0.25), (2.5, 1.25)}, "the moved instance")
    check(places(deck, sets["both"]) == {(0, 0), (0, 1), (1.5, 0.25), (1.5, 1.25)}, "both")
    check(places(deck, named(deck, SEGMENTS)["Face"]) == {(1, 0), (1, 1)}, "the surface")
    is_valid()
    put("part.inp", NINE + FOUR)
    more = "*SURFACE,NAME=s\n1,S1\n4,S3\n4,SPOS\n*SURFACE,TYPE=NODE,NAME=n\n3,\n"
    deck, out = convert(put("q.inp", "*INCLUDE, INPUT=part.inp\n" + more))
    check(named(deck, SEGMENTS) == {"s": [1, 2, 9, 8]}, "faces of elements: " + out)
    check(named(deck, NODES)["n"] == [3] and "no edges left out: 1" in out, "a node: " + out)
    nodes = "*NSET,NSET=g,GENERATE\n1,7,3\n9,9\n"
    triangle = "*ELEMENT,TYPE=S3\n1,1,2,5\n*SURFACE,NAME=s\n1,S3\n"
    deck, out = convert(put("q.inp", NINE + FOUR + nodes))
    check(named(deck, NODES) == {"g": [1, 4, 7, 9]}, "generated: " + out)
    deck, out = convert(put("q.inp", NINE + triangle))
    check(set(named(deck, SEGMENTS)["s"]) == {1, 5}, "the last face of a triangle: " + out)
    deck, out = convert(put("q.inp", NINE + FOUR.replace("CPE4", "CAX4")))
    check("axisymmetric elements are read as plane ones" in out, out)
    for text, word in (
        (FOUR + "5,1,2,99,4\n", "element 5 names node 99"),
        (FOUR + "*NSET,NSET=a\n77\n", "A names node 77"),
        (FOUR + "*ELSET,ELSET=a\nb\n", "the element set B is not there"),
        (FOUR + "*ELSET,ELSET=a\na\n", "contains itself"),
        (FOUR + "*NGEN\n1,3\n", "*NGEN"),
        (FOUR + "1,1,2,5,4\n", "element number stands twice"),
        (FOUR + "6,1,2,5\n", "have 4 nodes"),
        (FOUR + "*NODE\n1,0,0\n", "node number stands twice"),
        (FOUR + "*NODE\n10,zero,0\n", "zero"),
        (FOUR + "*INCLUDE,INPUT=nothing.inp\n", "nothing.inp"),
        ("*ELEMENT\n1,1,2,5,4\n", "TYPE"),
        ("", "no triangle and no quadrilateral"),
    ):
        refused(put("w.inp", NINE + text), word, code=3 if "nothing" in word else 2)
    turned = INSTANCES.replace(" 1.5, 0.25\n", " 1.5, 0.25\n 0,0,0,0,0,1,90\n")
    refused(put("w.inp", turned), "turned instances")


# ---------------------------------------------------------------- files, scenes


def files():
    """Missing, cut off, of another kind; nowhere to write; IN is OUT; a pipe closed early."""
    refused(path("none.vtk"), "no such file", code=3)
    refused(put("b.vtk", "not a mesh\n"), "meshio cannot read it")
    refused(put("b.xyz", "not a mesh\n"), "meshio cannot read it")
    refused(put("b.geo", "Point(1) = {0, 0, 0};\n"), "mesh it first")
    refused(put("b.key", "*KEYWORD\n"), "*INCLUDE")
    refused(put("b.msh", 'SystemCall "touch %s";\n' % path("harm")), "does not begin as a mesh")
    check(not os.path.exists(path("harm")), "a script in a .msh file is not run")
    points, cells = two_bodies()
    for version in ("vtk42", "vtk51"):
        with contextlib.redirect_stderr(io.StringIO()):  # it warns of text
            meshio.write(path("b.vtk"), meshio.Mesh(points, cells), version, binary=False)
        with open(path("b.vtk")) as file:
            whole = file.read()
        last = whole.index("CELL_TYPES") + 25
        for k in list(range(100, last, 97)) + [last]:
            refused(put("cut.vtk", whole[:k]))
        convert(put("cut.vtk", whole))
    code, _, errors = run(path("b.vtk"), path("nowhere/out.k"))
    check(code == 3 and "nowhere" in errors, "no folder: " + errors)
    code, _, errors = run(path("b.vtk"), path("b.vtk"))
    check(code == 2 and "same file" in errors and os.path.getsize(path("b.vtk")), errors)
    script = os.path.join(os.environ["ROOT"], "scripts", "mesh2deck.py")
    command = '"%s" "%s" "%s" out.k | true' % (sys.executable, script, path("b.vtk"))
    done = subprocess.run(command, shell=True, cwd=TMP, stderr=subprocess.PIPE, text=True)
    check(not done.stderr, "a pipe closed early: " + done.stderr)


def scenes():
    """OUT_scene.k runs as it is, whatever the mesh, and its energy is m v^2/2."""
    points, cells = two_bodies()
    write_numbers("two.vtu", points, cells)
    write_numbers("small.vtu", 1.0e-6 * points, cells)
    write_numbers("far.vtu", points + np.array([1.0e4, -1.0e4, 0.0]), cells)
    put("one.inp", NINE + FOUR + RIM + "*ELSET,ELSET=rim\n11,12\n")
    put("single.inp", "*NODE\n1,0,0\n2,3,0\n3,0,2\n*ELEMENT,TYPE=CPS3\n1,1,2,3\n")
    for name in ("two.vtu", "small.vtu", "far.vtu", "one.inp", "single.inp"):
        stem = name.split(".")[0]
        deck, out = convert(path(name), "--scene", deck=stem + ".k")
        check(stem + "_scene.k" in out, name + ": the scene is told")
        folder = path(stem)
        code, errors, told = bipact(path(stem + "_scene.k"), folder)
        # A body of four elements bends stiffly, and is told so; nothing else is wrong.
        known = all(line.startswith("WARNING bending") for line in errors.splitlines())
        check(code == 0 and known, "%s: exit %d: %s%s" % (name, code, errors, told))
        with open(path(stem + "_scene.k")) as file:
            contact = "SINGLE_SURFACE" in file.read()
        check(contact == ("part 7" in out), name + ": contact where there are two bodies")
        area = sum(areas(deck).values())
        energy = table(folder, "glstat")
        error = abs(energy["kinetic"][0] / (0.5 * 0.001 * area * 4.0**2) - 1.0)
        at_most(error, 1e-12, name + ": energy / m v^2/2 - 1")
        check(
            energy.status == "done" and energy["total"].max() < 1.001 * energy["total"][0], name
        )
        check(table(folder, "rwforc")["fn"].max() > 0.0, name + ": it meets the wall")
        if name in ("one.inp", "single.inp"):
            check(energy["momy"][-1] > 0.0, name + ": it flies up again at the end")
    put("one_scene.k", "mine\n")
    _, out = convert(path("one.inp"), "--scene", deck="one.k")
    with open(path("one_scene.k")) as file:
        check(file.read() == "mine\n" and "is there and stays" in out, "a scene stays: " + out)


for test in (
    each_format,
    plane,
    kinds,
    shapes,
    groups,
    names,
    numbers,
    cell_data,
    abaqus,
    files,
    scenes,
):
    test()
finish()
