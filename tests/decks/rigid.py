"""Rigid parts: flight, impacts against closed forms, random impacts, ledgers, statics, motions, restart.
Every bound has its reason beside it."""

import math
import os
import random
import shutil
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from scenes import BIPACT, TMP, at_most, bipact, check, finish, run_text, table, within

import analytic

# Forces, levers and motions close to round-off (conventions of the ledger).
LEDGER = 1.0e-11
# *BIPACT_TIME, *CONTROL_IMPLICIT_DYNAMICS
SCHEMES = (
    ("THETA,", "1,"),
    ("THETA,0.7,0.6", "1,"),
    ("NEWMARK,", "1,0.6,0.3025"),
    ("HHT,", "1,,,,,,,-0.2"),
    ("GENALPHA,", "1,"),
    ("MOREAU,", "1,"),
    ("MOREAU,0.6,0.55,0.5,,PLAIN", "1,"),
    ("PAOLI,", "1,"),
    ("PAOLI,,,0.5", "1,"),
    ("CDLAGRANGE,,,0.3", "1,"),
    ("THETAPV,", "1,"),
    ("NSGENALPHA,", "1,"),
    ("NSGENALPHA,,,0.5,0.7", "1,"),
    ("CSNEWMARK,", "1,"),
)


class Scene:
    """Meshes of parts, cards, and the deck of them."""

    def __init__(self):
        self.nodes, self.elements, self.parts, self.cards = [], [], [], []

    def disc(self, part, centre, radius, n, density=1.0, turn=-math.pi / 2):
        """A polygon of n corners as triangles about its centre; its first corner is the lowest."""
        first = len(self.nodes) + 1
        self.nodes.append(centre)
        for k in range(n):
            a = turn + 2 * math.pi * k / n
            x, y = centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)
            self.nodes.append((x, y))
        for k in range(n):
            a, b = first + 1 + k, first + 1 + (k + 1) % n
            self.elements.append((part, first, a, b, b))
        self.rigid(part, density)

    def block(self, part, corner, size, n, turn=0.0, density=1.0, young=None, con=(0, 0)):
        """A rectangle turned about its corner; rigid but where a modulus is given."""
        first = len(self.nodes) + 1
        c, s = math.cos(turn), math.sin(turn)
        for i in range(n[0] + 1):
            for j in range(n[1] + 1):
                x, y = size[0] * i / n[0], size[1] * j / n[1]
                self.nodes.append((corner[0] + c * x - s * y, corner[1] + s * x + c * y))
        for i in range(n[0]):
            for j in range(n[1]):
                a = first + i * (n[1] + 1) + j
                self.elements.append((part, a, a + n[1] + 1, a + n[1] + 2, a + 1))
        if young:
            self.parts.append((part, "*MAT_ELASTIC\n%d,%r,%r,0.3" % (part, density, young)))
        else:
            self.rigid(part, density, con)
        return first

    def rigid(self, part, density, con=(0, 0)):
        card = "*MAT_RIGID\n%d,%r\n%d,%d,%d\n," % (part, density, any(con), con[0], con[1])
        self.parts.append((part, card))

    def deck(self, end, dt, scheme="", dynamics="1,", every=None):
        out = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % end]
        out += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % dt]
        if dynamics:
            out += ["*CONTROL_IMPLICIT_DYNAMICS", dynamics]
        if scheme:
            out += ["*BIPACT_TIME", scheme]
        out += ["*NODE"] + ["%d,%r,%r" % (k, *x) for k, x in enumerate(self.nodes, 1)]
        out += ["*ELEMENT_SHELL"]
        out += ["%d,%d,%d,%d,%d,%d" % (k, *e) for k, e in enumerate(self.elements, 1)]
        for part, material in self.parts:
            out += ["*PART", "a part", "%d,1,%d" % (part, part), material]
        out += ["*SECTION_SHELL", "1,13", "1.0,"] + self.cards
        for name in ("GLSTAT", "MATSUM", "RBDOUT", "RCFORC", "RWFORC", "SLEOUT"):
            out += ["*DATABASE_" + name, "%r," % (every or dt)]
        return "\n".join(out + ["*END", ""])

    def run(self, name, *deck, **more):
        folder, code, errors = run_text(name, self.deck(*deck, **more))
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        return folder if code == 0 else None


