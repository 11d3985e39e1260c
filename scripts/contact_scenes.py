"""Static scenes of two bodies in contact, with closed forms in analytic.py; make_scenes.py writes
them, as it does the others.

    patch        two blocks whose faces do not match, under one oblique stress
    hertz        a parabola on a flat block, pressed, then dragged (Hertz; Cattaneo, Mindlin)
    cylinder     NAFEMS contact benchmark 1: a steel cylinder on a block of aluminium
    westergaard  a wavy face on a flat one, half a wave
    punch        a stiff flat punch without friction on a half plane
    rod          a rod is pushed through a gap against another (Signorini)

All take pairing (MORTAR), side (AUTO, A = upper body, B), mu and angle. E, PR: young, poisson."""

import math

from placed import turned

CURVE = ["*DEFINE_CURVE", "1,", "0.0,0.0", "1.0,1.0", "1.0e3,1.0"]


class Block:
    """A part from a grid of lines: at(i, j) is node j of column i; shape(x, t), t in [0, 1] from
    its lower to its upper face, places it."""

    def __init__(self, part, xs, ts, shape, young, poisson):
        self.part, self.young, self.poisson = part, young, poisson
        self.first, self.rows, self.columns = 100000 * part + 1, len(ts), len(xs)
        self.place = {self.at(i, j): shape(x, t) for i, x in enumerate(xs) for j, t in enumerate(ts)}

    def at(self, i, j):
        return self.first + (i % self.columns) * self.rows + j % self.rows

    def row(self, j):
        return [self.at(i, j) for i in range(self.columns)]

    def column(self, i):
        return [self.at(i, j) for j in range(self.rows)]

    def elements(self, mirror):
        for i in range(self.columns - 1):
            for j in range(self.rows - 1):
                ring = self.at(i, j), self.at(i + 1, j), self.at(i + 1, j + 1), self.at(i, j + 1)
                yield ring[::-1] if mirror else ring


def static_deck(o, title, blocks, cards, steps, pair):
    """The text of a deck of `steps` equal load steps of length 1; pair: contact fields."""
    out = ["*KEYWORD", "*TITLE", title, "*CONTROL_TERMINATION", "%r," % float(steps)]
    out += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % (o["dt"] or 1.0)]
    out += ["*CONTROL_IMPLICIT_DYNAMICS", "0,"]
    # Residuals of the passes and of contact add up to the error of an exact answer.
    out += ["*BIPACT_CONTACT", ",%r" % (o["tol"] or 1.0e-13)]
    out += [",%s" % pair["frame"]] if pair.get("frame") else []
    out += ["*BIPACT_STATIC", ",,1.0e-15"]
    out += ["*NODE"]
    for b in blocks:
        out += ["%d,%r,%r" % ((n,) + turned(o, *p)) for n, p in b.place.items()]
    out += ["*ELEMENT_SHELL"]
    rings = [(b.part, ring) for b in blocks for ring in b.elements(o["mirror"])]
    out += ["%d,%d,%d,%d,%d,%d" % ((k, part) + ring) for k, (part, ring) in enumerate(rings, 1)]
    out += ["*SECTION_SHELL", "1,13,,4", "1.0,"]
    for b in blocks:
        out += ["*PART", "body %d" % b.part, "%d,1,%d" % (b.part, b.part)]
        out += ["*MAT_ELASTIC", "%d,1.0,%r,%r" % (b.part, b.young, b.poisson)]
        out += ["*SET_PART_LIST", "%d," % b.part, "%d," % b.part]
    out += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "2,1,,,%r" % float(pair["mu"])]
    out += ["*BIPACT_PAIR", "1,%s,,,,%s" % (pair["side"], pair["pairing"])]
    out += CURVE + cards
    for table in ("GLSTAT", "NODOUT", "RCFORC", "NCFORC", "SLEOUT"):
        out += ["*DATABASE_" + table, "1.0,"]
    out += ["*DATABASE_HISTORY_NODE"]
    out += ["%d," % n for b in blocks for n in b.place]
    return "\n".join(out + ["*END", ""])


def hold(number, nodes, x=1, y=1):
    """Nodes that do not move in x, y."""
    out = ["*SET_NODE_LIST", "%d," % number]
    out += [",".join(map(str, nodes[k : k + 8])) + "," for k in range(0, len(nodes), 8)]
    return out + ["*BOUNDARY_SPC_SET", "%d,,%d,%d" % (number, x, y)]


