"""Readers of mesh files: a Mesh (mesh_data.py) from .msh by Gmsh's package, from Abaqus .inp
(mesh_abaqus.py), from VTK, VTU, MED and others by meshio."""

import contextlib
import io
import os
import re
import warnings

import numpy as np

from mesh_abaqus import read_abaqus
from mesh_data import Group, Mesh, MeshError
from mesh_shapes import SOLIDS_TAKEN, dimension

# Cell data of other programs that number parts, the first that is there is taken.
PART_DATA = (
    "gmsh:physical part partid part_id pid material materialid materialids mat matid "
    "cellentityids medit:ref nastran:ref su2:tag attribute"
).split()

# Kinds of cells by the number of their type in Gmsh.
GMSH_KINDS = {15: "vertex", 1: "line", 8: "line3", 2: "triangle", 9: "triangle6", 3: "quad"}
GMSH_KINDS.update({16: "quad8", 10: "quad9", 4: "tetra", 5: "hexahedron", 6: "wedge"})
GMSH_KINDS.update({7: "pyramid", 11: "tetra10", 12: "hexahedron27"})
# Its places of the nodes of mesh_shapes, where the order differs.
GMSH_ORDER = {"tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]}
GMSH_ORDER["hexahedron27"] = [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]
GMSH_ORDER["hexahedron27"] += [22, 23, 21, 24, 20, 25, 26]


def read_mesh(path, part_data=None):
    """The mesh of a file, by the ending of its name; part_data: name of the cell data that
    number parts."""
    if not os.path.isfile(path):
        raise FileNotFoundError(2, "no such file", path)
    ending = os.path.splitext(path)[1].lower()
    if ending == ".msh":
        return read_gmsh(path)
    if ending == ".inp":
        return read_abaqus(path)
    if ending in (".geo", ".step", ".stp", ".brep", ".iges", ".igs"):
        raise MeshError("a geometry, not a mesh: mesh it first (gmsh -2 FILE -o FILE.msh)")
    if ending in (".k", ".key", ".dyn"):
        raise MeshError(
            "a deck: name it with *INCLUDE in a deck of yours, bipact reads it as it is"
        )
    return read_by_meshio(path, part_data)


# ---------------------------------------------------------------- Gmsh


def load_gmsh():
    try:
        import gmsh
    except (ImportError, OSError) as problem:
        raise MeshError(
            "Gmsh's package reads .msh files and cannot be loaded here (%s): make gmsh "
            "installs it; or save the mesh as .inp, .vtk or .med" % problem
        ) from None
    return gmsh


def read_gmsh(path):
    """A file in any version of Gmsh's format."""
    with open(path, "rb") as file:
        if file.read(1) != b"$":  # anything else Gmsh takes for a script and runs it
            raise MeshError("it does not begin as a mesh of Gmsh")
    gmsh = load_gmsh()
    gmsh.initialize(["gmsh"], readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.logger.start()
        try:
            gmsh.merge(path)
        except Exception as problem:  # the package raises nothing more special
            raise MeshError("Gmsh cannot read it: %s" % problem) from None
        errors = [line for line in gmsh.logger.get() if line.startswith("Error")]
        if errors:
            raise MeshError("Gmsh cannot read it: %s" % errors[0])
        return from_gmsh(gmsh.model)
    finally:
        gmsh.finalize()


def from_gmsh(model):
    """The current model of Gmsh as a Mesh."""
    tags, x, _ = model.mesh.getNodes()
    order = np.argsort(tags)
    node_id = np.asarray(tags)[order]
    mesh = Mesh(np.asarray(x).reshape(-1, 3)[order], node_id.astype(np.int64))
    members = {}
    for dim, tag in model.getEntities():
        kinds, ids, nodes = model.mesh.getElements(dim, tag)
        found = members[dim, tag] = [np.zeros(0, dtype=np.int64)]
        for number, eid, flat in zip(kinds, ids, nodes):
            name, _, _, count, _, _ = model.mesh.getElementProperties(number)
            kind = GMSH_KINDS.get(number, name)
            rows = np.searchsorted(node_id, flat).reshape(-1, count)
            rows = rows[:, GMSH_ORDER.get(kind, range(count))]
            region = "%s %d" % ("volume" if dim == 3 else "surface", tag)
            found.append(mesh.add(kind, rows, eid, region, name))
    for dim, number in model.getPhysicalGroups():
        name = model.getPhysicalName(dim, number) or "group %d" % number
        entities = model.getEntitiesForPhysicalGroup(dim, number)
        rows = np.concatenate([r for t in entities for r in members.get((dim, t), [])])
        mesh.groups.append(Group(dim, name, rows, number))
    return mesh


# ---------------------------------------------------------------- meshio


def read_by_meshio(path, part_data):
    """VTK, VTU, MED, and what else meshio reads."""
    try:
        import meshio
    except ImportError:
        raise MeshError("this format is read by meshio, which is missing: make venv") from None
    told = io.StringIO()
    try:
        with contextlib.redirect_stdout(told), contextlib.redirect_stderr(told):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = meshio.read(path)
    except KeyError as problem:  # a kind of cells
        raise MeshError(
            "meshio cannot read it: it knows no cells of type %s, nor does a deck. %s"
            % (problem.args[0], SOLIDS_TAKEN)
        ) from None
    except (Exception, SystemExit) as problem:  # it ends the program where it cannot read
        lines = told.getvalue().split("\n") + [""]
        raise MeshError("meshio cannot read it: %s" % (lines[0].strip() or problem)) from None
    check_count(path, found)
    return from_meshio(found, part_data)


def check_count(path, found):
    """Of a legacy VTK file that was cut off meshio returns what there is."""
    if not path.lower().endswith(".vtk"):
        return
    with open(path, "rb") as file:
        told = re.search(rb"\nCELL_TYPES\s+(\d+)", file.read())
    cells = sum(len(block.data) for block in found.cells)
    if told and int(told.group(1)) != cells:
        raise MeshError("it announces %d cells and holds %d" % (int(told.group(1)), cells))


def from_meshio(found, part_data):
    """A mesh of meshio with its sets, families of MED, or numbers of parts in cell data."""
    mesh = Mesh(found.points)
    rows, dims = [], []
    for block in found.cells:
        kind, nodes = block.type, np.asarray(block.data)
        if kind == "polygon" and nodes.ndim == 2 and nodes.shape[1] in (3, 4):
            kind = "triangle" if nodes.shape[1] == 3 else "quad"
        rows.append(mesh.add(kind, nodes))
        dims.append(dimension(kind))
    if getattr(found, "cell_tags", None) or getattr(found, "point_tags", None):
        add_families(mesh, found, rows, dims)
    for name, blocks in found.cell_sets.items():
        if not name.startswith("gmsh:"):
            chosen = [r[np.asarray(b, dtype=np.int64)] for r, b in zip(rows, blocks)]
            add_by_dim(mesh, name, chosen, dims)
    for name, nodes in found.point_sets.items():
        mesh.groups.append(Group(0, name, nodes))
    if part_data or not mesh.groups:
        add_numbers(mesh, found, rows, dims, part_data)
    return mesh


def add_by_dim(mesh, name, chosen, dims, number=0):
    """One group for each dimension of the chosen cells, given by block."""
    for dim in (3, 2, 1, 0):
        members = [c for c, d in zip(chosen, dims) if d == dim and len(c)]
        if members:
            mesh.groups.append(Group(dim, name, np.concatenate(members), number))


def add_families(mesh, found, rows, dims):
    """MED: a family is a set of names, each cell and node belongs to one."""
    tags = found.cell_data.get("cell_tags", [np.zeros(len(r), dtype=int) for r in rows])
    for name in names_of(found.cell_tags):
        families = [k for k, family in found.cell_tags.items() if name in family]
        chosen = [r[np.isin(t, families)] for r, t in zip(rows, tags) if len(r)]
        add_by_dim(mesh, name, chosen, [d for r, d in zip(rows, dims) if len(r)])
    tags = found.point_data.get("point_tags", np.zeros(len(mesh.x), dtype=int))
    for name in names_of(found.point_tags):
        families = [k for k, family in found.point_tags.items() if name in family]
        mesh.groups.append(Group(0, name, np.flatnonzero(np.isin(tags, families))))


def names_of(families):
    """All names, each once, in the order of the file."""
    return list(dict.fromkeys(name for family in families.values() for name in family))


def add_numbers(mesh, found, rows, dims, part_data):
    """Cell data of whole numbers: cells with the same number above 0 are a group."""
    whole = {n: d for n, d in found.cell_data.items() if all(is_whole(b) for b in d)}
    if part_data and part_data not in whole:
        raise MeshError(
            "no cell data of whole numbers with the name %s; there are: %s"
            % (part_data, " ".join(sorted(whole)) or "none")
        )
    known = {n.lower(): n for n in whole}
    name = part_data or next((known[n] for n in PART_DATA if n in known), None)
    others = sorted(set(whole) - {name})
    if others and not part_data:
        mesh.notes.append(
            "cell data that could number parts (--parts NAME): " + " ".join(others)
        )
    if name is None:
        return
    data = [np.asarray(b).ravel().astype(np.int64) for b in whole[name]]
    for number in np.unique(np.concatenate(data)):
        if number > 0:
            chosen = [r[d == number] for r, d in zip(rows, data) if len(r)]
            kept = [d for r, d in zip(rows, dims) if len(r)]
            add_by_dim(mesh, "%s %d" % (name, number), chosen, kept, number)


def is_whole(block):
    """One whole number for each cell."""
    block = np.asarray(block)
    if block.size != len(block) or not np.issubdtype(block.dtype, np.number):
        return False
    return np.issubdtype(block.dtype, np.integer) or bool((block == np.rint(block)).all())
