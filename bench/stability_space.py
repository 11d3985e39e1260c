"""Scenes of the stability atlas in space: two bars, a block that falls on its corner, a block of
tetrahedra that falls flat. Bodies are free; a run has 100 steps and meets in the fourth.

Judged from outside: by the places of all nodes, energy, momentum, forces."""

import math

import cards
import collide_space
import numpy as np
import solid_forms
import tables
from make_space import grid, rotation

STEPS = 100
# Contact on velocities alone: what penetrates in a step stays.
VELOCITIES = ("MOREAU", "CDLAGRANGE")
ENERGY, MOMENTUM = 1.0e-9, 1.0e-8  # as of the bars of the plane
ELFORM = {"HEX8": 1, "TET4": 10}


def box(cells, size, form="HEX8", young=1.0e3, density=1.0, poisson=0.0):
    """A box of hexahedra or tetrahedra with a corner in the origin, at rest."""
    x, elements = grid(cells, lambda *p: [s * i / n for s, i, n in zip(size, p, cells)])
    tetrahedra = solid_forms.split(elements)
    given = dict(x=x, elements=tetrahedra if form == "TET4" else elements, tetrahedra=tetrahedra)
    given.update(form=form, young=young, density=density, poisson=poisson, v=np.zeros_like(x))
    return dict(given, edge=min(s / n for s, n in zip(size, cells)))


def write(path, scheme, bodies, dt, mu):
    """Writes a deck, returns the data for the judge."""
    names = ("scheme", "mass", "redist")
    setting = {k: v for k, v in scheme.items() if k not in names}
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % (STEPS * dt)]
    lines += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % dt]
    lines += cards.scheme_cards(scheme["scheme"], **setting)
    lines += ["*BIPACT_MASS", "%s,%d" % (scheme["mass"], scheme["redist"]), "*BIPACT_LEDGER", "1,"]
    history = ["*DATABASE_HISTORY_NODE"]
    for k, b in enumerate(bodies, start=1):
        first = 1 + 10000 * (k - 1)
        ids = [first + n for n in range(len(b["x"]))]
        lines += ["*NODE"] + ["%d,%r,%r,%r" % (i, *map(float, p)) for i, p in zip(ids, b["x"])]
        lines += solid_forms.cards(b["elements"], k, first, first)
        lines += ["*PART", "body", "%d,%d,%d" % (k, k, k), "*SECTION_SOLID"]
        lines += ["%d,%d" % (k, ELFORM[b["form"]]), "*MAT_ELASTIC"]
        lines += ["%d,%r,%r,%r" % (k, b["density"], b["young"], b["poisson"])]
        lines += ["*INITIAL_VELOCITY_NODE"]
        lines += ["%d,%r,%r,%r" % (i, *map(float, v)) for i, v in zip(ids, b["v"])]
        history += ["%d," % i for i in ids]
    lines += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,3,3", "%r," % mu] + history
    for name in ("GLSTAT", "NODOUT", "RCFORC"):
        lines += ["*DATABASE_" + name, "%r," % dt]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines + ["*END", ""]))
    return {"space": bodies, "mu": mu, "meta": {}, "exact": False, "bound": 0.0}


def wave_speed(young, density, poisson):
    return math.sqrt(young * (1.0 - poisson) / (density * (1.0 + poisson) * (1.0 - 2.0 * poisson)))


def space_bars(path, scheme, o):
    """Two bars of 5 x 1 x 1 cells meet end to end."""
    poisson, high = o.get("poisson", 0.0), 1.0 / o.get("aspect", 1.0)
    bodies = [box((5, 1, 1), (5.0, high, high), poisson=poisson) for _ in range(2)]
    bodies[1]["young"] *= o.get("youngs", 1.0)
    bodies[1]["density"] *= o.get("densities", 1.0)
    dt = o.get("courant", 0.5) / wave_speed(1.0e3, 1.0, poisson)
    speed = wave_speed(bodies[1]["young"], bodies[1]["density"], poisson)
    v = min(1.0, 1.0e-2 * speed, 0.02 / dt)
    bodies[1]["x"][:, 0] += 5.0 + 7.0 * v * dt
    bodies[0]["v"][:, 0], bodies[1]["v"][:, 0] = v, -v
    return write(path, scheme, bodies, dt, 0.3)


