"""Rigid walls of every shape, at rest, moved by a curve, with a mass: their closed forms, their ledgers
with every scheme, friction, ends. Every bound has its reason beside it."""

import os
import sys
from math import cos, log, pi, sin

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from bodies import Scene, box, boundary, deepest_node
from schemes import LEDGER, PLAIN, SCHEMES
from scenes import at_most, check, finish, run_text, show, table, within

import analytic
import make_scenes

MOTION = ("0.0,0.2", "0.05,1.0", "0.1,-0.5", "10.0,-0.5")
# shape: first card of its place, cards after it; its motion is appended
KINDS = (
    "moving",
    "FLAT",
    "FLAT_MOTION",
    "endless_MOTION",
    "CYLINDER",
    "CYLINDER_MOTION",
    "small",
    "small_MOTION",
    "bowl",
    "bowl_MOTION",
)


def wall_cards(kind, place, mu):
    """Cards of a wall below the origin, which it touches; place maps points and vectors."""

    def two(x, y):
        return "%r,%r" % place(x, y)

    shape = kind.replace("_MOTION", "")
    if shape == "moving":
        out = ["*RIGIDWALL_PLANAR_MOVING", "0,"]
        return out + ["%s,0.0,%s,0.0,%r" % (two(0.0, 0.0), two(0.0, 1.0), mu), "0.003,0.2"]
    name = {"endless": "FLAT", "small": "CYLINDER", "bowl": "CYLINDER_INTERIOR"}.get(shape, shape)
    out = ["*RIGIDWALL_GEOMETRIC_" + name + ("_MOTION" if "_MOTION" in kind else ""), "0,"]
    if name == "FLAT":
        out += ["%s,0.0,%s,0.0,%r" % (two(-0.31, 0.0), two(-0.31, 1.0), mu)]
        out += ["0.0," if shape == "endless" else two(1.0, 0.0) + ",0.0,0.87"]
    else:
        radius = {"small": 0.1, "bowl": 2.1}.get(shape, 0.7)
        centre = two(0.1, 2.0 if shape == "bowl" else -radius)
        out += ["%s,0.0,%s,1.0,%r" % (centre, centre, mu), "%r," % radius]
    if "_MOTION" in kind:
        out += ["5,0," + two(0.3, 0.8)]
    return out


def thrown(kind, scheme="THETA,0.5,0.5", dynamics="1,", mass="CONSISTENT,0", angle=0.0, mirror=False,
           mu=0.3, steps=800, frame=""):
    """A block that falls obliquely on a wall under its weight; (scene, text)."""
    c, s = cos(angle), sin(angle)

    def place(x, y):
        x = -x if mirror else x
        return c * x - s * y, s * x + c * y

    explicit = "LUMPED" in mass and ("CDLAGRANGE" in scheme or scheme.endswith("0."))
    dt = 2.0e-4 / (4 if explicit else 1)
    scene = Scene(dt=dt, steps=steps * (4 if explicit else 1), every=2.0e-3)
    scene.scheme = scheme
    upright = box(-0.5, 0.01, 1.0, 0.6, 0.03)
    body = scene.body(5, 3, lambda a, b: place(*upright(a, b)))
    if mirror:
        body.rings = [ring[::-1] for ring in body.rings]
    for n in body.nodes():
        scene.velocities[n] = place(0.6, -1.2)
    scene.cards += ["*DEFINE_CURVE", "5,"] + list(MOTION)
    scene.curve(6, [(0.0, 15.0), (10.0, 15.0)])
    for axis, g in zip("XY", place(0.0, 1.0)):
        if g != 0.0:    # a factor of 0 means its default
            scene.cards += ["*LOAD_BODY_" + axis, "6,%r" % g]
    scene.cards += wall_cards(kind, place, mu) + ["*BIPACT_MASS", mass]
    if frame:
        scene.cards += ["*BIPACT_CONTACT", "AUTO,", "," + frame]
    scene.tables += ["RWFORC"]
    card = "*CONTROL_IMPLICIT_DYNAMICS\n"
    return scene, scene.text().replace(card + "1,", card + dynamics)


