"""The deck of a study: read from the deck as a run understood it (deck.echo.k), written again
with another scheme, mass and step, and on finer meshes.

    deck = EchoDeck(path)
    finer = deck.refined()                 # every element in four; CannotRefine says why not
    deck.mesh_text(), deck.head(...)       # what all runs of a mesh share, and what one adds
"""

import math

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from cards import NODE, SHELL, TEN, card
from exact_scene import LONG, split, value

# What has a meaning on any mesh, or is refined with it.
REFINED = (
    "KEYWORD TITLE COMMENT END NODE ELEMENT_SHELL PART SECTION_SHELL DEFINE_CURVE "
    "INITIAL_VELOCITY INITIAL_VELOCITY_GENERATION RIGIDWALL_PLANAR BOUNDARY_SPC_SET "
    "BOUNDARY_PRESCRIBED_MOTION_SET LOAD_SEGMENT_SET SET_NODE_LIST SET_PART_LIST SET_SEGMENT "
    "SET_SHELL_LIST BOUNDARY_SPC_NODE DAMPING_GLOBAL DAMPING_PART_MASS DAMPING_PART_STIFFNESS"
).split()
REFINED_KINDS = (
    "BIPACT_",
    "CONTROL_",
    "DATABASE_",
    "MAT_",
    "CONTACT_2D_",
    "LOAD_BODY_",
    "PARAMETER",
)
# Output that costs time and is not compared.
LEFT_OUT = ("BIPACT_FIELD", "BIPACT_RESTART", "DATABASE_BINARY_D3PLOT", "BIPACT_TIMING")
EVERY_STEP = ("DATABASE_RCFORC", "DATABASE_RWFORC", "DATABASE_SPCFORC")
OWN = ("BIPACT_TIME", "BIPACT_MASS", "CONTROL_IMPLICIT_GENERAL", "CONTROL_IMPLICIT_DYNAMICS")
SET_OPTIONS = ("_TITLE", "_ID")


class CannotRefine(Exception):
    """The text says why."""


class Block:
    """A keyword and its lines: `name` without options and '+'."""

    def __init__(self, head, lines):
        self.head, self.lines = head, lines
        name = head[1:].split()[0].upper().rstrip("+")
        self.long = head.rstrip().endswith("+")
        self.titled = int(name.endswith(SET_OPTIONS))
        for option in SET_OPTIONS:
            name = name.removesuffix(option)
        self.name = name

    def fields(self, widths=TEN, first=0):
        """Fields of the lines from the first on."""
        return [split(x, LONG if self.long else widths) for x in self.lines[first:]]

    def __str__(self):
        return "\n".join([self.head, *self.lines])