def polygon(radius, n):
    """Area and polar second moment of a regular polygon."""
    area = 0.5 * n * radius**2 * math.sin(2 * math.pi / n)
    return area, area * radius**2 * (2 + math.cos(2 * math.pi / n)) / 6


def flight():
    """Two rigid parts with spin in free flight, 200 steps: every scheme keeps energy, momentum and
    angular momentum to the round-off of its update, some ten eps a step, and the rotation is
    omega t."""
    for scheme, dynamics in SCHEMES:
        s = Scene()
        s.disc(1, (0.3, 0.2), 0.5, 12)
        s.block(2, (3.0, 1.0), (1.0, 0.5), (2, 1), turn=0.3)
        s.cards = ["*INITIAL_VELOCITY_RIGID_BODY", "1,1.0,2.0,,,,3.0", "2,-1.0,0.5,,,,-7.0"]
        folder = s.run("flight", 2.0, 0.01, scheme, dynamics)
        if not folder:
            continue
        rows, part = table(folder, "glstat"), table(folder, "rbdout", part=1)
        for column in ("total", "momx", "momy", "angz"):
            spread = np.ptp(rows[column]) / np.abs(rows[column]).max()
            at_most(spread, 5.0e-13, "%s in flight: %s" % (scheme, column))
        at_most(abs(part["rz"][-1] - 6.0), 1.0e-12, scheme + " in flight: rotation")
        area = polygon(0.5, 12)[0]
        at_most(abs(part["mass"][0] / area - 1.0), 1.0e-14, "mass of a polygon")


def oblique():
    """A disc whose lowest node meets a wall, MOREAU: gross slip where V_t >= mu kappa V_n, else
    its node leaves with -e V_t (the law v1 + e v0 in both directions). kappa = 1 + R^2/k^2 of the
    polygon. One solve of three unknowns: round-off, with digits of the gap at the touch."""
    radius, n, v_n = 0.5, 16, 1.0
    area, second = polygon(radius, n)
    k2 = second / area
    for e in (0.0, 0.5, 0.9, 1.0):
        for mu in (0.0, 0.1, 0.3, 0.9):
            for v_t in (0.2, 1.0, 3.0, -1.5):
                s = Scene()
                s.disc(1, (0.0, radius + 0.0233), radius, n)
                s.cards = ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,%r" % mu]
                s.cards += ["*INITIAL_VELOCITY_RIGID_BODY", "1,%r,%r" % (v_t, -v_n)]
                folder = s.run("oblique", 0.05, 0.01, "MOREAU,,,%r" % e)
                slips = abs(v_t) >= mu * (1.0 + radius**2 / k2) * v_n
                exact = analytic.disc_impact(radius, k2, mu, e, v_t, v_n)
                found = [table(folder, "rbdout")[c][-1] for c in ("vx", "vy", "wz")]
                name = "oblique impact e %g mu %g V_t %g" % (e, mu, v_t)
                error = max(abs(a - b) for a, b in zip(found, exact))
                at_most(error, 1.0e-12, name + (" (slip)" if slips else " (stick)"))


def row():
    """Three equal discs in a row, the first arrives: all contacts at once, not one after the other.
    Solved to TOL 1e-14 of W, so that the velocities are exact to 1e-12."""
    for e in (0.0, 0.5, 1.0):
        exact = analytic.three_in_a_row(e)
        s = Scene()
        for k in range(3):
            s.disc(k + 1, (1.0 * k - (0.0137 if k == 0 else 0.0), 0.0), 0.5, 16)
        s.cards = ["*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", "0,", "*BIPACT_CONTACT", ",1.0e-14"]
        s.cards += ["*INITIAL_VELOCITY_RIGID_BODY", "1,1.0"]
        folder = s.run("row", 0.05, 0.01, "MOREAU,,,%r" % e)
        for k in range(3):
            v = table(folder, "rbdout", part=k + 1)
            error = max(abs(v["vx"][-1] - exact[k]), abs(v["vy"][-1]), abs(v["wz"][-1]))
            at_most(error, 1.0e-12, "three in a row, e %g: disc %d" % (e, k + 1))


