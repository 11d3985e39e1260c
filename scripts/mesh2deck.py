#!/usr/bin/env python3
"""Write a mesh file as cards of a deck: mesh2deck.py IN OUT.k [--scene]

IN: Gmsh .msh, Abaqus .inp, VTK .vtk and .vtu, MED .med, and what else meshio reads; linear
triangles and quadrilaterals in the plane x-y. OUT.k holds *NODE, *ELEMENT_SHELL, *PART and
sets, for an *INCLUDE:

    group of elements   *PART with its name as heading, section 1, the part's id as material,
                        and *SET_PART_LIST_TITLE; where groups share elements, the pieces are
                        the parts
    group of lines      *SET_SEGMENT_TITLE of its exposed edges, *SET_NODE_LIST_TITLE
    group of points     *SET_NODE_LIST_TITLE

Ids are those of the file where it has them. Elements are turned counter-clockwise, nodes
without element left out. --scene writes OUT_scene.k beside it, a main deck that includes OUT.k
and runs as it is; one that is there stays. doc/meshes.md shows the way from a geometry to a
picture.

Exit code: 0 done, 2 the mesh makes no plane deck (nothing is written), 3 file error."""

import argparse
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from cards import NODE, SHELL, TEN, card, listed, names
from mesh_data import MeshError, areas, tidy
from mesh_files import read_mesh
from mesh_parts import content
from mesh_scene import scene_lines


def mesh_lines(mesh, found, source):
    """The deck of the mesh."""
    out = ["$ mesh of %s, written by mesh2deck.py" % source, "*KEYWORD"]
    z = float(mesh.x[0, 2]) or None
    out += ["*NODE", names(NODE, *"nid x y z tc rc".split())]
    out += [
        card(NODE, n, x, y, z) for n, (x, y, _) in zip(mesh.node_id.tolist(), mesh.x.tolist())
    ]
    out += ["*ELEMENT_SHELL", names(SHELL, *"eid pid n1 n2 n3 n4".split())]
    part = np.zeros(len(mesh.corners), dtype=np.int64)
    for p in found.parts:
        part[p.rows] = p.id
    corners = mesh.node_id[mesh.corners].tolist()
    rows = zip(mesh.element_id.tolist(), part.tolist(), corners)
    out += [card(SHELL, e, p, *c) for e, p, c in rows]
    for p in found.parts:
        labels = names(TEN, *"pid secid mid".split())
        out += ["*PART", p.title, labels, card(TEN, p.id, 1, p.id)]
    return out + set_lines(mesh, found) + ["*END"]


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
            card(TEN, *pair) for pair in mesh.node_id[s.members].tolist()
        ]
    return out


def count(n, what):
    return "%d %s%s" % (n, what, "" if n == 1 else "s")


def summary(mesh, found, source):
    """What became what."""
    triangles = int((mesh.corners[:, 3] == mesh.corners[:, 2]).sum())
    yield "%s: %s, %s, %s" % (
        source,
        count(len(mesh.x), "node"),
        count(triangles, "triangle"),
        count(len(mesh.corners) - triangles, "quadrilateral"),
    )
    area = areas(mesh)
    for p in found.parts:
        size = count(len(p.rows), "element"), area[p.rows].sum()
        yield '  part %d "%s": %s, area %.6g' % (p.id, p.title, *size)
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
    for s in found.segment_sets:
        yield '  segment set %d "%s": %s' % (s.id, s.title, count(len(s.members), "edge"))
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