def run(name, text):
    """Runs a deck that must end well, its contact solves with their certificate; its folder."""
    folder, code, errors = run_text(name, text)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    check("certificate" not in errors, "%s: %s" % (name, errors))
    return folder


def ledgers():
    """Every wall with every scheme and a mass of each kind: the ledger closes, with friction and the
    work of motions in it; Coulomb's law holds (TOL 1e-10 of the largest force). The explicit ones are
    the last of their rows."""
    explicit = ("PAOLI,,,,,,0.", "1,", ("LUMPED,0",))
    for kind in KINDS:
        for scheme, dynamics, masses in SCHEMES + (explicit,):
            for mass in masses if masses in (PLAIN, explicit[2]) else masses[:2]:
                name = "%s %s %s" % (kind, scheme, mass)
                _, text = thrown(kind, scheme, dynamics, mass, steps=500)
                folder = run("thrown", text)
                rows, force = table(folder, "glstat"), table(folder, "rwforc")
                at_most(np.abs(rows["residual"]).max(), LEDGER, name + ": ledger")
                check(np.hypot(force["ix"], force["iy"])[-1] > 0.0, name + ": it touches")
                check(np.abs(rows["friction"]).max() > 0.0, name + ": friction works")
                moves = np.abs(rows["motion"]).max() > 0.0
                check(moves == ("_MOTION" in kind), name + ": the work of its motion")
                excess = (np.abs(force["ft"]) - 0.3 * force["fn"]).max()
                at_most(excess, 1.0e-9 * force["fn"].max(), name + ": Coulomb's law")


def turned():
    """The scene turned, mirrored, and both: displacements and energies equal to 1e-9, as
    conventions of THETA have it for other round-off in the coordinates."""
    for kind in KINDS:
        for scheme in ("THETA,0.5,0.5", "MOREAU,0.5", "PAOLI,"):
            runs = []
            for angle, mirror in ((0.0, False), (1.0, False), (0.0, True), (2.3, True)):
                scene, text = thrown(kind, scheme, angle=angle, mirror=mirror)
                folder = run("turned", text)
                u = table(folder, "nodout").vectors("ux", "uy").reshape(-1, len(scene.place), 2)
                c, s = cos(angle), sin(angle)
                u = np.stack([c * u[..., 0] + s * u[..., 1], c * u[..., 1] - s * u[..., 0]], axis=-1)
                u[..., 0] *= -1.0 if mirror else 1.0
                runs.append((u, table(folder, "glstat")["total"]))
            for u, total in runs[1:]:
                name = "%s %s: " % (kind, scheme)
                for one, other, what in ((u, runs[0][0], "u"), (total, runs[0][1], "energy")):
                    at_most(np.abs(one - other).max() / np.abs(other).max(), 1.0e-9, name + what)


def scene_of(name, scene, **options):
    """A scene of make_scenes.py as it runs: (folder, its data)."""
    deck, folder = os.path.join(scenes.TMP, name + ".k"), os.path.join(scenes.TMP, name)
    meta = make_scenes.write(deck, scene, **options)
    code, errors, _ = scenes.bipact(deck, folder, "--quiet")
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder, meta


def periods(folder, meta):
    """Times between every second passage through the bottom, after gravity has grown [T]."""
    rows, n = table(folder, "nodout"), len(meta["nodes"])
    t, x = rows["time"][::n], rows["ux"].reshape(-1, n).mean(axis=1)
    k = np.nonzero((x[:-1] * x[1:] < 0.0) & (t[:-1] > meta["ramp"]))[0]
    zero = t[k] - x[k] * (t[k + 1] - t[k]) / (x[k + 1] - x[k])
    return zero[2:] - zero[:-2]