class EchoDeck:
    """The blocks of a deck, and the numbers in it that a study asks for."""

    def __init__(self, blocks):
        self.blocks = blocks

    @classmethod
    def read(cls, path):
        blocks = []
        with open(path, encoding="utf-8", errors="surrogateescape") as lines:
            for line in lines:
                line = line.rstrip("\n")
                if line.startswith("*"):
                    blocks.append(Block(line, []))
                elif not line.startswith("$") and blocks:
                    blocks[-1].lines.append(line)
        return cls(blocks)

    def named(self, name):
        return [b for b in self.blocks if b.name == name]

    def card(self, name):
        """Fields of the first card of a keyword; [] without it."""
        found = self.named(name)
        return found[0].fields()[0] if found and found[0].lines else []

    def number(self, name, field, default=0.0):
        """A field, counted from 0, of the first card of a keyword."""
        fields = self.card(name)
        return value(fields[field], default) if field < len(fields) else default

    @property
    def step(self):
        """DT0 [T]"""
        return self.number("CONTROL_IMPLICIT_GENERAL", 1)

    @property
    def end(self):
        """ENDTIM [T]"""
        return self.number("CONTROL_TERMINATION", 0)

    @property
    def is_static(self):
        return self.number("CONTROL_IMPLICIT_DYNAMICS", 0) == 0.0

    def nodes(self):
        """{id: (fields of its card)}"""
        return {int(f[0]): f for b in self.named("NODE") for f in b.fields(NODE)}

    def elements(self):
        """[(id, part, corners)]"""
        found = []
        for block in self.named("ELEMENT_SHELL"):
            for f in block.fields(SHELL):
                corners = list(dict.fromkeys(int(n) for n in f[2:6] if n and int(n)))
                found.append((int(f[0]), int(f[1]), corners))
        return found

    def least_edge(self):
        """Length of the shortest edge of an element [L]."""
        nodes = {i: (value(f[1]), value(f[2])) for i, f in self.nodes().items()}
        return min(
            math.dist(nodes[a], nodes[b])
            for _, _, corners in self.elements()
            for a, b in zip(corners, corners[1:] + corners[:1])
        )

    # ---- as decks again

    def interval(self, name):
        """DT of a table [T], 0 without it."""
        return self.number(name, 0)

    def tables(self):
        """Keywords of the tables that are asked for, but those that are left out."""
        return [
            b.name
            for b in self.blocks
            if b.name.startswith("DATABASE_")
            and b.name not in LEFT_OUT
            and "HISTORY" not in b.name
            and self.interval(b.name) > 0.0
        ]

    def mesh_text(self):
        """All that the runs of a mesh share."""
        skip = OWN + LEFT_OUT + tuple(self.tables()) + ("KEYWORD", "END")
        kept = [str(b) for b in self.blocks if b.name not in skip]
        return "\n".join(["*KEYWORD", *kept, "*END", ""])

    def head(self, variant, mass, redist, dt, coarsest):
        """The cards of one run: {field: number} of a scheme, mass, step; `coarsest` is the
        largest step of the study, in which the rows of all runs coincide."""
        general = self.card("CONTROL_IMPLICIT_GENERAL")
        dynamics = (self.card("CONTROL_IMPLICIT_DYNAMICS") + 8 * [""])[:8]
        for place, name in ((1, "GAMMA"), (2, "BETA"), (7, "ALPHA")):
            dynamics[place] = variant.get(name)
        out = ["*CONTROL_IMPLICIT_GENERAL", card(TEN, general[0], dt, *general[2:8])]
        out += ["*CONTROL_IMPLICIT_DYNAMICS", card(TEN, *dynamics)]
        out += [str(b) for b in self.named("CONTROL_IMPLICIT_DYNAMICS")[1:]]
        time = [variant.get(n) for n in TIME_FIELDS]
        out += ["*BIPACT_TIME", card(TEN, *time), "*BIPACT_MASS", card(TEN, mass, redist)]
        for name in self.tables():
            rest = self.card(name)[1:]
            every = dt if name in EVERY_STEP else common_interval(self.interval(name), coarsest)
            out += ["*" + name, card(TEN, every, *rest)]
        return "\n".join(out)

    def own_variant(self):
        """{field: number or word} of the deck's scheme, and (mass, redist)."""
        time = self.card("BIPACT_TIME") + 8 * [""]
        found = {"SCHEME": time[0].upper() or "THETA"}
        found.update({n: value(t) for n, t in zip(TIME_FIELDS[1:], time[1:]) if is_number(t)})
        words = {n: t for n, t in zip(TIME_FIELDS[1:], time[1:]) if t and not is_number(t)}
        found.update(words)
        for place, name, default in ((1, "GAMMA", 0.5), (2, "BETA", 0.25), (7, "ALPHA", 0.0)):
            given = self.number("CONTROL_IMPLICIT_DYNAMICS", place, default) or default
            if given != default:
                found[name] = given
        mass = self.card("BIPACT_MASS") + 2 * [""]
        return found, (mass[0].upper() or "CONSISTENT", int(value(mass[1])))

    def refined(self):
        """Every element in four, with the sets; ids stay, new ones follow."""
        return Refinement(self).deck()


TIME_FIELDS = ("SCHEME", "THETA", "XI", "REST", "RHOINF", "RULE", "PBETA")


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def common_interval(interval, coarsest):
    """The interval of a table, made a multiple of the largest step."""
    return max(1, math.ceil(interval / coarsest - 1.0e-9)) * coarsest


