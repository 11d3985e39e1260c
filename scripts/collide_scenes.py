"""Random scenes of colliding bodies, their decks and their twins, for collide.py.

draw(seed, number) makes a scene from these two numbers alone. Speeds are about 1, bodies about
1 across. A scene is a dictionary:

    kind        thrown, stacked or wedged; extreme: what is beyond ordinary ranges
    bodies      xy, elements, loop (outline), young, density, poisson, velocity (of the nodes),
                held (nodes that cannot move), driven (nodes moved by the velocity `drive`),
                rigid (a rigid part: held or driven as a whole); of a soft scene law, the cards
                of its material, the first field open
    gravity     acceleration; wall: None or (point, normal, mu)
    pairs       (body, body) in contact with friction mu; single: "", "all" or "set", the card
                of one contact for all bodies
    scheme      card of *BIPACT_TIME
    soft        finite deformation; halve: steps that fail are halved
    ids         node numbers of each body; order: elements in the order of the deck
"""

import copy
import math

import numpy as np

import collide_mesh as mesh

EXTREMES = ("stiffness", "mass", "poisson", "friction", "size", "aspect")
SHAPES = ("rectangle", "rectangle", "L", "U", "T", "wedge", "polygon", "polygon", "polygon")


def body(rng, raw):
    """A body from a raw mesh, centred on the middle of its nodes."""
    xy, elements = mesh.finished(rng, raw)
    loop = mesh.outline(elements)
    xy = xy - xy[loop].mean(axis=0)
    return {
        "xy": xy,
        "elements": elements,
        "loop": loop,
        "velocity": np.zeros_like(xy),
        "held": [],
        "driven": [],
        "drive": np.zeros(2),
        "rigid": False,
    }


def piece(rng, across):
    """A body of any shape with up to `across` elements over its width."""
    shape, width = rng.choice(SHAPES), rng.uniform(0.6, 1.2)
    height, size = width * rng.uniform(0.4, 1.0), width / rng.uniform(2.0, across)
    if shape == "rectangle":
        raw = mesh.rectangle(rng, width, height, width / size, height / size)
    elif shape in "LUT":
        raw = mesh.bracket(rng, shape, width, height, size)
    elif shape == "wedge":
        raw = mesh.polygon(rng, wedge_corners(rng.uniform(0.15, 0.5), width), size)
    else:
        corners = mesh.corners_of(rng, rng.integers(3, 9), width)
        raw = mesh.polygon(rng, corners, size)
    return body(rng, raw)


def wedge_corners(half, length):
    """A triangle with its tip down."""
    return [(0.0, -length), (half, 0.0), (-half, 0.0)]


def sliver(rng):
    """A rectangle of flat elements, 1 : 5 to 1 : 20."""
    height = 0.5 / rng.uniform(5.0, 20.0)
    rows = rng.integers(2, 5)
    return body(rng, mesh.rectangle(rng, 1.0, rows * height, 2, rows))


def loop_of(b):
    return b["xy"][b["loop"]]


def set_materials(rng, scene):
    """Speeds of sound 15 to 1500 times the speeds of the bodies at Courant numbers up to about
    100, densities within a factor 30; more in extreme scenes."""
    extreme, bodies = scene["extreme"], scene["bodies"]
    most = 40.0 if "stiffness" in extreme else 800.0
    most = min(most, max(20.0, 40.0 * shortest_edge(scene) / scene["dt"]))
    sound = 10.0 ** rng.uniform(1.2, math.log10(most))
    for b in bodies:
        b["density"] = 10.0 ** rng.uniform(-0.75, 0.75)
        b["young"] = b["density"] * (sound * 10.0 ** rng.uniform(-0.4, 0.4)) ** 2
        b["poisson"] = rng.choice([0.0, rng.uniform(0.0, 0.45)])
    special = bodies[rng.integers(len(bodies))]
    if "stiffness" in extreme:
        special["young"] = max(b["young"] for b in bodies) * 10.0 ** rng.uniform(3.0, 6.0)
    if "mass" in extreme:
        factor = 10.0 ** rng.uniform(2.0, 4.0)
        special["density"], special["young"] = (
            special["density"] * factor,
            special["young"] * factor,
        )
    if "poisson" in extreme:
        special["poisson"] = rng.uniform(0.49, 0.499)
    scene["mu"] = float(rng.choice([0.0, rng.uniform(0.0, 1.0), rng.uniform(0.0, 1.0)]))
    if "friction" in extreme:
        scene["mu"] = float(rng.uniform(1.0, 10.0))
    set_rates(scene)