def push(number, nodes, u, direction, curve=1):
    """Prescribed displacement u times the curve of a set of nodes; without nodes of a set that is
    there."""
    out = ["*SET_NODE_LIST", "%d," % number] if nodes else []
    out += [",".join(map(str, nodes[k : k + 8])) + "," for k in range(0, len(nodes), 8)]
    cards = ["*BOUNDARY_PRESCRIBED_MOTION_SET", "%d,%d,2,%d,%r" % (number, direction, curve, u)]
    return out + cards


def move(nodes, u, direction, curve=1):
    """Prescribed displacement: u(node) times the curve in a direction of 1, 2."""
    cards = ["*BOUNDARY_PRESCRIBED_MOTION_NODE"]
    return cards + ["%d,%d,2,%d,%r" % (n, direction, curve, u(n)) for n in nodes]


def graded(h, even, end, growth=1.25):
    """Lines from 0 to end: of distance h up to `even`, then growing; the last one fits."""
    lines = [h * k for k in range(int(round(even / h)) + 1)]
    count = 1
    while lines[-1] + h * growth * (growth**count - 1) / (growth - 1) < end:
        count += 1
    total = h * growth * (growth**count - 1) / (growth - 1)
    stretch = (end - lines[-1]) / total
    start = lines[-1]
    for k in range(1, count + 1):
        lines.append(start + stretch * h * growth * (growth**k - 1) / (growth - 1))
    lines[-1] = end
    return lines


def both_sides(lines):
    """Lines of a half, mirrored at 0."""
    return [-x for x in lines[:0:-1]] + lines


def heights(h, depth, growth=1.25):
    """t from the face, 0, to 1 at a depth."""
    return [y / depth for y in graded(h, h, depth, growth)]


# ---------------------------------------------------------------- patch test


def uneven(n, low, high, share):
    """Lines of n edges from low to high, shifted by up to a share of an edge."""
    shift = [0.0] + [share * math.sin(2.3 * k + 0.4) for k in range(1, n)] + [0.0]
    return [low + (high - low) * (k + s) / n for k, s in zip(range(n + 1), shift)]


def patch(o, upper=5, lower=3, low=0.0, high=1.0, slope=0.0, mu=0.3, pairing="MORTAR",
          side="AUTO", young=100.0, poisson=0.3, share=0.3):
    """Stress [-.3 .2; .2 -1] in both; the upper block stands on the part low..high of the lower
    one, whose other part carries the same traction as a load."""
    stress = ((-0.3, 0.2), (0.2, -1.0))
    base = Block(1, uneven(lower, 0.0, 1.0, share), uneven(3, 0.0, 1.0, share),
                 lambda x, t: (x, -1.0 + t * (1.0 + slope * x)), young, poisson)
    top = Block(2, uneven(upper, low, high, share), uneven(3, 0.0, 1.0, share),
                lambda x, t: (x, slope * x + t * (1.2 - slope * x)), young, poisson)
    place = {**base.place, **top.place}
    s11, s12, s22 = stress[0][0], stress[0][1], stress[1][1]
    e11 = (1 + poisson) * ((1 - poisson) * s11 - poisson * s22) / young
    e22 = (1 + poisson) * ((1 - poisson) * s22 - poisson * s11) / young
    e12 = (1 + poisson) * s12 / young
    exact = {
        n: turned(o, e11 * x + e12 * y, e12 * x + e22 * y) for n, (x, y) in place.items()
    }
    held = base.row(0) + top.row(-1)
    cards = move(held, lambda n: exact[n][0], 1) + move(held, lambda n: exact[n][1], 2)
    load = dict.fromkeys(place, (0.0, 0.0))

    def pull(a, b, begin=0.0, end=1.0):
        """Traction on the edge a-b, body on its left, between two local coordinates."""
        d = place[b][0] - place[a][0], place[b][1] - place[a][1]
        force = [stress[k][0] * d[1] - stress[k][1] * d[0] for k in (0, 1)]
        second = 0.5 * (end**2 - begin**2)
        for n, weight in ((a, end - begin - second), (b, second)):
            load[n] = tuple(f + weight * g for f, g in zip(load[n], force))

    for b in (base, top):
        for left, right in ((b.column(0)[::-1], b.column(-1)),):
            for line in (left, right):
                for a, c in zip(line, line[1:]):
                    pull(a, c)
    face = base.row(-1)[::-1]
    for a, c in zip(face, face[1:]):
        xa, xc = place[a][0], place[c][0]
        inside = [min(1.0, max(0.0, (xa - x) / (xa - xc))) for x in (high, low)]
        pull(a, c, 0.0, inside[0])
        pull(a, c, inside[1], 1.0)
    cards += ["*LOAD_NODE_POINT"]
    for n, force in load.items():
        cards += ["%d,%d,1,%r" % (n, k, f) for k, f in enumerate(turned(o, *force), 1) if f]
    normal = (-slope / math.hypot(1, slope), 1 / math.hypot(1, slope))
    t = [sum(stress[k][m] * normal[m] for m in (0, 1)) for k in (0, 1)]
    pressure = -(t[0] * normal[0] + t[1] * normal[1])
    shear = t[0] * normal[1] - t[1] * normal[0]
    text = static_deck(o, "patch test of contact", (base, top), cards, 1,
                       {"mu": mu, "side": side, "pairing": pairing})
    return text, {"dt": 1.0, "tend": 1.0, "exact": exact, "pressure": pressure, "shear": shear,
                  "normal": turned(o, *normal),
                  "faces": (top.row(0), base.row(-1))}