def thrown_pair(seed):
    """Two random polygons thrown at each other: the scene, and e."""
    draw = random.Random(seed)
    s = Scene()
    radius = [draw.uniform(0.3, 1.0) for _ in range(2)]
    a = draw.uniform(0, 2 * math.pi)
    far = 1.02 * sum(radius)
    for k in range(2):
        place = (k * far * math.cos(a), k * far * math.sin(a))
        n, density, turn = draw.randint(3, 12), draw.uniform(0.2, 5.0), draw.uniform(0.0, 6.3)
        s.disc(k + 1, place, radius[k], n, density, turn)
    b = a + draw.uniform(-0.6, 0.6)
    s.cards = ["*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", "0,,,,%r" % draw.choice((0.3, 1.0))]
    s.cards += ["*INITIAL_VELOCITY_RIGID_BODY"]
    for k in range(2):
        v = draw.uniform(0.5, 2.0) if k == 0 else -draw.uniform(0.0, 0.5)
        spin = draw.uniform(-4.0, 4.0)
        s.cards += ["%d,%r,%r,,,,%r" % (k + 1, v * math.cos(b), v * math.sin(b), spin)]
    return s, draw.choice((0.5, 0.9, 1.0))


def random_impacts():
    """200 pairs of rigid polygons thrown at each other, mu 0.3 or 1, e 0.5, 0.9 or 1: what the
    tangential law v1 + e v0 promises is that no impact gives energy (1e-9, the TOL of the contact
    solve); momentum is exact, for every row pushes both parts by the same force."""
    touched = rise = drift = ledger = 0.0
    for seed in range(200):
        s, e = thrown_pair(seed)
        folder = s.run("thrown", 1.5, 0.005, "MOREAU,,,%r" % e)
        rows = table(folder, "glstat")
        start = rows["total"][0]
        touched += np.any(table(folder, "sleout", contact=0)["solves"] > 0)
        rise = max(rise, np.diff(rows["total"]).max() / start)
        ledger = max(ledger, np.abs(rows["residual"]).max())
        for column in ("momx", "momy"):
            drift = max(drift, np.ptp(rows[column]) / math.sqrt(start))
    within(touched, 190, 200, "pairs that meet")
    at_most(rise, 1.0e-9, "energy given by a random impact")
    at_most(drift, 1.0e-12, "momentum over random impacts")
    at_most(ledger, LEDGER, "ledger over random impacts")


def crowd():
    """A deformable base, a turned rigid block, a rigid disc on it, a wall, friction, weight."""
    s = Scene()
    s.block(1, (-2.0, -1.0), (5.0, 1.0), (10, 2), young=1.0e4)
    first = s.block(2, (0.0, 0.05), (1.0, 0.5), (3, 2), turn=0.2, density=2.0)
    s.disc(3, (0.9, 1.6), 0.4, 10)
    s.cards = ["*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", "0,,,,0.3"]
    s.cards += ["*SET_NODE_LIST_GENERATE", "9,", "%d,%d" % (first, len(s.nodes))]
    s.cards += ["*RIGIDWALL_PLANAR", "9,", "2.2,0.0,0.0,1.2,0.0,0.0,0.2"]
    s.cards += ["*INITIAL_VELOCITY_RIGID_BODY", "2,0.6,-1.0,,,,1.0", "3,0.5,-2.0,,,,-3.0"]
    s.cards += ["*BOUNDARY_SPC_NODE"] + ["%d,,1,1" % (1 + 3 * i) for i in range(11)]
    s.cards += ["*DEFINE_CURVE", "1,", "0.0,9.81", "9.0,9.81", "*LOAD_BODY_Y", "1,"]
    return s