def set_rates(scene):
    """The Courant number, and the round-off to expect in the energy: stresses from
    displacements of the size of an element are wrong by eps E, their work in n steps of h by
    eps E h sqrt(n) v/edge, which is eps (c/v)^2 (h v/edge) sqrt(n) of the energy, v = 1."""
    bodies, dt = [b for b in scene["bodies"] if not b["rigid"]], scene["dt"]
    scene["courant"] = dt * max((sound_of(b) / smallest_edge(b) for b in bodies), default=0.0)
    rate = max((sound_of(b) ** 2 / smallest_edge(b) for b in bodies), default=0.0)
    scene["roundoff"] = float(np.finfo(float).eps * rate * dt * math.sqrt(scene["steps"]))


def sound_of(b):
    """Speed of pressure waves."""
    nu = b["poisson"]
    modulus = b["young"] * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    return math.sqrt(modulus / b["density"])


def smallest_edge(b):
    return min(mesh.edge_lengths(b["xy"][list(e)]).min() for e in b["elements"])


def shortest_edge(scene):
    return min(mesh.edge_lengths(loop_of(b)).min() for b in scene["bodies"])


def set_steps(rng, scene):
    """Step and number of steps, by the shortest edge; the way travelled is at most 2.5."""
    shortest = shortest_edge(scene)
    if rng.random() < 0.35:
        factor, steps = 10.0 ** rng.uniform(-1.3, -0.3), rng.integers(80, 200)
    else:
        factor, steps = 10.0 ** rng.uniform(-2.3, -1.75), rng.integers(200, 500)
    scene["dt"] = float(factor * shortest)
    scene["steps"] = int(min(steps, max(30, 2.5 / scene["dt"])))
    scene["end"] = scene["steps"] * scene["dt"]
    scene["gap"] = min(0.5, rng.uniform(0.03, 0.35) * scene["end"])


def place(b, others, towards, direction, gap):
    """Moves a body from afar along a direction, aimed at a point, until a gap is left."""
    b["xy"] = b["xy"] + towards - 8.0 * direction
    b["xy"] += direction * mesh.approach(loop_of(b), others, direction, gap)


def spin(rng, b, end, speed):
    """Adds a turning motion: at most `speed` on the outline and 0.25 rad in the run."""
    arm = b["xy"] - loop_of(b).mean(axis=0)
    most = min(0.25 / end, speed / np.hypot(*arm.T).max())
    omega = most * rng.uniform(-1.0, 1.0) * (rng.random() < 0.7)
    b["velocity"] = b["velocity"] + omega * np.column_stack([-arm[:, 1], arm[:, 0]])


