"""Tests of gmsh_tests.py in space: solids of every kind that Gmsh makes."""

import re

import numpy as np
from mesh_cases import (
    NODES,
    PARTS,
    SEGMENTS,
    around,
    convert,
    flux,
    gmsh,
    headings,
    is_valid,
    named,
    path,
    refused,
    three,
)

from scenes import at_most, bipact, check, table

# Hexahedra, beside them wedges, above them tetrahedra with pyramids on the hexahedra.
GEOMETRY = """
h = 0.5;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h};
Point(4) = {0, 1, 0, h}; Point(5) = {2, 0, 0, h}; Point(6) = {2, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};
Transfinite Curve{1, 2, 3, 4} = 3;
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};
Transfinite Surface{1}; Recombine Surface{1};
a[] = Extrude{0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
b[] = Extrude{0, 0, 1} { Surface{2}; Layers{2}; Recombine; };
c[] = Extrude{0, 0, 1} { Surface{a[0]}; };
"""
GROUPS = """
Physical Volume("low", 40) = {a[1], b[1]}; Physical Volume("up", 7) = {c[1]};
Physical Volume("all", 9) = {a[1], b[1], c[1]};
Physical Surface("skin", 40) = CombinedBoundary{ Volume{a[1], b[1], c[1]}; };
Physical Surface("floor", 5) = {1, 2}; Physical Surface("between") = {a[0]};
Physical Curve("edge") = {1, 5}; Physical Point("corner") = {1, 6};
"""
KINDS = {4: "tetrahedra", 5: "pyramids", 6: "wedges", 8: "hexahedra"}
ROUND_OFF = 1.0e-13  # sums of some hundred products of numbers of size 1


def said(deck):
    """What a deck says, but for the numbers of its elements and the order of its nodes."""
    elements = sorted((part, sorted(nodes)) for part, nodes in deck.solids().values())
    segments = {
        title: sorted(sorted(s) for s in three(members))
        for title, members in named(deck, SEGMENTS).items()
    }
    return elements, deck.parts(), [deck.titled(k) for k in (PARTS, NODES)], segments


def versions():
    """All linear kinds in formats 2.2 and 4.1, text and binary: one deck, that runs."""
    decks = []
    for version in ("22", "41"):
        for binary in ("", "-bin"):
            name = "s%s%s.msh" % (version, binary)
            options = ["-format", "msh" + version] + ([binary] if binary else [])
            source = gmsh(name, GEOMETRY + GROUPS, *options, dim=3)
            deck, out = convert(source, "--scene", deck=name + ".k")
            decks.append(deck)
            check(("written twice" in out) == (version == "22"), name + ": " + out)
            check(said(deck) == said(decks[0]), name + " gives another deck")
            counts = {n: 0 for n in KINDS}
            for _, nodes in deck.solids().values():
                counts[len(set(nodes))] += 1
            for n, kind in KINDS.items():
                check(counts[n] > 1 and "%d %s" % (counts[n], kind) in out, kind + ": " + out)
            is_valid(name + ".k")
    groups(decks[0], out)
    code, errors, _ = bipact(path("s41-bin.msh_scene.k"), path("s41"))
    check(code == 0 and not errors, "the scene: %d: %s" % (code, errors))
    if code == 0:
        table_of = table(path("s41"), "matsum")
        mass = table_of["mass"][table_of["time"] == 0.0].sum() / 0.001
        at_most(abs(mass / 3.0 - 1.0), ROUND_OFF, "mass of all / volume - 1")


def groups(deck, out):
    """Parts, sets, faces."""
    check(headings(deck) == {"low": 40, "up": 7}, "parts: " + out)
    sizes = dict(re.findall('part \\d+ "(.+)": \\d+ elements, volume (.+)', out))
    check(sizes == {"low": "2", "up": "1"}, "volumes: " + out)
    check(named(deck, PARTS) == {"low": [40], "up": [7], "all": [7, 40]}, "part sets: " + out)
    points, sets = deck.points(), named(deck, NODES)
    corner = {points[n] for n in sets["corner"]}
    check(corner == {(0.0, 0.0, 0.0), (2.0, 1.0, 0.0)}, "points: %s" % corner)
    check({points[n][1:] for n in sets["edge"]} == {(0.0, 0.0)}, "lines are node sets")
    check({points[n][2] for n in sets["between"]} == {1.0}, "inner faces are node sets")
    segments = {t: three(m) for t, m in named(deck, SEGMENTS).items()}
    check(set(segments) == {"skin", "floor"} and "so no segments" in out, "faces: " + out)
    volume = flux(deck, segments["skin"]) / 3.0
    at_most(abs(volume / 3.0 - 1.0), ROUND_OFF, "volume of the skin - 1")
    check({points[n][2] for s in segments["floor"] for n in s} == {0.0}, "the floor")
    check({len(s) for s in segments["floor"]} == {3, 4}, "triangles and quadrilaterals")


RING = """
SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {0, 2, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Transfinite Curve{1, 3} = 2; Transfinite Curve{2, 4} = 4;
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Surface{1}; Recombine Surface{1};
a[] = Extrude{0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Physical Volume("ring") = {a[1]}; Physical Surface("outside") = {a[3]};
"""


def quadratic():
    """A quarter of a ring of 27-node hexahedra, curved; what is quadratic and not read."""
    deck, out = convert(gmsh("ring.msh", RING, "-order", "2", dim=3))
    check("6 27-node hexahedra" in out and "order" not in out, "27 nodes: " + out)
    load = ["*DEFINE_CURVE", "1", "0.0,0.0", "9.0,0.0", "*LOAD_SEGMENT_SET", "2,1"]
    code, errors, told = bipact(around("out.k", *load, "*DATABASE_MATSUM", "0.1,"), path("r"))
    check(code == 0 and "another order" not in errors + told, "ring: %s%s" % (errors, told))
    # Three arcs of 30 degrees, of radius 2 and 1: polygons, and parabolas of 2/3 chord x height.
    arc = np.sin(np.pi / 6) / 2 + 4 / 3 * np.sin(np.pi / 12) * (1 - np.cos(np.pi / 12))
    mass = table(path("r"), "matsum")["mass"][0]
    # Gmsh spaces nodes on arcs to about 1e-9, which enters squared.
    at_most(abs(mass / (3 * (4 - 1) * arc) - 1.0), 1e-12, "mass / of the ring - 1")
    check("volume %.6g\n" % mass in out, "volume, mass %.6g: %s" % (mass, out))
    points = deck.points()
    outer = [n for n, p in points.items() if abs(np.hypot(*p[:2]) - 2.0) < 1e-8]
    check(sorted(outer) == named(deck, NODES)["outside"] and len(outer) == 35, "its nodes")
    check(len(three(named(deck, SEGMENTS)["outside"])) == 6, "its faces by their corners")
    incomplete = "Mesh.SecondOrderIncomplete = 1;"
    source = gmsh("twenty.msh", incomplete + RING, "-order", "2", dim=3)
    refused(source, "6 of type Hexahedron 20", "linear elements", "hexahedra with 27")
    source = gmsh("mixed.msh", GEOMETRY + GROUPS, "-order", "2", dim=3)
    refused(source, "of type Prism 18", "of type Pyramid 14", "-order 1")
    skin = 'Physical Surface("skin") = {a[0], b[2]};'
    refused(gmsh("skin.msh", GEOMETRY + skin, dim=3), "z is not constant", "volumes")


TESTS = (versions, quadratic)
