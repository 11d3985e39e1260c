#!/usr/bin/env python3
"""Write a mesh file as cards of a deck: mesh2deck.py IN OUT.k [--scene]

IN: Gmsh .msh, Abaqus .inp, VTK .vtk and .vtu, MED .med, and what else meshio reads. A mesh with
tetrahedra, hexahedra, wedges or pyramids is one in space, of which 10-node tetrahedra and 27-node
hexahedra are read too; other meshes are linear triangles and quadrilaterals in the plane x-y. OUT.k
holds *NODE, *ELEMENT_SHELL or *ELEMENT_SOLID, *PART and sets, for an *INCLUDE:

    group of elements   *PART with its name as heading, section 1 (16 of 10-node tetrahedra, 24
                        of 27-node hexahedra), the part's id as material, and
                        *SET_PART_LIST_TITLE; where groups share elements, the pieces are the
                        parts
    group of sides      (lines in the plane, surfaces in space) *SET_SEGMENT_TITLE of those that
                        are exposed, faces turned outward; *SET_NODE_LIST_TITLE
    group of points, in space of lines
                        *SET_NODE_LIST_TITLE

Ids are those of the file where it has them. Clockwise elements and solids of negative volume are
turned, nodes without element left out. --scene writes OUT_scene.k beside it, a main deck that
includes OUT.k and runs as it is; one that is there stays. doc/meshes.md shows the way from a
geometry to a picture.

Exit code: 0 done, 2 the mesh makes no deck (nothing is written), 3 file error."""

import argparse
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from cards import NODE, SHELL, TEN, card, listed, names
from mesh_data import MeshError
from mesh_files import read_mesh
from mesh_parts import content
from mesh_plane import areas
from mesh_scene import scene_lines
from mesh_shapes import KINDS, LINEAR, SHAPES, TEN_NODES, TWENTY_SEVEN, counted
from mesh_solids import volumes
from mesh_tidy import tidy

TEN_NODES_A_CARD = {
    TEN_NODES: "*ELEMENT_SOLID (ten nodes format)",
    TWENTY_SEVEN: "*ELEMENT_SOLID_H27",
}
PLANE = "triangle", "quad"


def mesh_lines(mesh, found, source):
    """The deck of the mesh."""
    out = ["$ mesh of %s, written by mesh2deck.py" % source, "*KEYWORD"]
    out += ["*NODE", names(NODE, *"nid x y z tc rc".split())]
    places = mesh.x.tolist()
    if mesh.dim == 2:
        z = places[0][2] or None
        places = [(x, y, z) for x, y, _ in places]
    out += [card(NODE, n, *place) for n, place in zip(mesh.node_id.tolist(), places)]
    part = np.zeros(len(mesh.elements), dtype=np.int64)
    for p in found.parts:
        part[p.rows] = p.id
    out += shell_lines(mesh, part) if mesh.dim == 2 else solid_lines(mesh, part)
    for p in found.parts:
        labels = names(TEN, *"pid secid mid".split())
        out += ["*PART", p.title, labels, card(TEN, p.id, p.section, p.id)]
    return out + set_lines(mesh, found) + ["*END"]


def shell_lines(mesh, part):
    """Plane elements; a triangle repeats its third node."""
    corners = mesh.node_id[mesh.elements.nodes].tolist()
    rows = zip(mesh.elements.ids.tolist(), part.tolist(), corners)
    out = ["*ELEMENT_SHELL", names(SHELL, *"eid pid n1 n2 n3 n4".split())]
    return out + [card(SHELL, e, p, *c) for e, p, c in rows]


def solid_lines(mesh, part):
    """Solids: those of one card, then those of two and of four."""
    cards = {}
    for kind, rows, nodes in mesh.elements.each_kind():
        numbers = mesh.node_id[nodes[:, SHAPES[kind].card]].tolist()
        heads = zip(mesh.elements.ids[rows].tolist(), part[rows].tolist())
        found = cards.setdefault(SHAPES[kind].section, [])
        found += [(row, *head, n) for row, head, n in zip(rows.tolist(), heads, numbers)]
    out = []
    for section, elements in sorted(cards.items()):
        labels = ["n%d" % (k + 1) for k in range(10)]
        if section == LINEAR:
            out += ["*ELEMENT_SOLID", names(SHELL, "eid", "pid", *labels[:8])]
            out += [card(SHELL, e, p, *n) for _, e, p, n in sorted(elements)]
            continue
        out += [TEN_NODES_A_CARD[section], names(SHELL, "eid", "pid"), names(SHELL, *labels)]
        for _, e, p, n in sorted(elements):
            out += [card(SHELL, e, p)]
            out += [card(SHELL, *n[k : k + 10]) for k in range(0, len(n), 10)]
    return out