def moved():
    """Rigid parts on a deformable base: one moved and turned by curves, one of two joined parts
    under a force and a moment that grow."""
    s = Scene()
    s.block(1, (-2.0, -1.0), (5.0, 1.0), (10, 2), young=1.0e4)
    s.block(2, (0.0, 0.01), (1.0, 0.5), (2, 1), density=2.0)
    s.block(3, (1.3, 0.02), (1.0, 0.4), (2, 1), density=2.0)
    s.block(4, (1.5, 0.45), (0.5, 0.45), (1, 1), density=1.0)
    s.cards = ["*CONSTRAINED_RIGID_BODIES", "3,4"]
    s.cards += ["*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE", "0,,,,0.3"]
    s.cards += ["*BOUNDARY_SPC_NODE"] + ["%d,,1,1" % (1 + 3 * i) for i in range(11)]
    s.cards += ["*DEFINE_CURVE", "1,", "0.0,0.0", "1.0,1.0"]
    s.cards += ["*DEFINE_CURVE", "2,", "0.0,0.0", "0.2,1.0", "1.0,1.0"]
    s.cards += ["*BOUNDARY_PRESCRIBED_MOTION_RIGID", "2,2,2,1,-0.03", "2,7,2,1,0.02"]
    s.cards += ["2,1,2,1,0.01"]
    s.cards += ["*LOAD_RIGID_BODY", "3,2,2,-20.0", "3,7,2,1.0", "3,1,2,2.0"]
    return s


def ledgers():
    """Impacts, sliding, rolling and pressing of rigid parts on deformable and rigid ones: every
    scheme and statics close their ledger; prescribed parts end where their curves do."""
    for scheme, dynamics in SCHEMES:
        folder = crowd().run("crowd", 1.2, 0.002, scheme, dynamics)
        if folder:
            rows = table(folder, "glstat")
            at_most(np.abs(rows["residual"]).max(), LEDGER, scheme + " crowd: ledger")
            check(rows["friction"][-1] > 0.05, scheme + " crowd: no friction")
    for scheme, dynamics in SCHEMES + (("", ""), ("THETA,", "1,,,0.5")):
        step = 0.002 if "CDL" in scheme else 0.005
        s = moved()
        if "MOREAU" in scheme:
            # Parts sink in, and rows of both sides act: 16 equations of rank 12, which agree to the
            # depth only. Forces along their null vectors are found to 1e-9, not to 1e-10.
            s.cards += ["*BIPACT_CONTACT", ",1.0e-8"]
        folder = s.run("moved", 1.0, step, scheme, dynamics)
        if folder:
            rows = table(folder, "glstat")
            name = (scheme or "statics") + " moved: "
            at_most(np.abs(rows["residual"]).max(), LEDGER, name + "ledger")
            part = table(folder, "rbdout", part=2)
            for column, value in (("ux", 0.01), ("uy", -0.03), ("rz", 0.02)):
                # MOREAU and the like reach a displacement by sums of velocities.
                at_most(abs(part[column][-1] - value), 1.0e-12, name + column)


