"""Makes a mesh (mesh_data.py) one of a deck: elements and nodes as the deck takes them."""

import re

import numpy as np

import mesh_plane
import mesh_solids
from mesh_data import LARGEST_ID, MeshError, node_name, same_members
from mesh_shapes import QUADRATIC, SHAPES, SOLIDS_TAKEN

SMALLEST = 1.0e-75  # the deck takes no number below, but 0 [L]
OF_SOLIDS = re.compile("tetra|hexa|wedge|pyramid|prism|D?C*3D", re.IGNORECASE)
PLANE = (
    "a plane deck does not take: %s. It takes triangles with 3 nodes and quadrilaterals with 4: "
    "mesh in the plane with linear elements (gmsh -2 -order 1)"
)
SPACE = "a deck in space does not take: %s. " + SOLIDS_TAKEN


def tidy(mesh):
    """Makes the mesh one of a deck: elements that it takes, none twice, no node without element,
    a constant z in the plane, elements counter-clockwise or of positive volume, legal ids."""
    check_kinds(mesh)
    check_coordinates(mesh)
    of_dimension = mesh_plane if mesh.dim == 2 else mesh_solids
    of_dimension.collapse(mesh)
    merge_elements(mesh)
    drop_nodes(mesh)
    of_dimension.make_valid(mesh)
    elements = mesh.elements
    mesh.node_id = legal_ids(mesh, mesh.node_id, len(mesh.x), "node")
    elements.ids = legal_ids(mesh, elements.ids, len(elements), "element")


def check_kinds(mesh):
    unknown = {said: n for (kind, said), n in mesh.counts.items() if kind not in SHAPES}
    solids = mesh.dim == 3 or any(OF_SOLIDS.match(said) for said in unknown)
    if not solids:
        unknown.update(
            {said: n for (kind, said), n in mesh.counts.items() if kind in QUADRATIC}
        )
    if unknown:
        what = ", ".join("%d of type %s" % (n, said) for said, n in sorted(unknown.items()))
        raise MeshError("elements that " + (SPACE if solids else PLANE) % what)
    if not len(mesh.elements):
        hint = "; in Gmsh, physical groups choose what is saved: name the surfaces too"
        hint += ", of solids the volumes"
        raise MeshError(
            "no triangle and no quadrilateral in it, no solid" + (hint if mesh.groups else "")
        )


def check_coordinates(mesh):
    bad = np.flatnonzero(~np.isfinite(mesh.x).all(axis=1))
    if len(bad):
        raise MeshError("a coordinate of %s is not finite" % node_name(mesh, bad[0]))
    mesh.x[np.abs(mesh.x) < SMALLEST] = 0.0


def merge_elements(mesh):
    """Of elements with the same nodes the first stays: Gmsh's format 2.2 writes an element once
    for each of its groups."""
    elements = mesh.elements
    _, first, where = np.unique(
        same_members(elements.nodes), return_index=True, return_inverse=True
    )
    twice = len(elements) - len(first)
    if not twice:
        return
    order = np.argsort(first)
    new = np.empty(len(first), dtype=np.int64)
    new[order] = np.arange(len(first))
    elements.keep(first[order])
    for g in mesh.groups:
        if g.dim == mesh.dim:
            g.members = np.unique(new[where.ravel()][g.members])
    mesh.notes.append("elements written twice in the file: %d" % twice)


def drop_nodes(mesh):
    """Nodes without element go; other cells and groups of nodes lose them (-1 in nodes)."""
    used = np.zeros(len(mesh.x), dtype=bool)
    used[mesh.elements.nodes] = True
    if used.all():
        return
    new = np.where(used, np.cumsum(used) - 1, -1)
    alone = (new[mesh.sides.nodes] < 0).any(axis=1).sum() if mesh.dim == 3 else 0
    if alone:
        mesh.notes.append("surface elements on no solid left out: %d" % alone)
    mesh.x = mesh.x[used]
    for cells in mesh.cells.values():
        cells.nodes = new[cells.nodes]
    if mesh.node_id is not None:
        mesh.node_id = mesh.node_id[used]
    for g in mesh.groups:
        if g.dim == 0:
            kept = g.members[used[g.members]]
            lost = len(g.members) - len(kept)
            g.members = new[kept]
            if lost:
                mesh.notes.append('nodes of "%s" on no element left out: %d' % (g.name, lost))
    mesh.notes.append("nodes without element left out: %d" % (~used).sum())


def legal_ids(mesh, ids, count, what):
    """The ids of the file where a deck takes them all, else 1, 2, ..."""
    if ids is not None:
        ids = np.asarray(ids, dtype=np.int64)
        if len(np.unique(ids)) == count and ids.min() >= 1 and ids.max() <= LARGEST_ID:
            return ids
        mesh.notes.append(
            "%ss numbered anew from 1: a deck takes ids of 1 to %d" % (what, LARGEST_ID)
        )
    return np.arange(1, count + 1)