def set_lines(mesh, found):
    """Part sets, node sets, segment sets with their names."""

    def head(keyword, s):
        return ["*SET_%s_TITLE" % keyword, s.title, names(TEN, "sid"), card(TEN, s.id)]

    out = []
    for s in found.part_sets:
        out += head("PART_LIST", s) + listed(s.members)
    for s in found.node_sets:
        out += head("NODE_LIST", s) + listed(sorted(mesh.node_id[s.members].tolist()))
    for s in found.segment_sets:
        out += head("SEGMENT", s) + [
            card(TEN, *side) for side in mesh.node_id[s.members].tolist()
        ]
    return out


def count(n, what):
    return "%d %s%s" % (n, what, "" if n == 1 else "s")


def kinds_of(mesh):
    """How many elements of each kind there are; in the plane of both."""
    many = np.bincount(mesh.elements.kind, minlength=len(KINDS)).tolist()
    kinds = [k for k in KINDS if (many[KINDS.index(k)] if mesh.dim == 3 else k in PLANE)]
    return [counted(many[KINDS.index(k)], k) for k in kinds]


def summary(mesh, found, source):
    """What became what."""
    yield "%s: %s" % (source, ", ".join([count(len(mesh.x), "node")] + kinds_of(mesh)))
    name, measure = ("area", areas(mesh)) if mesh.dim == 2 else ("volume", volumes(mesh))
    for p in found.parts:
        size = count(len(p.rows), "element"), name, measure[p.rows].sum()
        yield '  part %d "%s": %s, %s %.6g' % (p.id, p.title, *size)
    for s in found.part_sets:
        label = "part" if len(s.members) == 1 else "parts"
        yield '  part set %d "%s": %s %s' % (
            s.id,
            s.title,
            label,
            " ".join(map(str, s.members)),
        )
    for s in found.node_sets:
        yield '  node set %d "%s": %s' % (s.id, s.title, count(len(s.members), "node"))
    side = "edge" if mesh.dim == 2 else "face"
    for s in found.segment_sets:
        yield '  segment set %d "%s": %s' % (s.id, s.title, count(len(s.members), side))
    for note in dict.fromkeys(mesh.notes):
        yield "  " + note


def write(path, lines):
    """A file that is there whole or not at all."""
    part = path + ".part"
    try:
        with open(part, "w", encoding="utf-8", newline="\n") as out:
            out.write("\n".join(lines) + "\n")
        os.replace(part, path)
    except OSError as problem:
        if os.path.exists(part):
            os.remove(part)
        raise OSError(problem.errno, problem.strerror, path) from None


def convert(source, target, scene=False, part_data=None):
    """Writes the decks; returns the lines of the summary."""
    if os.path.exists(target) and os.path.samefile(source, target):
        raise MeshError("IN and OUT are the same file")
    mesh = read_mesh(source, part_data)
    tidy(mesh)
    found = content(mesh)
    out = list(summary(mesh, found, source))
    write(target, mesh_lines(mesh, found, os.path.basename(source)))
    out.append(target)
    main_deck = os.path.splitext(target)[0] + "_scene.k"
    if scene and os.path.exists(main_deck):
        out.append("%s is there and stays; remove it to have a new one" % main_deck)
    elif scene:
        write(main_deck, scene_lines(mesh, found, os.path.basename(target)))
        out.append(main_deck)
    return out


def main(argv=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("mesh", metavar="IN", help="mesh file")
    parser.add_argument("deck", metavar="OUT.k", help="deck to write")
    parser.add_argument("--scene", action="store_true", help="also write OUT_scene.k, to run")
    parser.add_argument("--parts", metavar="NAME", help="cell data that number parts (VTK)")
    a = parser.parse_args(argv)
    try:
        print("\n".join(convert(a.mesh, a.deck, a.scene, a.parts)))
    except MeshError as problem:
        print("mesh2deck.py: %s: %s" % (a.mesh, problem), file=sys.stderr)
        return 2
    except OSError as problem:
        print("mesh2deck.py: %s: %s" % (problem.filename, problem.strerror), file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