def direction_of(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def thrown(rng, scene):
    """Free bodies around the first one, each flying at one that is there already."""
    scene["bodies"] = [piece(rng, scene["across"]) for _ in range(scene["count"])]
    special_body(rng, scene)

    def arrange():
        for k, b in enumerate(scene["bodies"]):
            b["xy"] = mesh.turned(b["xy"], rng.choice([0.0, rng.uniform(0.0, 6.283)]))
            if k:
                aim = loop_of(scene["bodies"][rng.integers(k)]).mean(axis=0)
                way = direction_of(rng.uniform(0.0, 6.283))
                others = [loop_of(o) for o in scene["bodies"][:k]]
                place(b, others, aim + rng.uniform(-0.2, 0.2, 2), way, scene["gap"])
                side = rng.uniform(-0.3, 0.3) * np.array([-way[1], way[0]])
                b["velocity"] += rng.uniform(0.4, 0.8) * (way + side)
            spin(rng, b, scene["end"], 0.2)

    return arrange


def special_body(rng, scene):
    """The last body of an extreme scene: much smaller than others, or of flat elements."""
    if "aspect" in scene["extreme"]:
        scene["bodies"][-1] = sliver(rng)
    if "size" in scene["extreme"]:
        scene["bodies"][-1]["xy"] *= 10.0 ** rng.uniform(-1.7, -1.0)


def stacked(rng, scene):
    """Bodies that fall on each other, on a held slab or on a rigid wall."""
    on_wall = rng.random() < 0.4
    scene["bodies"] = [piece(rng, scene["across"]) for _ in range(scene["count"] - 1)]
    if not on_wall or len(scene["bodies"]) < 2:
        scene["bodies"].insert(0, slab(rng))
    special_body(rng, scene)

    def arrange():
        floor = np.array([(-9.0, -10.0), (9.0, -10.0), (9.0, -1.0), (-9.0, -1.0)])
        others = [floor] if on_wall else [loop_of(scene["bodies"][0])]
        for b in scene["bodies"][0 if on_wall else 1 :]:
            b["xy"] = mesh.turned(b["xy"], rng.choice([0.0, rng.uniform(0.0, 6.283)]))
            aim = np.array([rng.uniform(-0.4, 0.4), 0.0])
            place(b, others, aim, np.array([0.0, -1.0]), scene["gap"] * rng.uniform(0.05, 0.5))
            b["velocity"] += rng.uniform(0.0, 0.5) * np.array([rng.uniform(-0.5, 0.5), -1.0])
            spin(rng, b, scene["end"], 0.1)
            others.append(loop_of(b))
        scene["gravity"] = np.array([0.0, -rng.uniform(0.3, 1.0) / scene["end"]])
        if on_wall:
            friction = min(scene["mu"], 0.99)
            scene["wall"] = (np.array([0.0, -1.0]), np.array([0.0, 1.0]), friction)
        else:
            hold_lowest(scene["bodies"][0])

    return arrange


def slab(rng):
    width, height = rng.uniform(1.6, 2.4), rng.uniform(0.2, 0.5)
    return body(rng, mesh.rectangle(rng, width, height, rng.integers(2, 12), 1))


def hold_lowest(b):
    y = b["xy"][:, 1]
    b["held"] = list(np.flatnonzero(y < y.min() + 1.0e-9))
    b["velocity"][b["held"]] = 0.0


def wedged(rng, scene):
    """A wedge or block driven or thrown into a groove, a slot or an inner corner. The makers
    return holder, driver, the deepest point, the direction to it, and the room at the sides.
    """
    make = (groove, narrow_slot, inner_corner)[rng.integers(3)]
    holder, driver, tip, way, free = make(rng, scene["across"])
    if "aspect" in scene["extreme"]:
        driver = sliver(rng)
    scene["bodies"] = [holder, driver]
    if "size" in scene["extreme"]:
        driver["xy"] *= 10.0 ** rng.uniform(-1.7, -1.0)
    if scene["count"] > 3:
        scene["bodies"].append(piece(rng, scene["across"]))
    held = rng.random() < 0.6
    forced = held and rng.random() < 0.4

    def arrange():
        lowest = loop_of(driver)[np.argmax(loop_of(driver) @ way)]
        aim = tip - lowest + rng.choice([0.0, 0.03]) * rng.uniform(-1.0, 1.0, 2)
        place(driver, [loop_of(holder)], aim, way, min(scene["gap"], 0.4 * free))
        driver["velocity"] += rng.uniform(0.5, 1.0) * way
        if held:
            hold_lowest(holder)
        if forced:
            force(driver, way)
        else:
            spin(rng, driver, scene["end"], 0.1)
        for b in scene["bodies"][2:]:
            others = [loop_of(holder), loop_of(driver)]
            place(b, others, loop_of(driver).mean(axis=0), way, scene["gap"])
            b["velocity"] += rng.uniform(0.7, 1.2) * way

    return arrange


def force(driver, way):
    """The rear of a body is moved on at its speed."""
    back = driver["xy"] @ way
    driver["driven"] = list(np.flatnonzero(back < back.min() + 1.0e-9))
    driver["drive"] = driver["velocity"][0].copy()


def groove(rng, across):
    """A V groove, and a wedge or a block on its corner."""
    half, depth, size = rng.uniform(0.2, 0.6), rng.uniform(0.3, 0.8), 1.6 / (across + 2.0)
    points = [(0, 1), (0.8 - half, 1), (0.8, 1 - depth), (0.8 + half, 1), (1.6, 1)]
    holder = body(rng, mesh.profile(rng, points, size))
    if rng.random() < 0.5:
        corners = wedge_corners(rng.uniform(0.15, 0.6), rng.uniform(0.3, 1.0))
        driver = body(rng, mesh.polygon(rng, corners, rng.uniform(0.15, 0.5)))
    else:
        driver = block(rng, 0.25 * math.pi)
    way = np.array([0.0, -1.0])
    return holder, driver, groove_tip(holder), way, 1.0


def groove_tip(holder):
    """The lowest node of the upper side, corners left out."""
    loop = loop_of(holder)
    inner = np.abs(loop[:, 0]) < loop[:, 0].max() - 1.0e-9
    upper = loop[inner & (loop[:, 1] > loop[:, 1].min() + 1.0e-9)]
    return upper[np.argmin(upper[:, 1])]


def block(rng, angle=0.0, width=None):
    width = width or rng.uniform(0.3, 0.7)
    height = rng.uniform(0.3, 0.7)
    b = body(rng, mesh.rectangle(rng, width, height, *rng.integers(1, 5, 2)))
    b["xy"] = mesh.turned(b["xy"], angle)
    return b


def narrow_slot(rng, across):
    """A slot and a block that is a little narrower."""
    opening, depth = rng.uniform(0.3, 0.6), rng.uniform(0.3, 0.7)
    clearance = 10.0 ** rng.uniform(-2.5, -1.1)
    driver = block(rng, 0.0, opening - 2.0 * clearance)
    raw = mesh.slot(rng, 1.4, 1.0, opening, depth, 1.4 / (across + 1.0))
    holder = body(rng, raw)
    way = np.array([0.0, -1.0])
    top = loop_of(holder)[:, 1].max()
    middle = 0.5 * (loop_of(holder)[:, 0].max() + loop_of(holder)[:, 0].min())
    corner = loop_of(driver)[np.argmax(loop_of(driver) @ way)]
    return holder, driver, np.array([middle + corner[0], top - depth]), way, clearance


def inner_corner(rng, across):
    """An L and a block that flies at its inner corner, often straight along the diagonal."""
    holder = body(rng, mesh.bracket(rng, "L", 1.2, 1.2, 1.2 / across))
    loop = loop_of(holder)
    edges = np.roll(loop, -1, axis=0) - loop
    turns = np.roll(edges, 1, axis=0)
    reflex = turns[:, 0] * edges[:, 1] - turns[:, 1] * edges[:, 0] < -1.0e-9
    angle = 1.25 * math.pi + rng.choice([0.0, 0.5]) * rng.uniform(-1.0, 1.0)
    return holder, block(rng), loop[reflex][0], direction_of(angle), 1.0


KINDS = {"thrown": thrown, "stacked": stacked, "wedged": wedged}


def make_rigid(rng, scene):
    """Some bodies, one at least, as rigid parts; the scheme mostly one with a law for their
    impacts. Of two bodies that are pressed together one is deformable."""
    bodies = scene["bodies"]
    for b in bodies:
        b["rigid"] = bool(rng.random() < 0.4)
    bodies[rng.integers(len(bodies))]["rigid"] = True
    if any(b["driven"] for b in bodies):
        one = rng.integers(2)
        bodies[0]["rigid"], bodies[1]["rigid"] = bool(one), not one
    if rng.random() < 0.7:
        scene["scheme"] = "MOREAU,0.5,,%r" % float(rng.choice([0.0, 0.5, 1.0]))
    set_rates(scene)


LAWS = ("foam", "blatz-ko", "mooney", "ogden", "neo-hooke", "elastic")


def law(rng, b, extreme):
    """Cards of a random law whose modulus of a bar is the body's; sets its Poisson ratio."""
    name = str(rng.choice(LAWS))
    fixed = {"foam": 0.25, "blatz-ko": 0.463, "neo-hooke": rng.uniform(0.1, 0.49)}
    fixed["elastic"] = rng.uniform(0.0, 0.4)
    nu = fixed.get(name, rng.uniform(0.46, 0.495))
    if extreme and name not in ("foam", "blatz-ko", "elastic"):
        nu = rng.uniform(0.495, 0.499)
    b["poisson"] = float(nu)
    shear, share = b["young"] / (2.0 * (1.0 + nu)), rng.uniform(0.3, 1.0)
    first = "%d," + ",".join(repr(float(x)) for x in (b["density"], nu))
    plain = "%d," + ",".join(repr(float(x)) for x in (b["density"], shear))
    return {
        "foam": ["*MAT_BLATZ-KO_FOAM", plain],
        "blatz-ko": ["*MAT_BLATZ-KO_RUBBER", plain],
        "mooney": ["*MAT_MOONEY-RIVLIN_RUBBER", mooney(first, shear, share)],
        "ogden": ["*MAT_OGDEN_RUBBER", first, "%r,%r" % ogden(shear, share), "3.0,-2.0"],
        "neo-hooke": ["*MAT_HYPERELASTIC_RUBBER", first, "%r," % float(0.5 * shear)],
        "elastic": ["*MAT_ELASTIC", "%%d,%r,%r,%r" % (b["density"], b["young"], float(nu))],
    }[name]


def mooney(first, shear, share):
    """A and B, whose sum is half of the shear modulus."""
    return first + ",%r,%r" % (float(0.5 * shear * share), float(0.5 * shear * (1.0 - share)))


def ogden(shear, share):
    """MU of ALPHA 3 and -2."""
    return float(shear * share / 1.5), float(-shear * (1.0 - share))


def make_soft(rng, scene):
    """Hyperelastic bodies at finite deformation: speeds are 1/5 to 1/50 of that of sound in the
    softest one (SVK: 1/10 at most), some turn by more than a radian in the run."""
    bodies = scene["bodies"]
    sound = 10.0 ** rng.uniform(0.7, 1.7)
    factor = sound**2 / min(b["young"] / b["density"] for b in bodies)
    for b in bodies:
        b["young"] *= factor
        b["law"] = law(rng, b, "poisson" in scene["extreme"])
        if b["law"][0] == "*MAT_ELASTIC" and b["young"] < 100.0 * b["density"]:
            b["law"] = ["*MAT_BLATZ-KO_FOAM", "%%d,%r,%r" % (b["density"], b["young"] / 2.5)]
            b["poisson"] = 0.25
        if not (b["held"] or b["driven"]) and rng.random() < 0.5:
            arm = b["xy"] - loop_of(b).mean(axis=0)
            omega = min(1.5 / scene["end"], 0.6 / np.hypot(*arm.T).max()) * rng.uniform(
                -1.0, 1.0
            )
            b["velocity"] = b["velocity"] + omega * np.column_stack([-arm[:, 1], arm[:, 0]])
    # A body that is driven into another one would be in ever shorter steps.
    scene["halve"] = bool(rng.random() < 0.3) and not any(b["driven"] for b in bodies)
    set_rates(scene)


def velocities_of(b):
    """Velocity of the centre of mass and rate of rotation of a rigid body."""
    arm, v = b["xy"] - b["xy"].mean(axis=0), b["velocity"].mean(axis=0)
    turning = arm[:, 0] * b["velocity"][:, 1] - arm[:, 1] * b["velocity"][:, 0]
    omega = turning.sum() / (arm * arm).sum()
    to_centre = mesh.centroid(loop_of(b)) - b["xy"].mean(axis=0)
    return v + omega * np.array([-to_centre[1], to_centre[0]]), omega


def may_meet_rigid(scene):
    """Whether two rigid parts, or one and a wall, may meet."""
    rigid = [b["rigid"] for b in scene["bodies"]]
    return any(rigid) and bool(scene["wall"]) or sum(rigid) > 1


def draw(seed, number, single=False, mortar=False, rigid=False, soft=False):
    """The scene of a number."""
    rng = np.random.default_rng([seed, number])
    kind = str(rng.choice(sorted(KINDS)))
    extreme = rng.choice(EXTREMES, rng.integers(1, 3), replace=False)
    extreme = sorted(map(str, extreme)) if rng.random() < 0.1 else []
    count = int(rng.choice([2, 3, 4, 5], p=[0.4, 0.3, 0.2, 0.1]))
    across = min(8.0, max(3.0, math.sqrt(200.0 / count) - 1.0))
    scene = dict(kind=kind, extreme=extreme, count=count, across=across)
    scene.update(gravity=np.zeros(2), wall=None, scheme="THETA,0.5", soft=soft, halve=False)
    arrange = KINDS[kind](rng, scene)
    set_steps(rng, scene)
    set_materials(rng, scene)
    arrange()
    card = str(rng.choice(["", "all", "set"]))
    scene["single"] = card if single else ""
    last = len(scene["bodies"])
    scene["pairs"] = [(a, b) for a in range(last) for b in range(a + 1, last)]
    other = np.random.default_rng([seed, number, 1])  # the scenes are those without mortars
    scene["mortars"] = {frozenset(p) for p in scene["pairs"] if mortar and other.random() < 0.5}
    if rigid:
        make_rigid(np.random.default_rng([seed, number, 2]), scene)
    if soft:
        make_soft(np.random.default_rng([seed, number, 3]), scene)
    number_nodes(scene)
    angle = rng.choice([0.0, rng.uniform(0.0, 6.283)])
    return transformed(scene, turn(angle)) if angle else scene


def number_nodes(scene):
    """Numbers of nodes and order of elements, body after body."""
    scene["ids"], scene["order"], first = [], [], 1
    for k, b in enumerate(scene["bodies"]):
        scene["ids"].append(np.arange(first, first + len(b["xy"])))
        scene["order"] += [(k, e) for e in range(len(b["elements"]))]
        first += len(b["xy"])


def turn(angle):
    return mesh.turned(np.eye(2), angle).T


MIRROR = np.diag([-1.0, 1.0])


def transformed(scene, matrix):
    """The scene turned or mirrored by an orthogonal matrix."""
    new = copy.deepcopy(scene)
    for b in new["bodies"]:
        for name in ("xy", "velocity", "drive"):
            b[name] = b[name] @ matrix.T
        if np.linalg.det(matrix) < 0.0:
            b["elements"] = [e[::-1] for e in b["elements"]]
            b["loop"] = b["loop"][::-1]
    new["gravity"] = matrix @ scene["gravity"]
    if scene["wall"]:
        point, normal, mu = scene["wall"]
        new["wall"] = (matrix @ point, matrix @ normal, mu)
    return new


def renumbered(scene, rng):
    """Other node numbers, another order of the elements, other first nodes of them."""
    new = copy.deepcopy(scene)
    total = sum(len(i) for i in scene["ids"])
    shuffled = np.concatenate([[0], 1 + rng.permutation(total)])
    new["ids"] = [shuffled[i] for i in scene["ids"]]
    new["order"] = [scene["order"][k] for k in rng.permutation(len(scene["order"]))]
    for b in new["bodies"]:
        starts = rng.integers(3, size=len(b["elements"]))
        b["elements"] = [e[s:] + e[:s] for s, e in zip(starts, b["elements"])]
    return new


def swapped(scene):
    """The parts in reverse order, each contact with its sides exchanged."""
    new = copy.deepcopy(scene)
    last = len(scene["bodies"]) - 1
    new["bodies"].reverse()
    new["ids"].reverse()
    new["order"] = [(last - k, e) for k, e in scene["order"]]
    new["pairs"] = [(last - b, last - a) for a, b in scene["pairs"]][::-1]
    new["pairs"] = [(b, a) for a, b in new["pairs"]]
    new["mortars"] = {frozenset(last - k for k in p) for p in scene["mortars"]}
    return new


def nudged(scene, rng, amount=1.0e-14):
    """Every body moved by next to nothing, so that every gap changes."""
    new = copy.deepcopy(scene)
    for b in new["bodies"]:
        b["xy"] = b["xy"] + amount * direction_of(rng.uniform(0.0, 6.283))
    return new
