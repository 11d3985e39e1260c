"""Scenes of the stability atlas with rigid parts and with friction that falls with the speed of slip.

They are scenes of scripts/collide_scenes.py, and its judge says from outside what is wrong with a
run. A run has 200 steps and meets in the fourth, whatever its step."""

import math

import numpy as np

import cards
import collide
import collide_deck
import collide_mesh
import collide_scenes
import tables

# Schemes with a law for impacts of rigid parts, and the field REST.
LAWS = ("MOREAU", "PAOLI", "PAOLI 0", "CDLAGRANGE", "NSGENALPHA 0.8")
# Contact on velocities alone: what penetrates in a step stays.
VELOCITIES = ("MOREAU", "CDLAGRANGE")
# Motions of these follow forces of several times: impulses of a wall come a few steps late.
LATE = ("HHT", "GENALPHA")
STEPS = 200
# Deeper ones have a warning (doc/theory.md 3), in edges; in a step that turns bodies half of their
# way may be added, as in the scenes of bars.
OVERLAP = 1.0e-2
# Energy and ledger as of the bars; opposite forces and shapes to round-off, as in collide.
ENERGY, MOMENTUM = 1.0e-9, 1.0e-8


def rectangle(width, height, nx, ny, at=(0.0, 0.0), angle=0.0, **more):
    """A body with its lower left corner at a place, turned about it."""
    xs, ys = np.linspace(0.0, width, nx + 1), np.linspace(0.0, height, ny + 1)
    xy, elements = collide_mesh.blocks(xs, ys, lambda *_: True)
    xy = collide_mesh.turned(xy, angle) + at
    given = {"density": 1.0, "young": 1.0e4, "poisson": 0.3, "rigid": False}
    given.update(held=[], driven=[], drive=np.zeros(2), velocity=np.zeros_like(xy))
    given.update(xy=xy, elements=elements, loop=collide_mesh.outline(elements))
    return dict(given, **more)


def throw(b, vx, vy, omega=0.0):
    """Velocities of all nodes."""
    arm = b["xy"] - b["xy"].mean(axis=0)
    b["velocity"] = np.array([vx, vy]) + omega * np.column_stack([-arm[:, 1], arm[:, 0]])


def scene_of(bodies, dt, mu, **more):
    """A scene of bodies in contact, each with the next one."""
    scene = {"kind": "atlas", "bodies": bodies, "dt": dt, "steps": STEPS, "end": STEPS * dt}
    scene.update(gravity=np.zeros(2), wall=None, single="", mortars=set(), mu=mu)
    scene["pairs"] = [(k, k + 1) for k in range(len(bodies) - 1)]
    scene.update(more)
    collide_scenes.number_nodes(scene)
    return scene


def write(path, scheme, scene, extra=()):
    """Writes a deck, returns the data for the judge."""
    names = ("scheme", "mass", "redist")
    setting = {k: v for k, v in scheme.items() if k not in names}
    lines = ["*KEYWORD", "*TITLE", scene["kind"]]
    lines += ["*CONTROL_TERMINATION", collide_deck.number(scene["end"]) + ","]
    lines += ["*CONTROL_IMPLICIT_GENERAL", "1," + collide_deck.number(scene["dt"])]
    lines += cards.scheme_cards(scheme["scheme"], **setting)
    lines += ["*BIPACT_MASS", "%s,%d" % (scheme["mass"], scheme["redist"])]
    lines += ["*BIPACT_LEDGER", "1,"] + collide_deck.geometry(scene) + collide_deck.parts(scene)
    lines += collide_deck.loads(scene) + collide_deck.contacts(scene) + list(extra)
    lines += collide_deck.tables(scene, 1) + ["*END", ""]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines))
    return {"bodies": scene, "meta": {}, "exact": False, "bound": 0.0}


def slab():
    """8 x 2 elements of 1/4. It is free: the impulse of supports is not in the tables of schemes
    that weigh forces of two times, and momentum is to be kept."""
    return rectangle(2.0, 0.5, 8, 2, (0.0, -0.5))


def rigid_block(path, scheme, o):
    """A rigid block, turned, thrown obliquely on a deformable slab."""
    base, young = slab(), 1.0e4 * o.get("youngs", 1.0)
    base["young"] = young
    v = min(1.0, 1.0e-2 * math.sqrt(young))
    dt = o.get("courant", 0.5) * 0.25 / math.sqrt(young)
    block = rectangle(0.5, 0.4, 2, 2, (0.8, 3.5 * v * dt), 0.2, rigid=True)
    block["density"] = o.get("densities", 1.0)
    throw(block, 0.6 * v, -v)
    return write(path, scheme, scene_of([base, block], dt, o.get("mu", 0.3)))