def bowl():
    """A stiff block on two corners in a smooth bowl, 5000 steps. Period: (w h)^2/12 = 8e-7, swing^2 =
    1e-6, weight over stiffness g rho H/E = 8e-7: 1e-5. Energy: the internal forces of a turned stiff
    body are round-off of E times the turn, E = 100 leaves 1e-11 of the energy of the swing; 1e-10. The
    gap at the end of a step is found in rounds until nothing changes: eps R; with FRAME START a step
    of s sinks in by s^2/(2 R), and nothing pays for its way back."""
    folder, meta = scene_of("period", "bowl", output=None)
    found = periods(folder, meta) / meta["exact"].period() - 1.0
    check(len(found) >= 1, "the block swings")
    at_most(np.abs(found).max(), 1.0e-5, "period")
    rigid = meta["exact"].period(small_displacements=False) / meta["exact"].period() - 1.0
    check(abs(rigid) > 1.0e-2, "that of a rigid body is another one")
    for swing in (0.02, 0.1):
        folder, meta = scene_of("energy", "bowl", young=100.0, swing=swing)
        rows = table(folder, "glstat")
        drift = (rows["total"] - rows["external"]) / rows["initial"][0] - 1.0
        at_most(np.abs(drift).max(), 1.0e-10, "swing %g: energy" % swing)
        force = table(folder, "rwforc")
        at_most(-force["gapmin"].min(), 1.0e-14 * meta["exact"].radius, "swing %g: overlap" % swing)
        check((force["nactive"][1:] == 2).all(), "swing %g: both corners glide" % swing)
    folder, meta = scene_of("start", "bowl", young=100.0, swing=0.02, frame="START")
    step = 0.02 * 2.0 * pi / meta["exact"].period() * meta["exact"].radius * meta["dt"]
    sunk = -table(folder, "rwforc")["gapmin"].min()
    check(sunk > 0.5 * step**2 / (2.0 * meta["exact"].radius), "FRAME START sinks in")


def rigid_bowl():
    """A true rigid block on two corners in a smooth bowl, released at rest in contact, THETA 1/2, 5000
    steps. The row's motion is exactly the relative motion (discrete gradient of the circle and of the
    rotation), so that walls give and take no work: energy to 1e-10 of that of the swing, round-off of 5000
    steps of some 1e-14. Period of the physical pendulum at its amplitude: (w h)^2/12 = 8e-7, 1e-5. The gap
    at the end of a step is found in rounds until nothing changes: 2e-14 R."""
    folder, meta = scene_of("rigid", "rigid_bowl", output=None)
    rows, part, force = (table(folder, name) for name in ("glstat", "rbdout", "rwforc"))
    drift = (rows["total"] - rows["external"]) / rows["kinetic"].max()
    at_most(np.abs(drift).max(), 1.0e-10, "rigid: energy")
    found = rigid_periods(part["time"], meta["swing"] + part["rz"])
    check(len(found) == 3, "rigid: it swings")
    at_most(np.abs(found / meta["period"] - 1.0).max(), 1.0e-5, "rigid: period")
    small = meta["exact"].period(small_displacements=False)
    check(np.abs(found / small - 1.0).min() > 1.0e-3, "that of small swings is another one")
    check((force["nactive"][1:] == 2).all() and (force["fn"][1:] > 0.0).all(), "both corners glide")
    at_most(np.abs(force["gapmin"][1:]).max(), 2.0e-14, "rigid: overlap")
    # A residual is a share of the largest term so far, 1e-5 of the swing in the first step.
    share = np.maximum.accumulate(rows["total"]) / rows["kinetic"].max()
    at_most(np.abs(rows["residual"] * share).max(), LEDGER, "rigid: ledger")
    folder, meta = scene_of("rigid_start", "rigid_bowl", frame="START")
    sunk = -table(folder, "rwforc")["gapmin"][1:].min()
    check(sunk > 1.0e-4, "FRAME START sinks in by %g: the test bites" % sunk)


def rigid_periods(t, angle):
    """Times between every second passage through the bottom [T]."""
    k = np.nonzero(angle[:-1] * angle[1:] < 0.0)[0]
    zero = t[k] - angle[k] * (t[k + 1] - t[k]) / (angle[k + 1] - angle[k])
    return zero[2:] - zero[:-2]


