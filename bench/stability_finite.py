"""Scenes of the stability atlas at finite deformation: a bar against a wall whose strains are
known, two bars of rubber that meet end to end, a block of foam thrown obliquely on a slab.
Bodies of the latter two are free; a run has 100 steps and meets in the fourth. Schemes and
masses are those that finite deformation takes, PAPER and MIDPOINT are THETA 1/2 with this
FORCE.

Judged by stability_bodies.faults, from outside: true overlap of the deformed outlines, energy,
momentum, forces; the bar by its exact displacements."""

import math

import cards
import collide_deck
import combinations
import finite_forms
import make_finite
import numpy as np
import stability_bodies
import tables

STEPS, LIMIT = 100, 60  # LIMIT: processor seconds of a run
FORCES = ("PAPER", "MIDPOINT")
PAIRS = [
    (name, mass, 0)
    for name in ("THETA", "THETA 1", "NEWMARK")
    for mass in ("CONSISTENT", "LUMPED")
]
PAIRS += [("THETA 0.55", "CONSISTENT", 0), ("PAOLI 0", "LUMPED", 0)]
PAIRS += [(name, "LUMPED", 0) for name in FORCES]

AMPLITUDE = (1.0e-6, 1.0e-3, 0.05, 0.1, 0.2, 0.26)
THROW = (1.0e-3, 1.0e-2, 0.1, 0.2, 0.4, 0.8)
COURANT = (0.01, 0.1, 0.5, 1.0, 5.0, 20.0, 100.0)
POISSON = (0.3, 0.46, 0.49, 0.499, 0.4999)
RATIOS = tuple(10.0**p for p in (-6, -4, -2, 0, 2, 4, 6))
MU = (0.0, 0.2, 1.0, 10.0, 1.0e3, 1.0e6)
ASPECT = (1.0e-2, 1.0e-1, 1.0, 10.0, 1.0e2)

# axis: (scene, what varies, its values, is a value inside the range promised for THETA C and L)
AXES = {
    "finite bar, speed over wave speed": (
        "finite_bar",
        "amplitude",
        AMPLITUDE,
        lambda v: v <= 0.2,
    ),
    "finite bar, Courant number": ("finite_bar", "courant", COURANT, lambda v: v <= 20.0),
    "finite bar, aspect ratio": ("finite_bar", "aspect", ASPECT, lambda v: True),
    "finite rubber bars, speed over wave speed": (
        "rubber_bars",
        "amplitude",
        THROW,
        lambda v: v <= 0.1,
    ),
    "finite rubber bars, Poisson ratio": (
        "rubber_bars",
        "poisson",
        POISSON,
        lambda v: 0.45 < v <= 0.499,
    ),
    "finite rubber bars, density ratio": (
        "rubber_bars",
        "densities",
        RATIOS,
        lambda v: 1e-4 <= v <= 1e4,
    ),
    "finite rubber bars, stiffness ratio": (
        "rubber_bars",
        "youngs",
        RATIOS,
        lambda v: 1e-4 <= v <= 1e4,
    ),
    "finite rubber bars, aspect ratio": ("rubber_bars", "aspect", ASPECT, lambda v: True),
    "finite foam block, speed over wave speed": (
        "foam_block",
        "amplitude",
        THROW,
        lambda v: v <= 0.2,
    ),
    "finite foam block, Courant number": (
        "foam_block",
        "courant",
        COURANT,
        lambda v: v <= 20.0,
    ),
    "finite foam block, friction": ("foam_block", "mu", MU, lambda v: v <= 10.0),
    "finite foam block, stiffness of the slab": (
        "foam_block",
        "youngs",
        RATIOS,
        lambda v: 1e-4 <= v <= 1e4,
    ),
    "finite foam block, density of the slab": (
        "foam_block",
        "densities",
        RATIOS,
        lambda v: 1e-4 <= v <= 1e4,
    ),
}


def settings(c):
    """(fields of the time scheme, lines of *BIPACT_KINEMATICS)."""
    if c["method"] in FORCES:
        return {"scheme": "THETA", "theta": 0.5}, ["*BIPACT_KINEMATICS", c["method"] + ","]
    scheme, setting = combinations.METHODS[c["method"]]
    return dict(setting, scheme=scheme), []


def control(c, step, end):
    """Cards of a run without its bodies."""
    scheme, force = settings(c)
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % end, "*CONTROL_IMPLICIT_GENERAL"]
    lines += ["1,%r" % step] + cards.scheme_cards(**scheme)
    lines += ["*CONTROL_IMPLICIT_SOLUTION", "12,"] + force
    return lines + ["*BIPACT_MASS", c["mass"] + ",", "*BIPACT_LEDGER", "1,"]


