"""Reader of Abaqus .inp files: nodes, elements, sets and surfaces, also those of parts and of
instances with their translations. Names are case-free; what does not concern the mesh is passed
over.
"""

import os
import re

import numpy as np

from mesh_data import Group, Mesh, MeshError
from mesh_shapes import KINDS, SHAPES, all_of_side

SOLID = re.compile(r"(C3D|DC3D|AC3D|CC3D|DCC3D|Q3D)(4|5|6|8|10|27)[A-Z]*$")
PLANE = re.compile(
    r"(CPEG|CPE|CPS|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|M3D|SFM3D|R3D|STRI|DS|S)([34689])[A-Z]*\d?$"
)
LINE = re.compile(r"(([TR][23]D|RAX)2|B[23][13]|[SM]AX1|FRAME2D)[A-Z]*$")
LINE3 = re.compile(r"(T[23]D3|B[23]2)[A-Z]*$")
SOLIDS = {4: "tetra", 5: "pyramid", 6: "wedge", 8: "hexahedron", 10: "tetra10"}
SOLIDS[27] = "hexahedron27"
PLATES = {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}
# Node 21 is the centre, 22 to 27 are those of the faces S1 to S6.
ORDER = {"hexahedron27": [*range(20), 26, 24, 23, 25, 21, 22, 20]}
# Faces S1, S2, ... of solids; of plane elements they are the edges in their order.
TETRAHEDRON = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
HEXAHEDRON = [
    (0, 1, 2, 3),
    (4, 7, 6, 5),
    (0, 4, 5, 1),
    (1, 5, 6, 2),
    (2, 6, 7, 3),
    (3, 7, 4, 0),
]
SIDE_KINDS = {2: "line", 3: "triangle", 4: "quad", 6: "triangle6", 9: "quad9"}
FACES = {"tetra": TETRAHEDRON, "tetra10": TETRAHEDRON}
FACES.update({"hexahedron": HEXAHEDRON, "hexahedron27": HEXAHEDRON})
FACES["wedge"] = [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)]
FACES["pyramid"] = [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)]
GENERATORS = "NGEN NFILL NCOPY NMAP ELGEN ELCOPY SYSTEM".split()  # make or move nodes, elements
SETS = {"NSET": "node", "ELSET": "element"}


def kind_of(said):
    """The kind of a TYPE of elements; None: it is not read."""
    if LINE.match(said):
        return "line"
    if LINE3.match(said):
        return "line3"
    for pattern, kinds in ((PLANE, PLATES), (SOLID, SOLIDS)):
        found = pattern.match(said)
        if found:
            return kinds[int(found.group(2))]
    return None


class Scope:
    """What a part defines, or the file outside of parts."""

    def __init__(self):
        self.nodes = {}  # {id: coordinates}
        self.blocks = []  # [(kind or TYPE, TYPE, ids, ids of nodes or None)]
        self.sets = {"NSET": {}, "ELSET": {}}  # {NAME: [(INSTANCE or '', id or NAME of a set)]}
        self.surfaces = {}  # {NAME: (type, INSTANCE or '', [fields])}
        self.shown = {}  # names as they are written first
        self.internal, self.declared = set(), set()  # sets of the preprocessor; sets by *ELSET


class Instance:
    """A scope in its place: rows of its nodes, (dimension, row) of its elements by id."""

    def __init__(self, name, scope, shift=(0.0, 0.0, 0.0)):
        self.name, self.scope, self.shift = name, scope, shift
        self.node, self.element = {}, {}


def read_abaqus(path):
    """The mesh of a file."""
    reader = Reader()
    reader.read(path)
    return Assembler(reader).mesh