def mass_on_rod():
    """F = Z V exp(-Z t/M). DISPERSION at Courant number 1: the rod is a dashpot to the last digit, the
    mass obeys the mid-point rule, z = Z h/M: its rate is off by z^2/12, its two-step mean by z^2/6, on
    times up to 1.9 M/Z: 0.33 z^2 of the mean force; order 2. Others: 2 % with 100 elements, order 0.9
    (a front of width h, O(h) of the impulse); the same where the mass is a rigid part in place of a wall.
    No friction, free rod: momentum to round-off of 400 steps."""
    for scheme, mass, courant, bound, order, part in (
        ("THETA", ("DISPERSION", 0), 1.0, 0.33e-4, 1.9, 0),
        ("THETA", ("DISPERSION", 1), 0.5, 0.02, 0.9, 0),
        ("CDLAGRANGE", ("LUMPED", 0), 0.5, 0.02, 0.9, 0),
        ("THETA", ("DISPERSION", 0), 1.0, 0.33e-4, 1.9, 1),
        ("THETA", ("DISPERSION", 1), 0.5, 0.02, 0.9, 1),
        ("CDLAGRANGE", ("LUMPED", 0), 0.5, 0.02, 0.9, 1),
    ):
        errors = []
        for n in (50, 100, 200):
            folder, m = scene_of("rod", "mass_on_rod", n=n, scheme=scheme, courant=courant,
                                 mass=mass[0], redist=mass[1], angle=30.0, part=part)
            rows = table(folder, "rcforc", side=1) if part else table(folder, "rwforc")
            t = rows["time"][2:] - m["dt"]    # the mean of two steps is that at their middle
            force = -(rows["fmx"] * cos(pi / 6.0) + rows["fmy"] * sin(pi / 6.0))[2:]
            exact = analytic.mass_on_rod(m["impedance"], m["mass"], m["v"], t)
            errors.append(np.abs(force - exact).mean() / exact.mean())
        name = "%s %s %s: " % (scheme, mass[0], "part" if part else "wall")
        at_most(errors[1], bound, name + "force, 100 elements")
        within(log(errors[0] / errors[2], 4.0), order, 2.5, name + "order")
        first = table(folder, "glstat")
        at_most(abs(first["kinetic"][0] / (0.5 * m["mass"] * m["v"] ** 2) - 1.0), 1.0e-14,
                name + "its energy is kinetic")
    for mu in (0.0, 0.4):
        free_rod(mu)
    weightless()


def free_rod(mu):
    """A free rod that a wall with a mass strikes, the rod sliding along it: momentum with mu = 0; with
    friction the guide of the wall takes what acts across, and the wall has none across."""
    angle, dt = 0.7, 1.0e-4
    c, s = cos(angle), sin(angle)
    scene = Scene(dt=dt, steps=400, every=1.0e-3)
    body = scene.body(8, 2, box(0.0, 0.0, 2.0, 0.5, angle), velocity=(-0.3 * s, 0.3 * c))
    scene.cards += ["*RIGIDWALL_PLANAR_MOVING", "0,"]
    scene.cards += ["%r,%r,0.0,%r,%r,0.0,%r" % (-0.001 * c, -0.001 * s, c, s, mu), "0.002,1.0"]
    scene.tables += ["RWFORC"]
    folder = run("free", scene.text())
    rows, parts = table(folder, "glstat"), table(folder, "matsum")
    p = rows.vectors("momx", "momy")
    largest = np.hypot(*p.T).max()
    wall = p - parts.vectors("momx", "momy")
    check(np.abs(wall - wall[0]).max() > 0.1 * largest, "the wall is slowed down")
    at_most(np.abs(-s * wall[:, 0] + c * wall[:, 1]).max() / largest, 1.0e-14,
            "mu %g: the wall moves along its normal" % mu)
    if mu == 0.0:
        at_most(np.abs(p - p[0]).max() / largest, 1.0e-12, "momentum")
    else:
        along = c * p[:, 0] + s * p[:, 1]
        at_most(np.abs(along - along[0]).max() / largest, 1.0e-12, "momentum along the normal")
        across = -s * p[:, 0] + c * p[:, 1]
        check(across[-1] < across[0] - 0.01 * largest, "friction acts on the rod across")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "mu %g: ledger" % mu)