def finite_bar(path, c, o):
    """The bar of finite_forms.py, 25 elements, at any speed and step, till .9 of a crossing
    after the touch; of its height 1/25 and the inverse of the aspect ratio."""
    n, speed = 25, o.get("amplitude", 0.1)
    step = o.get("courant", 0.5) / n
    touch, high = 3.5 * step, 1.0 / n / o.get("aspect", 1.0)
    x, e = make_finite.quadrilaterals(
        n, 1, lambda i, j: (-1.0 - touch * speed + i / n, j * high)
    )
    end = touch + max(0.9, 12.0 * step)
    lines = control(c, step, end) + make_finite.shells(x, e)
    lines += make_finite.part(1, "bar", ["*MAT_ELASTIC", "1,1.0,1.0,0.0"])
    lines += ["*INITIAL_VELOCITY", "0,", "%r,0.0" % speed]
    lines += ["*SET_NODE_GENERAL", "9,", "ALL,", "*BOUNDARY_SPC_SET", "9,,0,1"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,-1.0,0.0,0.0,0.0"]
    lines += ["*DATABASE_HISTORY_NODE"] + ["%d," % (1 + k) for k in range(len(x))]
    for name in ("GLSTAT", "NODOUT", "RWFORC"):
        lines += ["*DATABASE_" + name, "%r," % step]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines + ["*END", ""]))
    data = {"meta": {}, "exact": False, "bound": (1.0 + o.get("courant", 0.5)) / n, "mu": 0.0}
    # where the law still has a simple wave and a step is shorter than the crossing
    known = speed < 0.266 and 12.0 * step <= 0.9
    return dict(data, way=step * speed, edge=1.0 / n, finite=(speed, touch, known))


def error_of(folder, data):
    """The largest displacement that is off, .9 of a crossing after the touch, over 2 v0 L/c."""
    speed, touch, known = data["finite"]
    if not known:
        return None
    nodes = tables.read_run(folder, "nodout")
    time = nodes["time"][-1] - touch
    rows = nodes["time"] == nodes["time"][-1]
    place = nodes["x"][rows] - nodes["ux"][rows]
    place = place.max() - place  # from the face that touches, in the reference
    points, weights = np.polynomial.legendre.leggauss(20)
    along = 0.5 * place[:, None] * (1.0 + points)
    now = -0.5 * place * (finite_forms.exact_stretch(along, time, speed) @ weights)
    return float(np.abs(nodes["x"][rows] - now).max() / (2.0 * speed))


def thrown(path, c, bodies, step, mu):
    """Writes the deck of free bodies, returns the data for the judge."""
    scene = stability_bodies.scene_of(bodies, step, mu, steps=STEPS, end=STEPS * step)
    lines = control(c, step, scene["end"]) + collide_deck.geometry(scene)
    lines += collide_deck.parts(scene) + collide_deck.contacts(scene)
    lines += collide_deck.tables(scene, 1) + ["*END", ""]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines))
    return {"bodies": scene, "meta": {}, "exact": False, "bound": 0.0}


def mooney(density, scale, poisson):
    """Shear modulus `scale`, four fifths of it by A."""
    return [
        "*MAT_MOONEY-RIVLIN_RUBBER",
        "%%d,%r,%r,%r,%r" % (density, poisson, 0.4 * scale, 0.1 * scale),
    ]


def foam(density, scale):
    return ["*MAT_BLATZ-KO_FOAM", "%%d,%r,%r" % (density, scale)]


def rubber_bars(path, c, o):
    """Two bars of 5 x 2 cells of Mooney's rubber meet end to end; speeds over that of shear
    waves of the slower bar, step half of what they take through an edge of the faster."""
    poisson, high = o.get("poisson", 0.49), 2.0 / o.get("aspect", 1.0)
    softer, lighter = o.get("youngs", 1.0), o.get("densities", 1.0)
    waves = 1.0, math.sqrt(softer / lighter)
    step = 0.25 * min(1.0, 0.5 * high) / max(waves)
    step *= 0.3 if c["method"] == "PAOLI 0" else 1.0  # below its limit up to PR .49
    v = min(0.05 * min(waves), 0.02 * min(1.0, 0.5 * high) / step)
    v = o.get("amplitude", v)
    bodies = []
    for k, (ratio, density) in enumerate(((1.0, 1.0), (softer, lighter))):
        start = -5.0 if k == 0 else 7.0 * v * step
        b = stability_bodies.rectangle(5.0, high, 5, 2, (start, 0.0), density=density)
        b["law"] = mooney(density, ratio, poisson)
        stability_bodies.throw(b, v if k == 0 else -v, 0.0)
        bodies.append(b)
    return thrown(path, c, bodies, step, 0.3)


def foam_block(path, c, o):
    """A block of foam, turned, thrown obliquely on a slab of foam; speed over that of shear
    waves of the slower, step of a Courant number of the faster. Both of 1/8."""
    softer, lighter = o.get("youngs", 1.0), o.get("densities", 1.0)
    waves = 1.0, math.sqrt(softer / lighter)
    step = o.get("courant", 0.5) * 0.125 / (math.sqrt(3.0) * max(waves))
    v = o.get("amplitude", min(0.1 * min(waves), 0.05 * 0.125 / step))
    slab = stability_bodies.rectangle(2.0, 0.5, 16, 4, (0.0, -0.5), density=lighter)
    slab["law"] = foam(lighter, softer)
    block = stability_bodies.rectangle(0.5, 0.375, 4, 3, (0.8, 3.5 * v * step), 0.2)
    block["law"] = foam(1.0, 1.0)
    stability_bodies.throw(block, 0.6 * v, -v)
    return thrown(path, c, [slab, block], step, o.get("mu", 0.3))


SCENES = {f.__name__: f for f in (finite_bar, rubber_bars, foam_block)}