def rigid_pair(path, scheme, o):
    """Two free rigid blocks, one thrown at the other; step: its way in shortest edges, 0.2."""
    dt = 0.2 * o.get("step", 0.01)
    one = rectangle(0.6, 0.5, 2, 2, (0.0, -0.5), rigid=True)
    two = rectangle(0.5, 0.4, 2, 2, (0.2, 3.5 * dt), 0.2, rigid=True)
    two["density"] = o.get("densities", 1.0)
    throw(two, 0.5, -1.0, 0.3)
    if "rest" in o and scheme["scheme"] in [name.split()[0] for name in LAWS]:
        scheme = dict(scheme, rest=o["rest"])
    data = write(path, scheme, scene_of([one, two], dt, o.get("mu", 0.3)))
    return dict(data, rigid_pair=True)


def falling(path, scheme, o):
    """A block thrown obliquely on a slab; friction from FS to FD = FS/ratio at speed, with DC."""
    base, mu = slab(), o.get("mu", 0.5)
    dt = o.get("courant", 0.5) * 0.2 / 1.0e2
    block = rectangle(0.5, 0.4, 2, 2, (0.8, 3.5 * dt))
    throw(block, 0.6, -1.0)
    falls = (mu / o.get("ratio", 5.0), o.get("decay", 3.0))
    return write(path, scheme, scene_of([base, block], dt, mu, falls=falls))


def belt(path, scheme, o):
    """Two blocks on each other fall on a flat wall that moves along itself at speed 1."""
    mu, dt = o.get("mu", 0.3), o.get("courant", 0.5) * 0.2 / 1.0e2
    blocks = [rectangle(0.8, 0.4, 4, 2, (0.0, 3.5 * dt))]
    blocks += [rectangle(0.5, 0.4, 2, 2, (0.1, 0.4 + 3.6 * dt))]
    for b in blocks:
        throw(b, 0.0, -1.0)
    scene = scene_of(blocks, dt, max(mu, 0.1), falls=(0.1, 3.0))
    moves = ["*RIGIDWALL_GEOMETRIC_FLAT_MOTION", "0,", "0.0,0.0,,0.0,1.0,,%r" % mu, "0.0,"]
    moves += ["9,0,1.0,0.0"] + collide_deck.constant(9, 1.0, scene)
    moves += ["*DATABASE_RWFORC", "%r," % dt]
    data = write(path, scheme, scene, moves)
    scene["wall"] = (np.zeros(2), np.array([0.0, 1.0]), mu)
    return data


def faults(folder, c, data, log, rise):
    """What a run does that physics forbids, from outside: [(words, warning that would say so or
    '')]. rise: of the energy balance, over its largest term."""
    scene = data["bodies"]
    found, _ = collide.measure(folder, scene)
    found["rise"] = rise
    if scene["wall"] and c["method"].split()[0] in LATE:
        found["momentum"] = 0.0
    if not found["finite"]:
        return [("not finite", "")]
    allowed = OVERLAP + (1.5 if c["method"] in VELOCITIES else 0.5) * found["step"]
    rules = (
        ("energy rises", "rise", ENERGY, "energy-growth"),
        ("energy exceeds its sources", "energy", ENERGY, "energy-growth"),
        ("ledger open", "ledger", ENERGY, "balance"),
        ("momentum changes", "momentum", MOMENTUM, "balance"),
        ("forces not opposite", "balance", collide.BALANCE, ""),
        ("a rigid part changes its shape", "shape", collide.SHAPE, ""),
        ("overlap in edges", "overlap", allowed, "overlap"),
    )
    wrong = [
        ("%s by %.1e" % (words, found[name]), warning)
        for words, name, most, warning in rules
        if found[name] > most
    ]
    if found["through"]:
        wrong.append(("a node passes through a body", "overlap"))
    for name, mu in (("rcforc", scene["mu"]), ("rwforc", scene["wall"] and scene["wall"][2])):
        force = tables.read_run(folder + "/out", name)
        if force is not None and len(force):
            mu = 1.0e6 if name == "rwforc" and mu == 1.0 else mu  # FRIC 1: no sliding
            if np.any(np.abs(force["ft"]) > mu * force["fn"] * (1.0 + 1e-6) + 1e-300):
                wrong.append(("outside the cone", "certificate"))
    if log.get("certificate", "met") != "met":
        wrong.append(("certificate %s" % log["certificate"], "certificate"))
    if data.get("rigid_pair") and c["method"] not in LAWS:
        wrong.append(("rebound of rigid parts by the phase of the touch", "rigid-impact"))
    return wrong


SCENES = {f.__name__: f for f in (rigid_block, rigid_pair, falling, belt)}
