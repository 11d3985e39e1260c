"""Reads the part of the deck format that the second implementation needs.

Fields have 10 columns, those of nodes 8 and 16, those of elements 8. A keyword or a field that
is not understood is an error."""

from collections import defaultdict
from types import SimpleNamespace

WITHOUT_EFFECT = ("KEYWORD", "TITLE", "END", "COMMENT", "CONTROL_IMPLICIT_SOLUTION", "BIPACT_LEDGER")
FAR = 1.0e20


class DeckError(Exception):
    """The deck asks for what the second implementation does not have."""


def number(text, default=0.0):
    """Returns the value of a field; a blank one gives the default."""
    text = text.strip()
    if not text:
        return default
    text = text.lower().replace("d", "e")
    for i in range(1, len(text)):
        if text[i] in "+-" and text[i - 1] in "0123456789.":
            text = text[:i] + "e" + text[i:]
            break
    return float(text)


def whole(text, default=0):
    """Returns the integer value of a field."""
    return int(text) if text.strip() else default


def fields(line, width=10, count=8):
    """Splits a line into fields of constant width."""
    line = line.rstrip("\n").ljust(width * count)
    return [line[i * width : (i + 1) * width] for i in range(count)]


def blocks(path):
    """Yields (keyword, cards) of a deck."""
    keyword, cards = None, []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if line.startswith("$"):
                continue
            if line.startswith("*"):
                if keyword:
                    yield keyword, cards
                keyword, cards = line[1:].strip().upper(), []
                if keyword == "END":
                    break
            else:
                cards.append(line.rstrip("\n"))
    if keyword:
        yield keyword, cards