def ladder():
    """A rigid triangle whose corners A, B slide on a wall and a floor without friction, THETA 1/2:
    the gaps of A and B stay zero and so does the work of their forces, so the energy is that of
    the start to round-off of 2000 steps (1e-12 each, at most 1e-10), angle and rate keep to the
    rate that this energy gives, and the time of the fall errs by O(h^2)."""
    a0, length, g, end = 1.2, 1.0, 9.81, 0.25
    errors = []
    for dt in (4.0e-4, 2.0e-4):
        s = Scene()
        A, B = (0.0, length * math.sin(a0)), (length * math.cos(a0), 0.0)
        C = (0.5, 0.9)
        s.nodes = [A, B, C]
        s.elements = [(1, 1, 2, 3, 3)]
        s.rigid(1, 2.0)
        s.cards = ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0"]
        s.cards += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,1.0,0.0,0.0"]
        s.cards += ["*DEFINE_CURVE", "1,", "0.0,9.81", "9.0,9.81", "*LOAD_BODY_Y", "1,"]
        folder = s.run("ladder", end, dt, "THETA,0.5,0.5")
        rows, part = table(folder, "glstat"), table(folder, "rbdout")
        energy = rows["total"] - rows["external"]
        scale = rows["total"].max()
        for wall in (1, 2):
            force = table(folder, "rwforc", wall=wall)["fn"]
            check(force[1:].min() > 0.0, "ladder: it leaves wall %d" % wall)
        at_most(np.ptp(energy) / scale, 1.0e-10, "ladder: energy at h %g" % dt)
        # y of the centre by the angle, and the moment of inertia about the instant centre
        x = np.array([A, B, C])
        centre = x.mean(axis=0)
        k2 = sum(((x[i] - x[j]) ** 2).sum() for i, j in ((0, 1), (1, 2), (2, 0))) / 36
        turn = part["rz"]
        arm = centre - x[1]
        angle = a0 - turn    # of BA above the floor, falling as the triangle turns
        place_b = np.cos(angle) * length
        moved_x = place_b + np.cos(turn) * arm[0] - np.sin(turn) * arm[1]
        moved_y = np.sin(turn) * arm[0] + np.cos(turn) * arm[1]
        at_most(np.abs(part["x"] - moved_x).max(), 1.0e-9, "ladder: x of the centre")
        at_most(np.abs(part["y"] - moved_y).max(), 1.0e-9, "ladder: y of the centre")
        # the time to the last angle by the exact rate
        def rate(t):
            place = np.cos(a0 - t) * length, 0.0
            y = np.sin(t) * arm[0] + np.cos(t) * arm[1]
            instant = np.array([np.cos(a0 - t) * length, np.sin(a0 - t) * length])
            cx = place[0] + np.cos(t) * arm[0] - np.sin(t) * arm[1]
            lever2 = (cx - instant[0]) ** 2 + (y - instant[1]) ** 2
            return np.sqrt(2 * g * (centre[1] - y) / (lever2 + k2))

        sign = math.copysign(1.0, turn[-1])
        z, w = np.polynomial.legendre.leggauss(60)
        # t = int dphi/rate, singular as 1/sqrt at the start: phi = end s^2
        q = 0.5 * (z + 1.0)
        phi = turn[-1] * q**2
        time = sum(0.5 * w * 2 * q * abs(turn[-1]) / rate(phi))
        errors.append(abs(time - end))
        error = abs(sign * rate(turn[-1]) - part["wz"][-1])
        at_most(error, dt**2, "ladder: rate at h %g" % dt)
    within(errors[0] / errors[1], 3.5, 4.5, "ladder: order of the time")


def groove():
    """A rigid square in a groove of two walls at 45 degrees, without friction, in statics, from
    places and turns beside its rest: W/(2 cos 45) on each (RES 1e-10 of W), the square upright."""
    exact = 9.81 / (2 * math.cos(math.pi / 4))
    for turn, place in ((0.0, (0.0, 0.03)), (0.0, (0.01, 0.06)), (0.02, (0.0, 0.05))):
        s = Scene()
        s.block(1, place, (1.0, 1.0), (2, 2), turn=math.pi / 4 + turn)
        for x in (1.0, -1.0):
            s.cards += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,%r,1.0,0.0" % x]
        s.cards += ["*DEFINE_CURVE", "1,", "0.0,9.81", "9.0,9.81", "*LOAD_BODY_Y", "1,"]
        folder = s.run("groove", 0.3, 0.1, dynamics="")
        for wall in (1, 2):
            force = table(folder, "rwforc", wall=wall)["fn"][-1]
            at_most(abs(force / exact - 1.0), 1.0e-9, "groove: force of wall %d" % wall)
        rotation = table(folder, "rbdout")["rz"][-1]
        at_most(abs(rotation + turn), 1.0e-9, "groove: rotation")
        residual = table(folder, "glstat")["residual"]
        at_most(np.abs(residual).max(), LEDGER, "groove: ledger")