def weightless():
    """The wall has no weight: what falls is the block, the wall flies on as it did."""
    scene = Scene(dt=1.0e-3, steps=20)
    scene.body(2, 2, box(0.0, 0.0, 1.0, 1.0))
    scene.gravity(10.0)
    scene.cards += ["*RIGIDWALL_PLANAR_MOVING", "0,", "0.0,-5.0,0.0,0.0,1.0,0.0", "0.5,2.0"]
    folder = run("weightless", scene.text())
    wall = table(folder, "glstat")["momy"] - table(folder, "matsum")["momy"]
    at_most(np.abs(wall - 1.0).max(), 1.0e-14, "a wall has no weight")


def belt():
    """A block set down on a belt. The normal force swings about m g with period 4 H/c (see
    make_scenes.sliding): velocity to mu g 4 H/c, works to mu m g V 4 H/c, but for a tenth of the time
    around the catch, when its foot slips and sticks by turns. In the end the belt has given m V^2, half
    of it is in the block. Seen from the belt it is the block that slides to rest on a wall: 1e-9, as for
    any other round-off, until the catch is near and round-off decides which node sticks first. The same
    on a finite belt whose ends are far, and turned."""
    folder, m = scene_of("sliding", "sliding")
    at_rest = table(folder, "matsum")["momx"] / m["mass"]
    folder, m = scene_of("belt", "belt")
    carried = table(folder, "matsum")["momx"] / m["mass"]
    early = table(folder, "matsum")["time"] < 0.9 * m["v"] / (m["mu"] * m["g"])
    misfit = np.abs(at_rest + carried - m["v"])[early].max() / m["v"]
    at_most(misfit, 1.0e-9, "the same seen from the belt")
    for options in ({}, {"ends": (-0.5, 3.0)}, {"angle": 200.0, "scheme": "PAOLI"},
                    {"scheme": "MOREAU", "angle": 90.0}, {"scheme": "CSNEWMARK"}):
        folder, m = scene_of("belt", "belt", **options)
        exact = analytic.Belt(m["v"], m["mu"], m["g"], m["mass"])
        rows, parts = table(folder, "glstat"), table(folder, "matsum")
        t, weight = rows["time"], m["mu"] * m["mass"] * m["g"]
        name = "belt %s: " % (options or "")
        v = np.hypot(parts["momx"], parts["momy"]) / m["mass"]
        check(t[-1] > exact.catch + m["bounce"], name + "it sticks in the end")
        bound = weight * m["v"] * m["bounce"]
        far = np.abs(t / exact.catch - 1.0) > 0.1
        for value, expected, most, what in (
            (v, exact.velocity(t), m["mu"] * m["g"] * m["bounce"], "velocity"),
            (rows["motion"], exact.belt_work(t), bound, "work of the belt"),
            (rows["friction"], exact.friction_work(t), bound, "friction"),
        ):
            at_most(np.abs(value - expected)[far].max(), most, name + what)
        at_most(np.abs(rows["residual"]).max(), LEDGER, name + "ledger")


def disc():
    """A disc moves along under a block and lifts it: ledger with `motion`; the mean of the force is
    the weight and what lifts, from the impulse: m (g t + v) to 1e-9 of it (momentum of the block)."""
    scene = Scene(dt=2.0e-4, steps=1500, every=2.0e-3)
    body = scene.body(8, 4, box(-1.0, 0.005, 2.0, 1.0))
    scene.gravity(5.0)
    scene.curve(1, [(0.0, 0.0), (0.1, 1.0), (10.0, 1.0)])
    scene.cards += ["*RIGIDWALL_GEOMETRIC_CYLINDER_MOTION", "0,"]
    scene.cards += ["-0.3,-3.0,0.0,-0.3,-3.0,1.0,0.3", "3.0,", "1,0,1.0,0.3"]
    scene.tables += ["RWFORC"]
    folder = run("disc", scene.text())
    rows, force = table(folder, "glstat"), table(folder, "rwforc")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "disc: ledger")
    check(rows["motion"][-1] > 0.1 * rows["total"].max(), "disc: its work")
    check(force["nslip"].max() > 0 and rows["friction"][-1] > 0.0, "disc: it slips")
    mass = 2.0e-3
    lifted = force["iy"] - mass * 5.0 * rows["time"]
    at_most(np.abs(rows["momy"] - lifted).max() / force["iy"][-1], 1.0e-9, "disc: impulse")
    # Nodes are exact, an edge of the block holds 1e-3 of its length away from the disc.
    at_most(-force["gapmin"].min(), 1.1e-3 * 0.25, "disc: overlap")


