"""mesh2deck.py on files of Gmsh, and the four commands of doc/meshes.md, whose result is judged
from outside: by the deck, the tables, the field file and the picture."""

import os
import re
import subprocess
import sys

import meshio
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mesh_cases import (
    NODES,
    PARTS,
    SEGMENTS,
    Deck,
    areas,
    convert,
    flux,
    gmsh,
    headings,
    is_valid,
    named,
    path,
    places,
    put,
    refused,
    three,
)

import gmsh_solids
from fields import Fields
from scenes import BIPACT, ROOT, at_most, bipact, check, finish, table

# Two glued squares, the right one clockwise, one of quadrilaterals above, a point of nothing;
# groups that overlap, that have one name, blanks, a mark of the format.
GEOMETRY = """
h = 0.3;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h};
Point(4) = {0, 1, 0, h}; Point(5) = {2, 0, 0, h}; Point(6) = {2, 1, 0, h};
Point(99) = {5, 5, 7, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {-2};
Point(11) = {0, 1.1, 0, h}; Point(12) = {1, 1.1, 0, h};
Point(13) = {1, 2.1, 0, h}; Point(14) = {0, 2.1, 0, h};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Transfinite Surface{11}; Recombine Surface{11};
"""
GROUPS = """
Physical Surface("left", 40) = {1}; Physical Surface("both, glued", 7) = {1, 2};
Physical Surface("up", 2000000000) = {11};
Physical Curve("up") = {12, 13}; Physical Curve("between") = {2};
Physical Curve("foot", 40) = {-1, 5};
Physical Point("up") = {11, 12}; Physical Point("$corner", 40) = {1};
"""


def said(deck):
    """What a deck says, by the numbers of its nodes, but for the numbers of its elements."""
    elements = sorted((part, sorted(corners)) for part, corners in deck.elements().values())
    segments = {
        t: {frozenset(m[k : k + 2]) for k in range(0, len(m), 2)}
        for t, m in named(deck, SEGMENTS).items()
    }
    sets = [deck.titled(keyword) for keyword in (PARTS, NODES)]
    return elements, deck.parts(), sets, segments, deck.names(SEGMENTS)


def versions():
    """Formats 2.2 and 4.1, text and binary, give one deck; 2.2 is read by meshio too."""
    decks = {}
    for version in ("22", "41"):
        for binary in ("", "-bin"):
            name = "v%s%s.msh" % (version, binary)
            options = ["-format", "msh" + version] + ([binary] if binary else [])
            deck, out = convert(gmsh(name, GEOMETRY + GROUPS, *options), deck=name + ".k")
            decks[name] = deck
            is_valid(name + ".k")
            check(("written twice" in out) == (version == "22"), name + ": " + out)
            check(said(deck) == said(decks["v22.msh"]), name + " gives another deck")
            one, two = deck.nodes(), decks["v22.msh"].nodes()
            apart = max(np.abs(np.subtract(one[n], two[n])).max() for n in two)
            # Text has 16 digits: half a unit of the last one, below 10.
            check(set(one) == set(two) and apart <= 5e-16, "%s: off by %g" % (name, apart))
    by_meshio(decks["v22.msh"], meshio.read(path("v22.msh")))


def by_meshio(deck, mesh):
    """Places, elements and groups as another reader finds them."""
    xy = [tuple(p) for p in mesh.points[:, :2].tolist()]
    nodes = deck.nodes()
    used = {xy[n] for b in mesh.cells if b.dim == 2 for n in b.data.ravel()}
    check(set(nodes.values()) == used and len(nodes) == len(used), "places of the nodes")
    tags = mesh.cell_data["gmsh:physical"]
    elements = {frozenset(nodes[n] for n in c): p for p, c in deck.elements().values()}
    part_sets = deck.sets(PARTS)
    for number, title in ((40, "left"), (7, "both, glued"), (2000000000, "up")):
        cells = [c for b, t in zip(mesh.cells, tags) if b.dim == 2 for c in b.data[t == number]]
        found = {e for e, p in elements.items() if p in part_sets[number]}
        check(found == {frozenset(xy[n] for n in c) for c in cells}, "elements of " + title)
        check(deck.names(PARTS)[number] == title, "number of " + title)
    check(headings(deck)["left"] == 40 and headings(deck)["up"] == 2000000000, "part numbers")
    sums, parts = areas(deck), headings(deck)
    for title in ("left", "up", "rest of both, glued"):
        check(abs(sums[parts[title]] - 1.0) < 1e-14, "area of " + title)