class Refinement:
    """Mid-points of edges and centres of quadrilaterals become nodes.

    A mid-point belongs to a node set where both ends of its edge do and the edge is on the
    boundary, or an element beside it is in the set as a whole; a centre with its element."""

    def __init__(self, deck):
        for block in deck.blocks:
            if block.name not in REFINED and not block.name.startswith(REFINED_KINDS):
                raise CannotRefine("*%s is not known on another mesh" % block.name)
        self.old, self.nodes, self.cells = deck, deck.nodes(), deck.elements()
        self.next_node = max(self.nodes) + 1
        self.next_cell = max(c[0] for c in self.cells) + 1
        self.middle, self.beside, self.centre, self.children = {}, {}, {}, {}
        self.new_nodes, self.new_cells = dict(self.nodes), []
        for number, part, corners in self.cells:
            self.split_cell(number, part, corners)

    def add_node(self, corners):
        """A node at the mean of others; held as all of them are."""
        cards = [self.nodes[n] for n in corners]
        x, y = (np.mean([value(f[k]) for f in cards]) for k in (1, 2))
        held = {f[4] for f in cards}
        number, self.next_node = self.next_node, self.next_node + 1
        fields = [str(number), float(x), float(y), cards[0][3]]
        self.new_nodes[number] = fields + [held.pop() if len(held) == 1 else "", ""]
        return number

    def split_cell(self, number, part, corners):
        edges = list(zip(corners, corners[1:] + corners[:1]))
        mids = []
        for edge in edges:
            key = tuple(sorted(edge))
            if key not in self.middle:
                self.middle[key] = self.add_node(key)
            self.beside.setdefault(key, []).append(corners)
            mids.append(self.middle[key])
        if len(corners) == 3:
            parts = [(corners[k], mids[k], mids[k - 1]) for k in range(3)] + [tuple(mids)]
        else:
            self.centre[tuple(corners)] = c = self.add_node(corners)
            parts = [(corners[k], mids[k], c, mids[k - 1]) for k in range(4)]
        ids = [number] + [self.next_cell + k for k in range(3)]
        self.next_cell += 3
        self.children[number] = ids
        self.new_cells += [(i, part, p) for i, p in zip(ids, parts)]

    def grown(self, members):
        """New nodes that belong to a set of nodes."""
        members = set(members)
        found = []
        for (a, b), middle in self.middle.items():
            if a in members and b in members:
                cells = self.beside[a, b]
                if len(cells) == 1 or any(members.issuperset(c) for c in cells):
                    found.append(middle)
        found += [c for corners, c in self.centre.items() if members.issuperset(corners)]
        return found

    def deck(self):
        blocks, placed = [], set()
        for block in self.old.blocks:
            if block.name in ("NODE", "ELEMENT_SHELL"):
                if block.name not in placed:
                    blocks.append(self.mesh_block(block.name))
                    placed.add(block.name)
            elif block.name in ("SET_NODE_LIST", "SET_SHELL_LIST"):
                blocks.append(self.list_block(block))
            elif block.name == "SET_SEGMENT":
                blocks.append(self.segment_block(block))
            elif block.name == "BOUNDARY_SPC_NODE":
                blocks.append(self.support_block(block))
            else:
                blocks.append(block)
        return EchoDeck(blocks)

    def mesh_block(self, name):
        if name == "NODE":
            return Block("*NODE", [card(NODE, *f[:6]) for f in self.new_nodes.values()])
        fill = [(i, p, *c, *([0] if len(c) == 3 else [])) for i, p, c in self.new_cells]
        return Block("*ELEMENT_SHELL", [card(SHELL, *f) for f in fill])

    def list_block(self, block):
        first = block.titled + 1
        members = [int(n) for f in block.fields(first=first) for n in f if n and int(n)]
        if block.name == "SET_NODE_LIST":
            members += self.grown(members)
        else:
            members = [i for n in members for i in self.children[n]]
        cards = [card(TEN, *members[k : k + 8]) for k in range(0, len(members), 8)]
        return Block(block.head.replace("+", ""), set_head(block) + cards)

    def segment_block(self, block):
        first = block.titled + 1
        cards = []
        for f in block.fields(first=first):
            a, b = int(f[0]), int(f[1])
            middle = self.middle.get(tuple(sorted((a, b))))
            if middle is None:
                raise CannotRefine("a segment of *SET_SEGMENT is no edge of an element")
            cards += [card(TEN, a, middle, 0, 0), card(TEN, middle, b, 0, 0)]
        return Block(block.head.replace("+", ""), set_head(block) + cards)

    def support_block(self, block):
        """Held nodes: mid-points and centres where all are held alike."""
        groups, lines = {}, list(block.lines)
        for f in block.fields():
            groups.setdefault(tuple(f[1:8]), []).append(int(f[0]))
        if block.titled:
            raise CannotRefine("*BOUNDARY_SPC_NODE with a heading")
        for rest, members in groups.items():
            lines += [
                card(LONG if block.long else TEN, str(n), *rest) for n in self.grown(members)
            ]
        return Block(block.head, lines)


def set_head(block):
    """Heading and first card of a set; long fields in comma form, to stand among short ones."""
    first = block.lines[block.titled]
    return block.lines[: block.titled] + [",".join(split(first, LONG)) if block.long else first]