# ------------------------------------------------------------------------ ends


def on_end(shape, cells, velocity, wall, mu=0.2, weight=15.0, steps=1000, scheme="THETA,0.5", dt=2.0e-4):
    """A block and a finite wall from wall[0] to wall[1] on the line y = 0, in front of it above;
    every step: (folder, positions, boundary)."""
    scene = Scene(dt=dt, steps=steps)
    scene.scheme = scheme
    body = scene.body(*cells, shape)
    for n in body.nodes():
        scene.velocities[n] = velocity
    if weight:
        scene.gravity(weight)
    a, b = wall
    scene.cards += ["*RIGIDWALL_GEOMETRIC_FLAT", "0,", "%r,0.0,0.0,%r,1.0,0.0,%r" % (a, a, mu)]
    scene.cards += ["%r,0.0,0.0,%r" % (b, abs(b - a))]
    scene.tables += ["RWFORC"]
    folder = run("end", scene.text())
    return folder, scene.positions(table(folder, "nodout")), boundary(body.rings)


def depth_of_ends(x, edges, ends):
    """How deep the ends of a wall stand in the body, largest of all times."""
    worst = 0.0
    for at in x:
        at = np.vstack([at, [[p, 0.0] for p in ends]])
        n = len(at)
        own = np.array([[n - 2, n - 2], [n - 1, n - 1]])
        worst = max(worst, deepest_point(at, own, edges))
    return worst