def thrown(path, scheme, o, turn, form):
    """A block thrown obliquely on a slab."""
    young = 1.0e3 * o.get("youngs", 1.0)
    slab = box((4, 4, 1), (2.0, 2.0, 0.5), form, young, poisson=0.3)
    block = box((2, 2, 1), (0.8, 0.6, 0.4), form, poisson=0.3)
    slab["x"] -= [1.0, 1.0, 0.5]
    block["x"] = (block["x"] - block["x"].mean(axis=0)) @ turn.T
    dt = o.get("courant", 0.5) * 0.3 / wave_speed(max(young, 1.0e3), 1.0, 0.3)
    v = min(1.0, 1.0e-2 * wave_speed(young, 1.0, 0.3), 0.02 / dt)
    block["x"][:, 2] += 3.5 * v * dt - block["x"][:, 2].min()
    block["v"][:] = [0.5 * v, 0.2 * v, -v]
    return write(path, scheme, [slab, block], dt, o.get("mu", 0.3))


def space_corner(path, scheme, o):
    """It falls on its corner."""
    return thrown(path, scheme, o, rotation((1.0, 0.6, 0.2), 0.7), "HEX8")


def space_flat(path, scheme, o):
    """It falls flat, of tetrahedra."""
    return thrown(path, scheme, o, np.eye(3), "TET4")


def faults(folder, c, data, log, rise):
    """What a run does that physics forbids: [(words, warning that would say so or '')]. rise: of the
    energy balance, over its largest term."""
    a, b = data["space"]
    energy, nodes, force = (
        tables.read_run(folder, name) for name in ("glstat", "nodout", "rcforc")
    )
    places = np.stack([nodes[name] for name in "xyz"], axis=1)
    if not np.all(np.isfinite(places)) or not all(
        np.all(np.isfinite(energy[name])) for name in energy.names
    ):
        return [("not finite", "")]
    places = places.reshape(-1, len(a["x"]) + len(b["x"]), 3)
    edge = min(a["edge"], b["edge"])
    way = np.linalg.norm(np.diff(places, axis=0), axis=2).max() / edge
    allowed = collide_space.SILENT + (1.5 if c["method"] in VELOCITIES else 0.5) * way
    n = len(a["x"])
    deep = collide_space.overlap(places[:, :n], a["tetrahedra"], places[:, n:], b["tetrahedra"])
    rules = [("energy rises by %.1e", rise, ENERGY, "energy-growth")]
    rules.append(("ledger open by %.1e", np.abs(energy["residual"]).max(), ENERGY, "balance"))
    unit = math.sqrt(2.0 * energy["kinetic"][0] * sum(mass(x) for x in (a, b)))
    change = max(np.abs(energy[x] - energy[x][0]).max() for x in ("momx", "momy", "momz"))
    rules.append(("momentum changes by %.1e", change / unit, MOMENTUM, "balance"))
    rules.append(("overlap in edges by %.1e", deep / edge, allowed, "overlap"))
    wrong = [(words % value, warning) for words, value, most, warning in rules if value > most]
    if np.any(force["ft"] > data["mu"] * np.abs(force["fn"]) * (1.0 + 1e-6) + 1e-300):
        wrong.append(("outside the cone", "certificate"))
    if log.get("certificate", "met") != "met":
        wrong.append(("certificate %s" % log["certificate"], "certificate"))
    return wrong


def mass(b):
    """Mass of a box, by its tetrahedra."""
    p = b["x"][np.array(b["tetrahedra"])[:, :4]]
    edges = p[:, 1:] - p[:, :1]
    return b["density"] * np.linalg.det(edges).sum() / 6.0


SCENES = {f.__name__: f for f in (space_bars, space_corner, space_flat)}
