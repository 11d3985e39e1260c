"""The step of the second implementation: free motion, contact, verification, ledger, overlap."""

from types import SimpleNamespace

import numpy as np
import second_cone
from second_contact import APART, Boundary, Pair, Shape, Side, Wall
from second_deck import DeckError, read_deck
from second_fem import Body
from second_old import OldPair
from second_overlap import overlap

ROUNDS = 3
CLOSED = 1e-12  # closing of round-off, of the largest term of the ledger, is free
WORTH_TRYING = 0.1  # a short purse stays shut until it holds this share of what was wanted


class Failure(Exception):
    """The run cannot go on."""


class Card:
    """A contact card or a wall: its friction, its purse and its force."""

    def __init__(self, kind, identity, mu):
        self.kind, self.id, self.mu = kind, identity, mu
        self.purse, self.wanted = 0.0, 0.0
        self.beta, self.short, self.shut = 1.0, False, False


def parts_of(deck, identity):
    return sorted(deck.parts) if identity == 0 else deck.part_sets[identity]


class Run:
    """A deck in motion. rule 'new' or 'old'; `closing` limits beta to [0, closing];
    nudge is added once to the offset of the first row that carries a force."""

    def __init__(self, path, rule="new", frame=None, closing=None, purse=True, nudge=0.0, side=None):
        self.deck = read_deck(path)
        self.rule, self.nudge, self.purse = rule, nudge, purse
        self.closing = 1.0 if closing is None else closing
        self.frame = "REF" if rule == "old" else frame or self.deck.frame
        self.side = side
        self.body = Body(self.deck)
        self.boundary = Boundary(self.body)
        self.make_pairs()
        self.theta, self.xi, self.h = self.deck.theta, self.deck.xi, self.deck.dt
        self.steps = int(round(self.deck.end / self.h))
        b, n = self.body, self.body.n
        mass = np.kron(b.mass, np.eye(2))
        a = mass / (self.theta * self.h**2) + self.xi * b.stiffness
        self.inverse = np.zeros((2 * n, 2 * n))
        free = np.ix_(b.free, b.free)
        self.inverse[free] = np.linalg.inv(a[free])
        self.inverse = (self.inverse + self.inverse.T) / 2
        self.effective, self.big_mass = a, mass
        self.u, self.v = np.zeros((n, 2)), b.v0.copy()
        self.warm, self.counts = {}, dict.fromkeys(("late", "redone", "added", "purse"), 0)
        kinetic, internal = self.energies()
        self.sums = dict(external=0.0, friction=0.0, contact=0.0, unsolved=0.0, algorithmic=0.0)
        self.initial = kinetic + internal
        self.largest = abs(self.initial)
        self.largest = max(self.largest, 0.0)
        self.result = SimpleNamespace(u=[self.u.copy()], energy=[], impulse=[], rows=[], overlap=[])
        self.impulse = {card: np.zeros(2) for card in self.cards}
        self.note(kinetic, internal, [], [])

    def make_pairs(self):
        """Builds sides, pairs and walls from the cards."""
        deck, self.cards, self.pairs, self.walls = self.deck, [], [], []
        named = set()
        for contact in deck.contacts:
            if contact.kind != "single_surface" and contact.a > 0 and contact.b > 0:
                for p in parts_of(deck, contact.a):
                    named |= {frozenset((p, q)) for q in parts_of(deck, contact.b)}
        for contact in deck.contacts:
            card = Card(contact.kind, contact.id, contact.mu)
            self.cards.append(card)
            rule = self.side or deck.sides.get(contact.id, "AUTO")
            if contact.kind == "single_surface":
                parts = sorted(parts_of(deck, contact.a))
                for place, p in enumerate(parts):
                    for q in parts[place:]:
                        if frozenset((p, q)) not in named:
                            self.add_pair(card, [p], [q], rule)
            else:
                sides = [
                    parts_of(deck, s) if s > 0 else -s for s in (contact.a, contact.b)
                ]
                if contact.kind == "node_to_surface":
                    rule = "A"  # the nodes of SURFA are exact
                self.add_pair(card, *sides, rule)
        for wall in deck.walls:
            card = Card("wall", wall.id, wall.mu)
            wall.card = card
            self.cards.append(card)
            made = Wall(wall, self.body.nodes_of(("set", wall.nodes)))
            made.card = card
            self.walls.append(made)

    def add_pair(self, card, first, second, rule):
        same = first == second
        one = self.make_side(first, True)
        two = one if same else self.make_side(second, False)
        if self.rule == "old":
            if same:
                raise DeckError("the old rule has no self contact")
            self.pairs.append(OldPair(self.boundary, card, one, two, rule))
        else:
            self.pairs.append(Pair(self.boundary, card, one, two, rule))

    def make_side(self, what, first):
        """Returns the side of a list of parts, or of a node set."""
        edges = self.boundary.edges
        if isinstance(what, list):
            inside = np.isin(self.body.edge_part, what)
            nodes = set(edges[inside].ravel().tolist())
        else:
            nodes = set(self.body.nodes_of(("set", what)))
            inside = np.array([a in nodes and b in nodes for a, b in edges])
        return Side(self.boundary, nodes, np.nonzero(inside)[0], first)

    def energies(self):
        force, internal = self.body.elastic(self.u)
        self.elastic_force = force
        return 0.5 * np.sum(self.v * (self.body.mass @ self.v)), internal

    def rows_at(self, x, motion, reaches=None):
        """Returns all rows at positions x, in the order of pairs, nodes and edges."""
        shape = Shape(self.boundary, x, self.frame)
        rows = []
        for place, pair in enumerate(self.pairs):
            reach = reaches[place] if reaches else pair.reach(motion)
            rows += pair.rows(shape, motion, reach)
        for wall in self.walls:
            rows += wall.rows(x)
        return rows

    def offset(self, row):
        if self.rule == "old":
            return row.gap
        c = row.gap if row.exact else row.gap + row.delta
        return c if c >= 0 else row.card.beta * c

    def solve_once(self, rows):
        """Solves the law for the rows; returns the motion and fills row.r, row.c, row.u."""
        n = self.body.n
        if not rows:
            return self.free_motion
        h = np.zeros((2 * len(rows), 2 * n))
        for a, row in enumerate(rows):
            tangent = np.array([-row.normal[1], row.normal[0]])
            for k, weight in [(row.node, 1.0)] + [(k, -w) for k, w in row.places]:
                h[2 * a, 2 * k : 2 * k + 2] += weight * row.normal
                h[2 * a + 1, 2 * k : 2 * k + 2] += weight * tangent
            row.c = self.offset(row) + row.nudge
        inner = self.inverse @ h.T
        w = h @ inner
        w = (w + w.T) / 2
        q = h @ self.free_motion.reshape(-1)
        q[0::2] += [row.c for row in rows]
        mu = np.array([row.mu for row in rows])
        start = np.zeros(2 * len(rows))
        for a, row in enumerate(rows):
            force = self.warm.get((id(row.group[0]), row.group[1], *row.key()))
            if force is not None:
                start[2 * a] = max(0.0, force @ row.normal)
                start[2 * a + 1] = force @ np.array([-row.normal[1], row.normal[0]])
        r = second_cone.solve(w, q, mu, start)
        du = self.free_motion + (inner @ r).reshape(-1, 2)
        u = h @ du.reshape(-1)
        for a, row in enumerate(rows):
            row.r = r[2 * a : 2 * a + 2]
            row.u = u[2 * a : 2 * a + 2] + np.array([row.c, 0.0])
            row.force = row.r[0] * row.normal + row.r[1] * np.array([-row.normal[1], row.normal[0]])
        return du

    def solve(self, rows):
        """Solves with beta as large as the purses allow, whatever the rows before asked for."""
        for card in self.cards:
            card.short, card.beta = card.shut, 0.0 if card.shut else self.closing
        while True:
            du = self.solve_once(rows)
            if self.rule != "new" or not self.purse or not self.shorten(rows):
                return du
            self.counts["purse"] += 1

    def shorten(self, rows):
        """Lowers beta where more was given than the purse holds; tells whether it had to."""
        short = False
        for card in self.cards:
            mine = [row for row in rows if row.card is card]
            gain = -sum(row.r[0] * row.c for row in mine if row.c < 0)
            have = card.purse + sum(row.r[0] * row.c for row in mine if row.c > 0)
            if gain <= have + CLOSED * self.largest:
                continue
            if card.short:
                card.beta = 0.0
            else:
                card.wanted, card.beta = gain, max(0.0, card.beta * have / gain)
            card.short = short = True
        return short

    def start_purses(self):
        """Shuts the purses that the last step left nearly empty."""
        for card in self.cards:
            card.shut = card.short and card.purse < WORTH_TRYING * card.wanted

    def step(self, number):
        """Advances by one step; returns the rows of the solve."""
        b, h = self.body, self.h
        p0, p1 = b.load((number - 1) * h), b.load(number * h)
        weighted = (1 - self.xi) * p0 + self.xi * p1
        right = (b.mass @ self.v).reshape(-1) / (self.theta * h) + weighted - self.elastic_force
        self.free_motion = (self.inverse @ right).reshape(-1, 2)
        motion, x0 = self.free_motion, b.x + self.u
        reaches = [pair.reach(motion) for pair in self.pairs]
        known = self.rows_at(x0, motion, reaches)
        for row in known:
            row.nudge = 0.0
            if isinstance(row.group[0], Wall):
                far = row.gap + row.normal @ motion[row.node] > 0.25 * self.boundary.length.min()
                row.exact = row.exact and not far
        active = [row for row in known if row.exact]
        self.start_purses()
        du = self.solve(active)
        if self.nudge and any(row.r[0] > 0 for row in active):
            max(active, key=lambda row: row.r[0]).nudge = self.nudge
            self.nudge = 0.0
            du = self.solve(active)
        du, active = self.verify(du, active, known, x0, reaches)
        self.accept(du, active, weighted)
        return active

    def verify(self, du, active, known, x0, reaches):
        """Adds late rows and sets frames to the end of the step (section 5.1)."""
        rounds = 0
        order = {id(pair): k for k, pair in enumerate(self.pairs + self.walls)}
        while True:
            held = {id(row) for row in active}
            late = [
                row for row in known
                if id(row) not in held and row.gap + row.normal @ row.relative_motion(du) < -row.delta
            ]
            self.counts["late"] += len(late)
            changed = bool(late)
            active += late
            if not late and self.rule == "new" and rounds < ROUNDS:
                changed = self.redo(du, active, known, x0, reaches)
                rounds += changed
            if not changed:
                return du, active
            active.sort(key=lambda row: (order[id(row.group[0])], row.group[1], row.key()))
            du = self.solve(active)

    def redo(self, du, active, known, x0, reaches):
        """Rows that lost too much get the frame of the end; returns whether there were any."""
        changed = False
        for new in self.rows_at(x0 + du, np.zeros_like(du), reaches):
            if isinstance(new.group[0], Wall) or new.gap >= -1.5 * new.delta:
                continue
            fit = [
                row for row in known
                if row.group == new.group and row.node == new.node
                and row.normal @ new.normal > APART
            ]
            start = new.normal @ new.relative(x0)
            held = [row for row in fit if row in active]
            if held:
                row = max(held, key=lambda row: row.normal @ new.normal)
                if min(row.gap, 0.0) - new.gap <= new.delta:
                    continue
                row.edge, row.vertex, row.places = new.edge, new.vertex, new.places
                row.normal, row.gap, row.length = new.normal, start, new.length
                self.counts["redone"] += 1
            else:
                # It takes the place of what was kept apart for the same node and direction.
                known[:] = [row for row in known if row not in fit] + [new]
                new.gap, new.nudge = start, 0.0
                active.append(new)
                self.counts["added"] += 1
            changed = True
        return changed

    def accept(self, du, active, weighted):
        """Takes the motion over: velocities, ledger, purses, tables."""
        flat, sums = du.reshape(-1), self.sums
        v1 = (du / self.h - (1 - self.theta) * self.v) / self.theta
        dv = v1 - self.v
        sums["external"] += flat @ weighted
        sums["algorithmic"] += (self.theta - 0.5) * np.sum(dv * (self.body.mass @ dv))
        sums["algorithmic"] += (self.xi - 0.5) * 2 * self.body.elastic(du)[1]
        self.warm = {}
        force = {card: np.zeros(2) for card in self.cards}
        for row in active:
            lost = row.r[0] * row.c
            slid = row.mu * row.r[0] * abs(row.u[1])
            sums["contact"] += lost
            sums["friction"] += slid
            sums["unsolved"] += row.r @ row.u + slid
            row.card.purse += lost
            force[row.card] += -row.force if row.group[1] else row.force
            self.warm[(id(row.group[0]), row.group[1], *row.key())] = row.force
        for card in self.cards:
            self.impulse[card] += self.h * force[card]
        self.u = self.u + du
        self.v = v1
        kinetic, internal = self.energies()
        for value in (kinetic, internal, kinetic + internal, *sums.values()):
            self.largest = max(self.largest, abs(value))
        self.note(kinetic, internal, active, force)

    def note(self, kinetic, internal, active, force):
        """Adds a line to the tables."""
        result, s = self.result, self.sums
        total = kinetic + internal
        balance = total - self.initial - s["external"] + s["friction"] + s["contact"]
        balance += s["algorithmic"] - s["unsolved"]
        result.energy.append(
            [kinetic, internal, total, s["external"], s["friction"], s["contact"],
             s["unsolved"], s["algorithmic"], balance / (self.largest or 1.0)]
        )
        result.impulse.append([self.impulse[card].copy() for card in self.cards])
        result.u.append(self.u.copy())
        kinds = [sum(1 for row in active if row.exact), sum(1 for row in active if not row.exact)]
        result.rows.append([*kinds, sum(1 for row in active if row.r[0] > 0)])
        x = self.body.x + self.u
        pairs = [overlap(self.boundary, x, *pair.sides) for pair in self.pairs]
        result.overlap.append(max(pairs, default=0.0))

    def run(self, steps=None):
        """Runs to the end; returns the tables as arrays."""
        for number in range(1, (steps or self.steps) + 1):
            try:
                self.step(number)
            except second_cone.NoSolution as problem:
                raise Failure(f"step {number}: no contact solution: {problem}") from problem
        r = self.result
        r.u = np.array(r.u[1:])
        r.energy, r.rows = np.array(r.energy), np.array(r.rows)
        r.impulse, r.overlap = np.array(r.impulse), np.array(r.overlap)
        r.counts = self.counts
        return r