# ---------------------------------------------------------------- round on flat


def pressed(o, title, upper, lower, cards, steps, mu, side, pairing, more, frame=""):
    text = static_deck(o, title, (lower, upper), cards, steps,
                       {"mu": mu, "side": side, "pairing": pairing, "frame": frame})
    faces = upper.row(0), lower.row(-1)
    return text, dict(more, dt=o["dt"] or 1.0, tend=float(steps), faces=faces,
                      x={n: b.place[n][0] for b, f in zip((upper, lower), faces) for n in f})


def hertz_blocks(h, ratio, young, poisson, radius=1.0):
    """(upper, lower) block of case H, 2 x 1: the upper with the face y = x^2/(2 radius) and edges h
    near the middle, the lower flat with edges ratio h."""
    grids = [both_sides(graded(k * h, 0.09, 1.0)) for k in (1.0, ratio)]

    def curved(x, t):
        y = x * x / 2 / radius
        return x, y + t * (1.0 - y)

    upper = Block(2, grids[0], heights(h, 1.0), curved, young, poisson)
    lower = Block(1, grids[1], [1.0 - t for t in heights(ratio * h, 1.0)[::-1]],
                  lambda x, t: (x, t - 1.0), young, poisson)
    return upper, lower


def hertz(o, h=0.005, ratio=1.0, down=0.0030, drag=0.0007, steps=5, mu=0.3, pairing="MORTAR",
          side="B", young=1000.0, poisson=0.3, radius=1.0, frame=""):
    """The blocks of hertz_blocks. The top goes down by down/radius, so that the half width stays
    as it is, then sideways by drag/radius in steps."""
    upper, lower = hertz_blocks(h, ratio, young, poisson, radius)
    cards = hold(11, lower.row(0))
    cards += ["*DEFINE_CURVE", "2,", "0.0,0.0", "1.0,0.0", "%r,1.0" % (1.0 + steps)]
    cards += push(12, upper.row(-1), -down / radius, 2) + push(12, [], drag / radius, 1, 2)
    return pressed(o, "Hertz, Cattaneo, Mindlin", upper, lower, cards, 1 + steps, mu, side,
                   pairing, {"radius": radius, "modulus": young / (1 - poisson**2) / 2, "mu": mu,
                             "h": h, "down": down, "drag": drag, "steps": steps, "young": young,
                             "poisson": poisson}, frame)


def cylinder(o, h=0.8, ratio=1.0, load=35.0e3, mu=0.0, pairing="MORTAR", side="B"):
    """Half of a cylinder of radius 50, E 210000, on a block 200 x 200, E 70000, PR .3, plane
    strain, 35 kN per mm [mm, N]; of the cylinder what lies within 40 of its axis."""
    radius, end, poisson = 50.0, 40.0, 0.3
    upper = Block(2, graded(h, 8.8, end), heights(h, radius),
                  lambda x, t: (x, (1 - t) * (radius - math.sqrt(radius**2 - x * x)) + t * radius),
                  210000.0, poisson)
    lower = Block(1, graded(ratio * h, 8.8, 100.0),
                  [1.0 - t for t in heights(ratio * h, 200.0)[::-1]],
                  lambda x, t: (x, 200.0 * (t - 1.0)), 70000.0, poisson)
    cards = hold(11, lower.row(0)) + hold(12, lower.column(0) + upper.column(0), 1, 0)
    cards += ["*SET_SEGMENT", "1,"] + ["%d,%d" % e for e in zip(upper.row(-1), upper.row(-1)[1:])]
    cards += ["*LOAD_SEGMENT_SET", "1,1,%r" % (0.5 * load / end)]
    modulus = 1.0 / ((1 - poisson**2) * (1 / 210000.0 + 1 / 70000.0))
    return pressed(o, "NAFEMS contact benchmark 1", upper, lower, cards, 1, mu, side, pairing,
                   {"radius": radius, "modulus": modulus, "load": load})