def deepest_point(x, own, edges):
    """As bodies.deepest_node, whose points have no edges."""
    a, b = x[edges[:, 0]], x[edges[:, 1]]
    worst = 0.0
    for p in x[own[:, 0]]:
        upward = (a[:, 1] > p[1]) != (b[:, 1] > p[1])
        rise = np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
        if (upward & (p[0] < a[:, 0] + (p[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / rise)).sum() % 2:
            s = np.clip(((p - a) * (b - a)).sum(1) / ((b - a) ** 2).sum(1), 0.0, 1.0)
            worst = max(worst, np.hypot(*(p - a - s[:, None] * (b - a)).T).min())
    return worst


def ends():
    """The ends of a finite wall are corners. A tip that meets an edge away from its nodes has an exact
    row: an edge that turns by dphi while the tip slips s leaves s dphi, here 1e-3 x 1e-4; near a node it
    has the allowance of 2e-4 of the edge. The program measures the same depth: an end before the foot of
    a block is not deep in its side. Energy is not made, the ledger closes, a body may go round an end and
    behind."""
    for name, shape, cells, velocity, wall, weight, bound in (
        ("middle", box(-0.4, 0.005, 1.0, 0.5), (4, 3), (0.0, -1.0), (0.0, 5.0), 15.0, 1.0e-6),
        ("one edge", box(-0.4, 0.005, 1.0, 0.5), (1, 1), (0.0, -1.0), (0.0, 5.0), 15.0, 1.0e-6),
        ("corner", box(-0.005, 0.003, 1.0, 1.0, 0.02), (2, 1), (0.0, -1.0), (0.0, 0.28), 0.0, 1.1e-4),
        ("side", box(0.02, -0.31, 1.0, 0.5), (4, 3), (-1.0, 0.0), (-5.0, 0.0), 0.0, 1.0e-6),
        ("oblique", box(0.02, -0.31, 1.0, 0.5), (4, 3), (-1.0, -1.0), (-5.0, 0.0), 0.0, 2.2e-4 / 6),
        ("off the table", box(-0.9, 0.0, 1.0, 0.5), (4, 3), (3.0, 0.0), (-5.0, 0.3), 15.0, 2.2e-4 / 4),
        ("tilted", box(-0.6, 0.11, 1.0, 0.5, -0.1), (5, 3), (0.0, -1.0), (0.0, 5.0), 15.0, 2.2e-4 / 5),
    ):
        folder, x, edges = on_end(shape, cells, velocity, wall, weight=weight)
        rows, force = table(folder, "glstat"), table(folder, "rwforc")
        check((force["fn"] > 0.0).any(), name + ": it touches")
        at_most(depth_of_ends(x[::5], edges, wall), bound, name + ": depth of the end")
        at_most(-force["gapmin"].min(), bound, name + ": depth as measured")
        free = rows["total"] - rows["external"]
        at_most(free.max() / (rows["initial"][0] or free.max()), 1.0 + 1.0e-9, name + ": energy")
        at_most(np.abs(rows["residual"]).max(), 1.0e-10, name + ": ledger")
    folder, x, edges = on_end(box(0.1, -0.9, 1.0, 0.5), (4, 3), (-1.5, 0.2), (-5.0, 0.0), weight=0.0,
                              steps=3000, dt=4.0e-4)
    check(x[-1, :, 0].max() < 0.0 and x[-1, :, 1].max() < 0.0, "the body is behind the wall")
    check(not (table(folder, "rwforc")["fn"] > 0.0).any(), "and has not been touched")
    started_in_a_body()


def started_in_a_body():
    """An end, a disc, in a body at the start; a node behind a wall, beyond a bowl: exit 2 and the
    depth."""
    for name, cards, words in (
        ("end", ["FLAT", "0.5,0.2,0.0,0.5,1.0", "5.0,0.2,0.0,3.0"], "0.2 behind wall 1"),
        ("disc", ["CYLINDER", "0.5,0.25,0.0,0.5,0.25,1.0", "0.01,"], "behind wall 1"),
        ("node in a disc", ["CYLINDER", "0.0,-1.0,0.0,0.0,-1.0,1.0", "1.1,"], "0.1 behind wall 1"),
        ("bowl", ["CYLINDER_INTERIOR", "0.0,0.0,0.0,0.0,0.0,1.0", "0.9,"], "behind wall 1"),
    ):
        scene = Scene(steps=2)
        scene.body(4, 4, box(0.0, 0.0, 1.0, 0.5))
        scene.cards += ["*RIGIDWALL_GEOMETRIC_" + cards[0], "0,"] + cards[1:]
        _, code, errors = run_text("start", scene.text())
        show(errors.split("\n")[0])
        check(code == 2 and "at the start" in errors and words in errors, name + ": " + errors)


def statics():
    """A block pressed on walls that move, in load steps: the ledger of statics, balance of forces
    between wall and supports (RES 1e-10)."""
    for kind in ("FLAT_MOTION", "endless_MOTION", "CYLINDER_MOTION", "small_MOTION", "CYLINDER"):
        scene = Scene(dt=0.05, steps=20)
        body = scene.body(8, 8, box(-0.5, 0.0, 1.0, 0.6))
        scene.hold(body.row(8), 1, 0)
        scene.curve(7, [(0.0, 0.0), (1.0, -0.02)])
        scene.cards += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "%d,2,2,7,1.0" % scene.node_set(body.row(8))]
        cards = wall_cards(kind, lambda x, y: (x, y), 0.2)
        if "_MOTION" in kind:
            scene.curve(5, [(0.0, 0.0), (1.0, 0.03)])
            cards[-1] = "5,1,1.0,0.2"
        scene.cards += cards
        scene.tables += ["RWFORC", "SPCFORC"]
        text = scene.text().replace(
            "*CONTROL_IMPLICIT_DYNAMICS\n1,\n*BIPACT_TIME\nTHETA,0.5,", "*CONTROL_IMPLICIT_DYNAMICS\n0,"
        )
        folder = run("static", text)
        rows, wall = table(folder, "glstat"), table(folder, "rwforc")
        held = table(folder, "spcforc")
        at_most(np.abs(rows["residual"]).max(), LEDGER, kind + ": ledger of statics")
        for axis in ("fx", "fy"):
            total = held[axis].reshape(len(rows["time"]), -1).sum(axis=1)
            # the table of reactions is the mean of the step
            mean = 0.5 * (wall[axis][1:] + wall[axis][:-1])
            misfit = np.abs(total[1:] + mean).max() / wall["fn"].max()
            at_most(misfit, 1.0e-9, "%s: balance of %s" % (kind, axis))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