def groups():
    """Names that several dimensions have, edges between elements, no groups, all saved."""
    deck, out = convert(gmsh("g.msh", GEOMETRY + GROUPS))
    sets = {t.strip(): m for t, m in named(deck, NODES).items()}
    check(set(sets) == {"up", "up (2)", "between", "foot", "$corner"}, "sets: " + out)
    check(deck.names(NODES)[40] == "foot" and len(deck.sets()) == 5, "one of two numbers 40")
    check(places(deck, sets["up (2)"]) == {(0.0, 1.1), (1.0, 1.1)}, "the points")
    check(places(deck, sets["$corner"]) == {(0.0, 0.0)}, "the corner")
    check({x for x, _ in places(deck, sets["between"])} == {1.0}, "nodes between elements")
    segments = named(deck, SEGMENTS)
    check(set(segments) == {"up", "foot"} and "so no segments" in out, "segments: " + out)
    foot = places(deck, segments["foot"])
    check({y for _, y in foot} == {0.0} and {x for x, _ in foot} >= {0.0, 1.0, 2.0}, "the foot")
    check("nodes without element" not in out, "Gmsh saves what groups name: " + out)
    deck, out = convert(gmsh("all.msh", GEOMETRY + GROUPS, "-save_all"))
    check("nodes without element left out: 1" in out and "up" in headings(deck), "all: " + out)
    deck, out = convert(gmsh("none.msh", GEOMETRY))
    parts = headings(deck)
    check(set(parts) == {"surface 1", "surface 2", "surface 11"}, "no groups: " + out)
    check(not deck.sets() and not deck.sets(PARTS) and sum(areas(deck).values()) > 2.99, out)
    is_valid()
    refused(gmsh("two.msh", GEOMETRY + GROUPS, "-order", "2"), "Triangle 6", "-order 1")
    lines = 'Physical Curve("rim") = {1, 2};'
    refused(gmsh("lines.msh", GEOMETRY + lines), "no triangle", "name the surfaces too")