class Reader:
    """Collects a deck in plain lists and dictionaries."""

    def __init__(self, path):
        self.deck = SimpleNamespace(
            end=None, dt=None, theta=None, xi=None, mass="CONSISTENT", courant=None, tol=1e-10,
            frame="START", pentol=1e-9, nodes={}, elements=[], parts={}, sections={},
            materials={}, node_sets={}, part_sets={}, curves={}, fixed=[], velocities=[],
            forces=[], gravity=[], contacts=[], walls=[], sides={},
        )
        self.counts = defaultdict(int)
        for keyword, cards in blocks(path):
            self.read(keyword, cards)
        deck = self.deck
        deck.theta = 0.5 if deck.theta is None else deck.theta
        deck.xi = deck.theta if deck.xi is None else deck.xi

    def read(self, keyword, cards):
        """Reads the cards of one keyword."""
        if keyword in WITHOUT_EFFECT or keyword.startswith("DATABASE_"):
            return
        for ending in ("_TITLE", "_ID"):
            if keyword.endswith(ending):
                keyword = keyword[: -len(ending)]
                self.title, cards = cards[0], cards[1:]
                break
        else:
            self.title = None
        aliases = {"SET_NODE": "SET_NODE_LIST", "SET_PART": "SET_PART_LIST",
                   "MAT_001": "MAT_ELASTIC", "LOAD_NODE": "LOAD_NODE_POINT"}
        name = "read_" + aliases.get(keyword, keyword).lower()
        if name.startswith("read_contact_2d_automatic_"):
            self.read_contact(name[len("read_contact_2d_automatic_") :], cards)
        elif hasattr(self, name):
            getattr(self, name)(cards)
        else:
            raise DeckError(f"keyword *{keyword} is not read")

    def read_control_termination(self, cards):
        self.deck.end = number(fields(cards[0])[0])

    def read_control_implicit_general(self, cards):
        self.deck.dt = number(fields(cards[0])[1])

    def read_control_implicit_dynamics(self, cards):
        if whole(fields(cards[0])[0]) != 1:
            raise DeckError("only dynamics (IMASS 1)")

    def read_bipact_time(self, cards):
        f = fields(cards[0])
        if f[0].strip().upper() not in ("", "THETA"):
            raise DeckError("only SCHEME THETA")
        self.deck.theta, self.deck.xi = number(f[1], None), number(f[2], None)

    def read_bipact_mass(self, cards):
        f = fields(cards[0])
        self.deck.mass = f[0].strip().upper() or "CONSISTENT"
        if whole(f[1]):
            raise DeckError("no REDIST")
        self.deck.courant = number(f[2], None)

    def read_bipact_contact(self, cards):
        self.deck.tol = number(fields(cards[0])[1], 1e-10)
        if len(cards) > 1:
            f = fields(cards[1])
            self.deck.frame = f[1].strip().upper() or "START"
            self.deck.pentol = number(f[2], 1e-9)

    def read_bipact_pair(self, cards):
        for card in cards:
            f = fields(card)
            self.deck.sides[whole(f[0])] = f[1].strip().upper() or "AUTO"

    def read_node(self, cards):
        for card in cards:
            self.deck.nodes[int(card[:8])] = (number(card[8:24]), number(card[24:40]))

    def read_element_shell(self, cards):
        for card in cards:
            f = [whole(x) for x in fields(card, 8, 6)]
            corners = f[2:6]
            if corners[3] in (0, corners[2]):
                corners = corners[:3]
            self.deck.elements.append((f[0], f[1], corners))

    def read_part(self, cards):
        for card in cards[1::2]:
            f = [whole(x) for x in fields(card)[:3]]
            self.deck.parts[f[0]] = (f[1], f[2])

    def read_section_shell(self, cards):
        for first, second in zip(cards[::2], cards[1::2]):
            f = fields(first)
            self.deck.sections[whole(f[0])] = (whole(f[1]), number(fields(second)[0]) or 1.0)

    def read_mat_elastic(self, cards):
        f = fields(cards[0])
        self.deck.materials[whole(f[0])] = tuple(number(x) for x in f[1:4])

    def read_list(self, cards, into):
        ids = [whole(x) for card in cards[1:] for x in fields(card)]
        into[whole(fields(cards[0])[0])] = [i for i in ids if i]

    def read_set_node_list(self, cards):
        self.read_list(cards, self.deck.node_sets)

    def read_set_part_list(self, cards):
        self.read_list(cards, self.deck.part_sets)

    def read_boundary_spc_set(self, cards):
        for card in cards:
            f = [whole(x) for x in fields(card)]
            self.deck.fixed.append((("set", f[0]), f[2], f[3]))

    def read_boundary_spc_node(self, cards):
        for card in cards:
            f = [whole(x) for x in fields(card)]
            self.deck.fixed.append((("node", f[0]), f[2], f[3]))

    def read_initial_velocity(self, cards):
        v = [number(x) for x in fields(cards[1])[:2]]
        self.deck.velocities.append((("set", whole(fields(cards[0])[0])), v))

    def read_initial_velocity_node(self, cards):
        for card in cards:
            f = fields(card)
            self.deck.velocities.append((("node", whole(f[0])), [number(x) for x in f[1:3]]))

    def read_loads(self, cards, kind):
        for card in cards:
            f = fields(card)
            self.deck.forces.append(
                ((kind, whole(f[0])), whole(f[1]) - 1, whole(f[2]), number(f[3]) or 1.0)
            )

    def read_load_node_set(self, cards):
        self.read_loads(cards, "set")

    def read_load_node_point(self, cards):
        self.read_loads(cards, "node")

    def read_gravity(self, cards, direction):
        f = fields(cards[0])
        self.deck.gravity.append((direction, whole(f[0]), number(f[1]) or 1.0))

    def read_load_body_x(self, cards):
        self.read_gravity(cards, 0)

    def read_load_body_y(self, cards):
        self.read_gravity(cards, 1)

    def read_define_curve(self, cards):
        f = fields(cards[0])
        sfa, sfo = number(f[2]) or 1.0, number(f[3]) or 1.0
        offa, offo = number(f[4]), number(f[5])
        points = [[number(x) for x in fields(card, 20, 2)] for card in cards[1:]]
        self.deck.curves[whole(f[0])] = (
            [sfa * (a + offa) for a, _ in points],
            [sfo * (o + offo) for _, o in points],
        )

    def read_contact(self, kind, cards):
        kinds = ("surface_to_surface", "node_to_surface", "single_surface")
        if kind not in kinds:
            raise DeckError(f"contact {kind} is not read")
        f = fields(cards[0])
        self.counts["contact"] += 1
        identity = whole(self.title[:10]) if self.title else self.counts["contact"]
        if len(cards) > 1:
            g = fields(cards[1])
            if number(g[0]) > 0 or 0 < number(g[1]) < FAR:
                raise DeckError("no birth or death of a contact")
        self.deck.contacts.append(
            SimpleNamespace(kind=kind, id=identity, a=whole(f[0]), b=whole(f[1]), mu=number(f[4]))
        )

    def read_rigidwall_planar(self, cards):
        f, g = fields(cards[0]), fields(cards[1])
        self.counts["wall"] += 1
        if number(f[4]) > 0 or 0 < number(f[5]) < FAR:
            raise DeckError("no birth or death of a wall")
        friction = number(g[6])
        self.deck.walls.append(
            SimpleNamespace(
                id=self.counts["wall"], nodes=whole(f[0]), mu=1e6 if friction == 1 else friction,
                t=(number(g[0]), number(g[1])), h=(number(g[3]), number(g[4])),
            )
        )


def read_deck(path):
    """Returns the deck as a name space of lists and dictionaries."""
    return Reader(path).deck