def blocks_of(path):
    """(line number, KEYWORD, {PARAMETER: value}, data lines) of a file."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [(k, line.strip()) for k, line in enumerate(file, 1)]
    lines = [(k, line) for k, line in lines if line and not line.startswith("**")]
    at = 0
    while at < len(lines):
        number, head = lines[at]
        at += 1
        while head.endswith(",") and at < len(lines) and not lines[at][1].startswith("*"):
            head += lines[at][1]
            at += 1
        first = at
        while at < len(lines) and not lines[at][1].startswith("*"):
            at += 1
        words = [w.strip() for w in head.lstrip("*").split(",")]
        pairs = [w.partition("=") for w in words[1:] if w]
        values = {name.strip().upper(): value.strip(" \"'") for name, _, value in pairs}
        yield number, words[0].upper(), values, [line for _, line in lines[first:at]]


def fields(line):
    return [w.strip(" \"'") for w in line.split(",") if w.strip()]


def whole_numbers(data):
    return [int(w) for line in data for w in fields(line)]


class Reader:
    """Collects scopes and instances: a method take_KEYWORD for each keyword that is read."""

    def __init__(self):
        self.world = self.here = Scope()
        self.parts, self.instances, self.open = {}, {}, []
        self.axisymmetric = False

    def read(self, path):
        if os.path.realpath(path) in self.open:
            raise MeshError("%s includes itself" % path)
        self.open.append(os.path.realpath(path))
        for number, keyword, values, data in blocks_of(path):
            if keyword == "INCLUDE":
                self.read(os.path.join(os.path.dirname(path), values.get("INPUT", "")))
                continue
            take = getattr(self, "take_" + keyword.lower().replace(" ", "_"), None)
            try:
                if keyword in GENERATORS:
                    raise ValueError("it makes or moves nodes or elements, which is not read")
                if take:
                    take(values, data)
            except KeyError as problem:
                raise MeshError(
                    "%s:%d: *%s: no %s" % (path, number, keyword, problem)
                ) from None
            except (ValueError, IndexError) as problem:
                raise MeshError("%s:%d: *%s: %s" % (path, number, keyword, problem)) from None
        self.open.pop()

    def take_node(self, values, data):
        nodes = self.here.nodes
        before = len(nodes)
        ids = []
        for line in data:
            words = [w.strip() for w in line.split(",")][:4]
            ids.append(int(words[0]))
            nodes[ids[-1]] = [float(w or 0.0) for w in words[1:]] + [0.0] * (4 - len(words))
        if len(nodes) != before + len(ids):
            raise ValueError("a node number stands twice")
        if "NSET" in values:
            self.add_to("NSET", values["NSET"], "", ids)

    def take_element(self, values, data):
        said = values["TYPE"].upper()
        kind = kind_of(said)
        self.axisymmetric |= "AX" in said and kind in ("triangle", "quad")
        if kind is None:
            many = re.search(r"3D(\d+)", said)
            words = sum(len(fields(line)) for line in data)
            count = words // (int(many.group(1)) + 1) if many else len(data)
            self.here.blocks.append((said, said, np.zeros(count), None))
            return
        count, numbers = SHAPES[kind].nodes, whole_numbers(data)
        if len(numbers) % (count + 1):
            raise ValueError("elements of type %s have %d nodes" % (said, count))
        table = np.array(numbers, dtype=np.int64).reshape(-1, count + 1)
        nodes = table[:, 1:][:, ORDER.get(kind, range(count))]
        self.here.blocks.append((kind, said, table[:, 0], nodes))
        if "ELSET" in values:
            self.add_to("ELSET", values["ELSET"], "", table[:, 0].tolist())

    def take_nset(self, values, data):
        self.take_set("NSET", values, data)

    def take_elset(self, values, data):
        self.take_set("ELSET", values, data)
        self.here.declared.add(values["ELSET"].upper())

    def take_set(self, what, values, data):
        tokens = [w for line in data for w in fields(line)]
        if "GENERATE" in values:
            tokens = []
            for words in map(fields, data):
                first, last, step = [int(w) for w in words + ["1"]][:3]
                tokens += range(first, last + 1, step)
        tokens = [int(t) if re.match(r"\d+$", str(t)) else t.upper() for t in tokens]
        self.add_to(what, values[what], values.get("INSTANCE", ""), tokens)
        if "INTERNAL" in values:
            self.here.internal.add(values[what].upper())

    def add_to(self, what, name, instance, tokens):
        key = name.upper()
        self.here.shown.setdefault(key, name)
        members = self.here.sets[what].setdefault(key, [])
        members += [(instance.upper(), t) for t in tokens]

    def take_surface(self, values, data):
        name = values["NAME"]
        self.here.shown.setdefault(name.upper(), name)
        kind = values.get("TYPE", "ELEMENT").upper()
        if kind not in ("ELEMENT", "NODE"):
            return
        rows = [[w.upper() for w in fields(line)] for line in data]
        self.here.surfaces[name.upper()] = kind, values.get("INSTANCE", "").upper(), rows

    def take_part(self, values, _):
        self.here = self.parts[values["NAME"].upper()] = Scope()

    def take_end_part(self, *_):
        self.here = self.world

    take_end_instance = take_end_part

    def take_instance(self, values, data):
        if len(data) > 1:
            raise ValueError("turned instances are not read: turn the part")
        shift = [float(w) for line in data for w in fields(line)] + [0.0] * 3
        part = values.get("PART")
        scope = self.parts[part.upper()] if part else Scope()
        self.instances[values["NAME"].upper()] = Instance(values["NAME"], scope, shift[:3])
        if not part:
            self.here = scope


class Assembler:
    """Makes the mesh from what was read."""

    def __init__(self, read):
        named = read.instances or {name: Instance(name, s) for name, s in read.parts.items()}
        self.named, self.world = named, Instance("", read.world)
        self.all = [self.world] + list(named.values())
        self.place_nodes()
        if read.axisymmetric:
            self.mesh.notes.append("axisymmetric elements are read as plane ones")
        self.place_elements()
        if all(kind in SHAPES for kind, _ in self.mesh.counts):
            for instance in self.all:
                self.add_groups(instance)

    def place_nodes(self):
        x, ids = [], []
        for instance in self.all:
            nodes = instance.scope.nodes
            instance.node = {n: len(x) + k for k, n in enumerate(nodes)}
            x += [[a + b for a, b in zip(place, instance.shift)] for place in nodes.values()]
            ids += nodes
        unique = len(set(ids)) == len(ids)
        self.mesh = Mesh(
            np.array(x).reshape(-1, 3), np.array(ids, dtype=np.int64) if unique else None
        )
        if not unique:
            self.mesh.notes.append(
                "nodes and elements numbered anew: several parts have the same"
            )

    def place_elements(self):
        plain = self.mesh.node_id is not None
        for instance in self.all:
            for kind, said, ids, nodes in instance.scope.blocks:
                if nodes is None:
                    self.mesh.add(kind, ids)
                elif len(ids):
                    rows = self.node_rows(instance, ids, nodes)
                    where = instance.name or "mesh"
                    got = self.mesh.add(kind, rows, ids if plain else None, where, said)
                    self.name_elements(instance, SHAPES[kind].dim, ids, got)
        for cells in self.mesh.cells.values():
            if cells.ids is not None and len(set(cells.ids.tolist())) != len(cells):
                cells.ids = None
                self.mesh.notes.append(
                    "elements numbered anew: several parts have the same numbers"
                )

    def name_elements(self, instance, dim, ids, rows):
        before = len(instance.element)
        instance.element.update((e, (dim, r)) for e, r in zip(ids.tolist(), rows.tolist()))
        if len(instance.element) != before + len(ids):
            raise MeshError("an element number stands twice")

    def node_rows(self, instance, ids, nodes):
        try:
            return np.array([[instance.node[n] for n in row] for row in nodes.tolist()])
        except KeyError:
            bad = next(
                k for k, row in enumerate(nodes.tolist()) if set(row) - set(instance.node)
            )
            missing = min(set(nodes[bad].tolist()) - set(instance.node))
            raise MeshError(
                "element %d names node %d, which is not there" % (ids[bad], missing)
            ) from None

    def members(self, what, scope, instance, name, within=()):
        """Rows of nodes, or (dimension, row) of elements, of a set and of those it names."""
        if name in within or name not in scope.sets[what]:
            raise MeshError(
                "the %s set %s %s"
                % (SETS[what], name, "contains itself" if name in within else "is not there")
            )
        out = []
        for owner, token in scope.sets[what][name]:
            target = self.instance(owner) if owner else instance
            if isinstance(token, int):
                out.append(self.row(what, target, token, name))
            else:
                out += self.named_set(what, scope, target, owner, token, within + (name,))
        return out

    def row(self, what, instance, number, name):
        """Row of a node, (dimension, row) of an element, by its id."""
        table = instance.node if what == "NSET" else instance.element
        if number not in table:
            raise MeshError("%s names %s %d, which is not there" % (name, SETS[what], number))
        return table[number]

    def named_set(self, what, scope, target, owner, token, within=()):
        """A set by its name, or by INSTANCE.NAME."""
        head, dot, tail = token.partition(".")
        if dot and head in self.named and token not in scope.sets[what]:
            target, token = self.named[head], tail
            return self.members(what, target.scope, target, token)
        inside = target.scope if owner else scope
        return self.members(what, inside, target, token, within)

    def instance(self, name):
        if name not in self.named:
            raise MeshError("the instance %s is not there" % name)
        return self.named[name]

    def add_groups(self, instance):
        scope = instance.scope
        several = len(self.named) > 1 and instance.name
        prefix = instance.name + "." if several else ""
        if several:
            rows = [r for dim, r in instance.element.values() if dim == self.mesh.dim]
            self.mesh.groups.append(Group(self.mesh.dim, instance.name, rows, rank=2))
        for name in scope.sets["NSET"]:
            if name not in scope.internal:
                rows = self.members("NSET", scope, instance, name)
                self.mesh.groups.append(Group(0, prefix + scope.shown[name], rows))
        for name in scope.sets["ELSET"]:
            if name not in scope.internal:
                found = self.members("ELSET", scope, instance, name)
                for dim in (3, 2, 1):
                    rows = [r for d, r in found if d == dim]
                    rank = 0 if name in scope.declared else 1
                    self.mesh.groups.append(
                        Group(dim, prefix + scope.shown[name], rows, rank=rank)
                    )
        for name, (kind, owner, rows) in scope.surfaces.items():
            self.add_surface(instance, prefix + scope.shown[name], kind, owner, rows)

    def add_surface(self, instance, name, kind, owner, rows):
        """Faces S1, S2, ... of elements (E1 to E4 of shells) become cells: their sides."""
        target = self.instance(owner) if owner else instance
        if kind == "NODE":
            nodes = []
            for words in rows:
                nodes += self.chosen("NSET", instance, target, owner, words[0], name)
            if nodes:
                self.mesh.groups.append(Group(0, name, nodes))
            return
        sides, left = {}, 0
        for words in rows:
            chosen = self.chosen("ELSET", instance, target, owner, words[0], name)
            face = re.match(r"[SE]([1-6])$", words[1] if len(words) > 1 else "")
            found = [row for dim, row in chosen if face and dim == self.mesh.dim]
            for row in found:
                side, nodes = self.side(row, int(face.group(1)))
                sides.setdefault(side, []).append(nodes)
            left += len(chosen) - len(found)
        if left:
            what = "edges" if self.mesh.dim == 2 else "faces of solids"
            self.mesh.notes.append(
                'faces of the surface "%s" that are no %s left out: %d' % (name, what, left)
            )
        members = [self.mesh.add(side, nodes) for side, nodes in sides.items()]
        if members:
            self.mesh.groups.append(Group(self.mesh.dim - 1, name, np.concatenate(members)))

    def chosen(self, what, instance, target, owner, word, name):
        """What a line of a surface begins with: a number or a set."""
        if word.isdigit():
            return [self.row(what, target, int(word), name)]
        return self.named_set(what, instance.scope, target, owner, word)

    def side(self, row, face):
        """(kind, nodes) of the side of an element that is face S1, S2, ..."""
        elements = self.mesh.elements
        kind, nodes = KINDS[elements.kind[row]], elements.nodes[row]
        if kind == "quad" and nodes[3] == nodes[2]:
            kind = "triangle"
        faces = FACES.get(kind, SHAPES[kind].sides)
        if face > len(faces):
            raise MeshError("a %s has no face S%d" % (kind, face))
        local = all_of_side(kind, faces[face - 1])
        return SIDE_KINDS[len(local)], nodes[local]
