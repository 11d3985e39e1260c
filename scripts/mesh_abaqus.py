"""Reader of Abaqus .inp files: nodes, elements, sets and surfaces, also those of parts and of
instances with their translations. Names are case-free; what does not concern the mesh is passed
over.
"""

import os
import re

import numpy as np

from mesh_data import Group, Mesh, MeshError

PLANE = re.compile(
    r"(CPEG|CPE|CPS|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|M3D|SFM3D|R3D|STRI|DS|S)([34])[A-Z]*\d?$"
)
LINE = re.compile(r"(([TR][23]D|RAX)2|B[23][13]|[SM]AX1|FRAME2D)[A-Z]*$")
GENERATORS = "NGEN NFILL NCOPY NMAP ELGEN ELCOPY SYSTEM".split()  # make or move nodes, elements
SETS = {"NSET": "node", "ELSET": "element"}


class Scope:
    """What a part defines, or the file outside of parts."""

    def __init__(self):
        self.nodes, self.blocks = {}, []  # {id: coordinates}; [(type, ids, ids of nodes)]
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
        kind = values["TYPE"].upper()
        plane, line = PLANE.match(kind), LINE.match(kind)
        if not (plane or line):
            self.here.blocks.append((kind, np.zeros(len(data)), None))
            return
        self.axisymmetric |= plane is not None and "AX" in plane.group(1)
        count = int(plane.group(2)) if plane else 2
        numbers = whole_numbers(data)
        if len(numbers) % (count + 1):
            raise ValueError("elements of type %s have %d nodes" % (kind, count))
        table = np.array(numbers, dtype=np.int64).reshape(-1, count + 1)
        kind = "line" if line else "triangle" if count == 3 else "quad"
        self.here.blocks.append((kind, table[:, 0], table[:, 1:]))
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
        if not self.mesh.refused:
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
            for kind, ids, nodes in instance.scope.blocks:
                if nodes is None:
                    self.mesh.add(kind, ids)
                    continue
                if not len(ids):
                    continue
                rows = self.node_rows(instance, ids, nodes)
                got = self.mesh.add(kind, rows, ids if plain else None, instance.name or "mesh")
                dim = 1 if kind == "line" else 2
                before = len(instance.element)
                instance.element.update(
                    (e, (dim, r)) for e, r in zip(ids.tolist(), got.tolist())
                )
                if len(instance.element) != before + len(ids):
                    raise MeshError("an element number stands twice")
        ids = self.mesh.element_id
        if ids is not None and len(set(ids.tolist())) != len(ids):
            self.mesh.element_id = None
            self.mesh.notes.append(
                "elements numbered anew: several parts have the same numbers"
            )

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
            rows = [r for dim, r in instance.element.values() if dim == 2]
            self.mesh.groups.append(Group(2, instance.name, rows, rank=2))
        for name in scope.sets["NSET"]:
            if name not in scope.internal:
                rows = self.members("NSET", scope, instance, name)
                self.mesh.groups.append(Group(0, prefix + scope.shown[name], rows))
        for name in scope.sets["ELSET"]:
            if name not in scope.internal:
                found = self.members("ELSET", scope, instance, name)
                for dim in (2, 1):
                    rows = [r for d, r in found if d == dim]
                    rank = 0 if name in scope.declared else 1
                    self.mesh.groups.append(
                        Group(dim, prefix + scope.shown[name], rows, rank=rank)
                    )
        for name, (kind, owner, rows) in scope.surfaces.items():
            self.add_surface(instance, prefix + scope.shown[name], kind, owner, rows)

    def add_surface(self, instance, name, kind, owner, rows):
        """Faces S1 to S4 of elements (E1 to E4 of shells) become lines."""
        target = self.instance(owner) if owner else instance
        what = "NSET" if kind == "NODE" else "ELSET"
        pairs, left = [], 0
        for words in rows:
            if words[0].isdigit():
                found = [self.row(what, target, int(words[0]), name)]
            else:
                found = self.named_set(what, instance.scope, target, owner, words[0])
            if what == "NSET":
                pairs += found
                continue
            face = re.match(r"[SE]([1-4])$", words[1] if len(words) > 1 else "")
            edges = [self.edge(e, int(face.group(1))) for e in found if face and e[0] == 2]
            pairs += edges
            left += len(found) - len(edges)
        if left:
            self.mesh.notes.append(
                'faces of the surface "%s" that are no edges left out: %d' % (name, left)
            )
        if pairs:
            members = pairs if what == "NSET" else self.mesh.add("line", pairs)
            self.mesh.groups.append(Group(0 if what == "NSET" else 1, name, members))

    def edge(self, element, face):
        corner = self.mesh.corners[element[1]]
        count = 3 if corner[3] == corner[2] else 4
        if face > count:
            raise MeshError("a triangle has no face S%d" % face)
        return corner[face - 1], corner[face % count]