def westergaard(o, upper=8, lower=12, wave=1.0e-3, contact=0.45, mu=0.0, pairing="MORTAR",
                side="AUTO", young=1000.0, poisson=0.3):
    """Half a wave of length 2: the upper face y = wave (1 - cos pi x) on a flat one, edges upper
    and lower; a mean pressure that closes the share `contact` of it."""
    modulus = young / (1 - poisson**2) / 2
    full = math.pi * modulus * wave / 2.0
    mean = full * math.sin(math.pi * contact / 2) ** 2
    def lines(n):
        return [k / n for k in range(n + 1)]
    face = [wave * (1 - math.cos(math.pi * x)) for x in lines(upper)]
    top = Block(2, lines(upper), heights(1.0 / upper, 2.0),
                lambda x, t: (x, (1 - t) * wave * (1 - math.cos(math.pi * x)) + 2.0 * t),
                young, poisson)
    base = Block(1, lines(lower), [1.0 - t for t in heights(1.0 / lower, 2.0)[::-1]],
                 lambda x, t: (x, 2.0 * (t - 1.0)), young, poisson)
    sides = [n for b in (base, top) for i in (0, -1) for n in b.column(i)]
    cards = hold(11, base.row(0), 0, 1) + hold(12, sides, 1, 0)
    cards += ["*SET_SEGMENT", "1,"] + ["%d,%d" % e for e in zip(top.row(-1), top.row(-1)[1:])]
    cards += ["*LOAD_SEGMENT_SET", "1,1,%r" % mean]
    assert face[0] == 0.0
    return pressed(o, "Westergaard's wave", top, base, cards, 1, mu, side, pairing,
                   {"wave": 2.0, "mean": mean, "full": full, "contact": contact})


def punch(o, n=10, down=1.0e-3, mu=0.0, pairing="MORTAR", side="A", young=1000.0, poisson=0.3):
    """Half of a punch of half width 1, n edges, 1000 times as stiff, on a block 20 x 20."""
    upper = Block(2, [k / n for k in range(n + 1)], [k / 4 for k in range(5)],
                  lambda x, t: (x, t), 1000.0 * young, poisson)
    lower = Block(1, graded(1.0 / n, 1.0 + 2.0 / n, 20.0),
                  [1.0 - t for t in heights(1.0 / n, 20.0)[::-1]],
                  lambda x, t: (x, 20.0 * (t - 1.0)), young, poisson)
    cards = hold(11, lower.row(0)) + hold(12, lower.column(0) + upper.column(0), 1, 0)
    cards += push(13, upper.row(-1), -down, 2)
    return pressed(o, "flat punch", upper, lower, cards, 1, mu, side, pairing, {"half_width": 1.0})


def rod(o, upper=3, lower=5, gap=0.01, down=0.03, mu=0.0, pairing="MORTAR", side="AUTO",
        young=1000.0):
    """Rods of length 1 and section 1, PR 0, a gap apart; the end of the upper goes down."""
    from analytic import press_fit  # needs numpy, which the other scenes do not

    def lines(n):
        return [k / n for k in range(n + 1)]
    high = Block(2, lines(upper), lines(4), lambda x, t: (x, gap + t), young, 0.0)
    low = Block(1, lines(lower), lines(4), lambda x, t: (x, t - 1.0), young, 0.0)
    cards = hold(11, low.row(0)) + hold(12, high.column(0), 1, 0)
    cards += push(13, high.row(-1), -down, 2)
    return pressed(o, "Signorini's rod", high, low, cards, 1, mu, side, pairing,
                   {"force": press_fit(down - gap, (1.0, 1.0), (young, young))})


SCENES = {f.__name__: f for f in (patch, hertz, cylinder, westergaard, punch, rod)}