HUGE = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
5 0 0 0 1 1 0 1 2147483647 0
$EndEntities
$Nodes
1 3 1 %(last)d
2 5 0 3
1
%(last)d
20
0 0 0
1.0000000000000002 0 0
0 -0.1234567890123456789 0
$EndNodes
$Elements
1 1 1 1099511627776
2 5 2 1
1099511627776 1 %(last)d 20
$EndElements
"""


def numbers():
    """Numbers that a deck takes and does not take; every digit; a file that is cut off."""
    source = put("huge.msh", HUGE % {"last": 2147483647})
    deck, out = convert(source)
    check(set(deck.nodes()) == {1, 20, 2147483647}, "huge node numbers stay: " + out)
    xy = deck.nodes()
    check(xy[2147483647] == (1.0000000000000002, 0.0), "every digit: %r" % (xy,))
    check(xy[20] == (0.0, -0.1234567890123456789), "every digit: %r" % (xy,))
    check(0 < min(deck.elements()) <= 2147483647, "the element's is one of a deck: " + out)
    check(list(deck.parts()) == [2147483647], "the part keeps the number of its group")
    check("turned counter-clockwise: 1" in out, "turned: " + out)
    is_valid()
    deck, out = convert(put("huge.msh", HUGE % {"last": 1099511627776}))
    check(set(deck.nodes()) == {1, 2, 3} and "nodes numbered anew" in out, "too huge: " + out)
    is_valid()
    for name in ("v22.msh", "v41.msh", "v22-bin.msh", "v41-bin.msh"):
        with open(path(name), "rb") as file:
            whole = file.read()
        end = whole.index(b"$EndElements")
        for k in range(1, end, end // 17):
            with open(path("cut.msh"), "wb") as file:
                file.write(whole[:k])
            refused(path("cut.msh"))


def own_export():
    """The file that Gmsh writes for this format is read as it is."""
    disc = open(os.path.join(ROOT, "input", "meshes", "disc.geo"), encoding="utf-8").read()
    name = gmsh("disc.key", disc, "-setnumber", "Mesh.SaveGroupsOfNodes", "1")
    lines = ["*KEYWORD", "*TITLE", "a disc", "*INCLUDE", os.path.basename(name)]
    lines += ["*CONTROL_TERMINATION", "0.01,", "*CONTROL_IMPLICIT_GENERAL", "1,0.001"]
    lines += ["*CONTROL_IMPLICIT_DYNAMICS", "1,", "*PART", "disc", "2000001,1,1"]
    lines += ["*SECTION_SHELL", "1,13", "1.0,", "*MAT_ELASTIC", "1,0.001,1000.0,0.3"]
    lines += ["*INITIAL_VELOCITY", "0,", "2.0,", "*DATABASE_GLSTAT", "0.001,", "*END", ""]
    folder = path("disc_key")
    code, errors, _ = bipact(put("disc_key.k", "\n".join(lines)), folder)
    check(code == 0, "a .key of Gmsh is refused: " + errors)
    if code == 0:
        area = table(folder, "glstat")["kinetic"][0] / (0.5 * 0.001 * 2.0**2)
        # 64 corners on the circle, as doc/meshes.md shows; the file has 12 digits.
        at_most(abs(area / (32.0 * np.sin(np.pi / 32.0)) - 1.0), 1e-11, "area of the .key - 1")


def blocks():
    """The indented blocks of doc/meshes.md: the commands, what the second of them says."""
    with open(os.path.join(ROOT, "doc", "meshes.md"), encoding="utf-8") as page:
        found = re.findall(r"\n\n((?:    .+\n)+)\n", page.read())
    return [[line[4:] for line in block.splitlines()] for block in found]


def pictures():
    """From the geometries of a disc and of a ball to pictures: runs the page, measures what came
    out."""
    folder = path("way")
    os.makedirs(os.path.join(folder, "bin"))
    for name in (".venv", "scripts", "input"):
        os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))
    os.symlink(BIPACT, os.path.join(folder, "bin", "bipact"))
    disc, of_disc, ball, of_ball = blocks()[:4]
    walk(folder, disc, of_disc)
    judge_disc(folder)
    walk(folder, ball, of_ball)
    judge_ball(folder)


def walk(folder, commands, summary):
    """Runs four commands; the second says what the page shows."""
    check(len(commands) == 4, "four commands: %s" % commands)
    for k, command in enumerate(commands):
        done = subprocess.run(
            command,
            shell=True,
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        check(done.returncode == 0, "%s: %d, %s" % (command, done.returncode, done.stdout))
        if k == 1:
            shape = [re.sub(r"[\d.]+", "0", line) for line in done.stdout.splitlines()]
            check(shape == [re.sub(r"[\d.]+", "0", line) for line in summary], "as shown")


def judge_disc(folder):
    """Mesh, mass, energy, fields and picture of the disc of radius 1, speed as in its scene."""
    deck = Deck(os.path.join(folder, "disc.k"))
    scene = Deck(os.path.join(folder, "disc_scene.k"))
    nodes, elements = deck.nodes(), deck.elements()
    rim = named(deck, SEGMENTS)["rim"]
    count = len(rim) // 2
    # Euler: a disc of n triangles with m corners has 2 (nodes - 1) - m elements.
    check(len(elements) == 2 * (len(nodes) - 1) - count, "nodes, elements, rim of a disc")
    check(len(named(deck, NODES)["rim"]) == count, "the rim is closed")
    check(headings(deck) == {"disc": 1}, "one part")
    area = sum(areas(deck).values())
    polygon = sum(
        0.5 * (nodes[a][0] * nodes[b][1] - nodes[b][0] * nodes[a][1])
        for a, b in zip(rim[::2], rim[1::2])
    )
    # Sums of hundreds of products of size 1; Gmsh spaces nodes on arcs to 1e-9, squared here.
    at_most(abs(area / polygon - 1.0), 1e-13, "area of the elements / of the polygon - 1")
    regular = 0.5 * count * np.sin(2.0 * np.pi / count)
    at_most(abs(area / regular - 1.0), 1e-12, "area / of the regular polygon - 1")
    density, speed = scene.field("*MAT_ELASTIC_TITLE", 2, 2), scene.number("&v0")
    run = os.path.join(folder, "disc_scene.out")
    mass, energy = table(run, "matsum")["mass"], table(run, "glstat")
    at_most(abs(mass[0] / (density * area) - 1.0), 1e-12, "mass / density area - 1")
    kinetic = 0.5 * density * area * speed**2
    at_most(abs(energy["kinetic"][0] / kinetic - 1.0), 1e-12, "energy / m v^2/2 - 1")
    momentum = energy["momy"][0] / (density * area * speed)
    at_most(abs(momentum + 1.0), 1e-12, "momentum / m v + 1")
    check(energy.status == "done" and energy["momy"][-1] > 0.0, "it bounces")
    found = Fields(run)
    check((len(found.points), len(found.cells)) == (len(nodes), len(elements)), "fields")
    drawn(run)


def drawn(run):
    """One picture that shows something."""
    pictures = [n for n in os.listdir(run) if n.endswith(".png")]
    check(len(pictures) == 1, "one picture: %s" % pictures)
    for name in pictures:
        import matplotlib.image

        pixels = matplotlib.image.imread(os.path.join(run, name))
        colours = np.unique(pixels.reshape(-1, pixels.shape[2]), axis=0)
        check(min(pixels.shape[:2]) > 100 and len(colours) > 50, "the picture shows something")


def judge_ball(folder):
    """Mass, energy, bounce and picture of the ball of radius 1 of 10-node tetrahedra."""
    deck, run = Deck(os.path.join(folder, "ball.k")), os.path.join(folder, "ball_scene.out")
    mass, energy = table(run, "matsum")["mass"][0] / 0.001, table(run, "glstat")
    # Parabolas on arcs of the angle a: a share of about a^4/30 of the volume is lost.
    at_most(abs(mass / (4.0 / 3.0 * np.pi) - 1.0), 1e-3, "mass / of the ball - 1")
    straight = flux(deck, three(named(deck, SEGMENTS)["skin"])) / 3.0
    check(0.95 * mass < straight < 0.99 * mass, "corners alone make less: %g" % straight)
    kinetic = 0.5 * 0.001 * mass * 4.0**2
    at_most(abs(energy["kinetic"][0] / kinetic - 1.0), 1e-12, "energy / m v^2/2 - 1")
    at_most(np.abs(energy["residual"]).max(), 1e-12, "ledger residual")
    check(energy.status == "done" and energy["momz"][-1] > 0.0, "it bounces")
    edges, faces = {}, three(named(deck, SEGMENTS)["skin"])
    for face in faces:
        for pair in zip(face, face[1:] + face[:1]):
            edges[pair] = edges.get(pair, 0) + 1
    check(all(n == 1 and (b, a) in edges for (a, b), n in edges.items()), "a closed skin")
    found = Fields(run)
    check(
        (len(found.points), len(found.cells)) == (len(deck.points()), len(deck.solids())),
        "fields of the ball",
    )
    drawn(run)


# numbers comes last of those in this process: Gmsh's parser keeps an error of a file cut off.
for test in (versions, groups, *gmsh_solids.TESTS, numbers, own_export, pictures):
    test()
finish()