def cards():
    """Joined parts have the mass, centre and inertia of both; *PART_INERTIA those that it gives;
    CON1 and CON2 hold; velocities of nodes become that of the part; a moment turns as J says."""
    s = Scene()
    s.block(1, (0.0, 0.0), (2.0, 1.0), (2, 1), density=3.0)
    s.block(2, (2.0, 0.0), (1.0, 1.0), (1, 1), density=1.0)
    s.cards = ["*CONSTRAINED_RIGID_BODIES", "1,2", "*INITIAL_VELOCITY_GENERATION"]
    s.cards += ["0,1,2.0,0.5,-1.0", "1.0,2.0"]
    s.cards += ["*DEFINE_CURVE", "1,", "0.0,1.0", "9.0,1.0", "*LOAD_RIGID_BODY", "1,7,1,4.0"]
    folder = s.run("joined", 1.0, 0.01, "THETA,")
    part = table(folder, "rbdout", part=1)
    mass, x = 7.0, (6.0 * 1.0 + 1.0 * 2.5) / 7.0
    inertia = 6.0 * (5 / 12 + (x - 1.0) ** 2) + (1 / 6 + (x - 2.5) ** 2)
    for name, found, exact in (
        ("mass", part["mass"][0], mass),
        ("x of the centre", part["x"][0], x),
        ("y of the centre", part["y"][0], 0.5),
        ("vx", part["vx"][0], 0.5 - 2.0 * (0.5 - 2.0)),
        ("vy", part["vy"][0], -1.0 + 2.0 * (x - 1.0)),
        ("wz", part["wz"][0], 2.0),
        ("wz after a moment", part["wz"][-1], 2.0 + 4.0 / inertia),
    ):
        at_most(abs(found - exact), 1.0e-12, "joined parts: " + name)
    s = Scene()
    s.block(1, (0.0, 0.0), (1.0, 1.0), (1, 1), con=(4, 0))
    s.block(2, (2.0, 0.0), (1.0, 1.0), (1, 1), con=(1, 7))
    text = s.deck(1.0, 0.01, "THETA,")
    given = "*PART_INERTIA\na part\n1,1,1\n0.2,0.3,,5.0\n,,,,,2.0\n1.0,2.0,,,,3.0"
    text = text.replace("*PART\na part\n1,1,1", given, 1)
    fall = "*INITIAL_VELOCITY_RIGID_BODY\n2,1.0,1.0,,,,1.0\n"
    folder, code, errors = run_text("held", text.replace("*SECTION", fall + "*SECTION", 1))
    check(code == 0, "held parts: exit code %d: %s" % (code, errors))
    one, two = table(folder, "rbdout", part=1), table(folder, "rbdout", part=2)
    for name, found, exact in (
        ("mass", one["mass"][0], 5.0),
        ("x", one["x"][-1], 0.2),
        ("y", one["y"][-1], 0.3),
        ("rotation", one["rz"][-1], 3.0),
        ("x of the second", two["ux"][-1], 0.0),
        ("y of the second", two["uy"][-1], 1.0),
        ("rotation of the second", two["rz"][-1], 0.0),
        ("energy", table(folder, "glstat")["total"][0], 0.5 * 2.0 * 9.0 + 0.5),
    ):
        at_most(abs(found - exact), 1.0e-12, "held parts: " + name)


def restart():
    """A run that goes on from half its steps has the tables of the whole one, byte by byte."""
    for scheme, dynamics in SCHEMES + (("", ""), ("THETA,", "1,,,0.5")):
        s = moved()
        s.cards += ["*BIPACT_RESTART", "50,"]
        deck = os.path.join(TMP, "whole.k")
        with open(deck, "w") as out:
            out.write(s.deck(0.5, 0.002 if "CDL" in scheme else 0.005, scheme, dynamics))
        whole, part = os.path.join(TMP, "whole"), os.path.join(TMP, "part")
        for folder in (whole, part):
            shutil.rmtree(folder, ignore_errors=True)
        bipact(deck, whole)
        shutil.copytree(whole, part)
        first = sorted(f for f in os.listdir(whole) if f.startswith("restart"))[0]
        code, errors, _ = bipact(deck, part, "--restart", os.path.join(part, first))
        check(code == 0, "restart %s: exit code %d: %s" % (scheme, code, errors))
        for name in sorted(os.listdir(whole)):
            if name.endswith(".tab"):
                with open(os.path.join(whole, name), "rb") as a:
                    with open(os.path.join(part, name), "rb") as b:
                        check(a.read() == b.read(), "restart %s: %s" % (scheme, name))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
