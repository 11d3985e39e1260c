"""Rigid planes in space: a tube that spins on one, exactly; a block that slides down another. Every
bound has its reason beside it."""

import os
import sys
from math import cos, pi, sin

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from scenes import at_most, check, finish, run_text, table

import analytic

# Of the speed of waves: small, so that the tube does not end up in the wall and turn over.
SPEED = 1.0e-3
SPIN = 1.0e-3
TURNS = {
    "along z": np.eye(3),
    "turned": None,
    "turned again": None,
}


def rotation(axis, angle):
    """Rodrigues' matrix."""
    k = np.array(axis) / np.linalg.norm(axis)
    m = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + sin(angle) * m + (1 - cos(angle)) * m @ m


TURNS["turned"] = rotation((1, 2, 3), 1.1)
TURNS["turned again"] = rotation((-2, 0.3, 1), 2.4)


def head(end, step, scheme, mass, *more):
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % end]
    lines += ["*CONTROL_IMPLICIT_GENERAL", "1,%r" % step, "*CONTROL_IMPLICIT_DYNAMICS", "1,"]
    return lines + ["*BIPACT_TIME", scheme, "*BIPACT_MASS", mass] + list(more)


def tables(names, step, nodes):
    lines = []
    for name in names:
        lines += ["*DATABASE_" + name, "%r," % step]
    return lines + ["*DATABASE_HISTORY_NODE"] + ["%d," % n for n in nodes]


def tube(turn, mu, corners=16, inner=0.9, outer=1.1, length=4.0, n=40):
    """(deck, step, axis, places of the nodes): E = density = 1, PR 0, at SPEED and SPIN."""
    step = length / n
    axis = turn @ np.array([0.0, 0.0, 1.0])

    def node(a, ring, k):
        return 1 + a % corners + corners * (ring + 2 * k)

    place = {}
    for k in range(n + 1):
        for ring, radius in enumerate((inner, outer)):
            for a in range(corners):
                angle = 2 * pi * a / corners
                place[node(a, ring, k)] = turn @ np.array(
                    [radius * cos(angle), radius * sin(angle), length * k / n]
                )
    out = head(step * (2 * n + 20), step, "THETA,0.5", "DISPERSION,")
    out += ["*NODE"] + ["%d,%r,%r,%r" % (i, *map(float, x)) for i, x in sorted(place.items())]
    out += ["*ELEMENT_SOLID"]
    for k in range(n):
        for a in range(corners):
            ring = [(a, 0), (a, 1), (a + 1, 1), (a + 1, 0)]
            eight = [node(p, q, m) for m in (k, k + 1) for p, q in ring]
            out += ["%d,1,%s" % (1 + a + corners * k, ",".join(map(str, eight)))]
    out += ["*SECTION_SOLID", "1,1", "*PART", "tube", "1,1,1", "*MAT_ELASTIC", "1,1.0,1.0,0.0"]
    out += ["*INITIAL_VELOCITY_NODE"]
    for i, x in sorted(place.items()):
        out += ["%d,%r,%r,%r" % (i, *map(float, SPIN * np.cross(axis, x) - SPEED * axis))]
    out += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,%r,%r,%r,%r" % (*map(float, axis), mu)]
    foot = [node(a, ring, 0) for a in range(corners) for ring in (0, 1)]
    out += tables(("GLSTAT", "RWFORC", "NODOUT"), step, foot)
    return "\n".join(out + ["*END", ""]), step, axis, place


def space_tube():
    """Force and torque of every step of contact, and the spin after it, for slip: exact but for
    the round-off of 80 steps and of the solve of contact (statuses known, by Newton: 1e-12). For
    stick P waves alone are exact; the S wave, at a Courant number of .71, leaves .015 of the spin
    (by an independent program)."""
    for name, turn in TURNS.items():
        text, step, axis, place = tube(turn, 0.3)
        folder, code, errors = run_text("tube " + name, text)
        check(code == 0, "tube, %s: exit code %d: %s" % (name, code, errors))
        exact = analytic.SpinningTube(16, 0.9, 1.1, 4.0, 1.0, 1.0, SPEED, 0.3)
        force, energy = table(folder, "rwforc"), table(folder, "glstat")
        in_contact = (force["time"] > 1.5 * step) & (force["time"] < exact.contact_time - step / 2)
        check(in_contact.sum() > 70, "tube, %s: it touches" % name)
        off = np.abs(force["fn"][in_contact] / exact.force - 1.0).max()
        at_most(off, 1.0e-10, "tube, %s: force" % name)
        spin = np.stack([energy["ang" + c] for c in "xyz"], axis=1) @ axis
        torque = np.diff(spin) / step
        off = np.abs(torque[in_contact[1:]] / -exact.torque - 1.0).max()
        at_most(off, 1.0e-10, "tube, %s: torque" % name)
        after = exact.spin_after(SPIN, spin[0] / SPIN) / SPIN
        at_most(abs(spin[-1] / spin[0] - after), 1.0e-10, "tube, %s: spin after" % name)
        at_most(np.abs(energy["residual"]).max(), 1.0e-11, "tube, %s: ledger" % name)
    for n, bound in ((40, 0.015), (80, 0.004)):
        sticking_tube(n, bound)


def sticking_tube(n, bound):
    """The spin after stick, within what an independent program leaves of the S wave."""
    name = "tube of %d that sticks: " % n
    text, step, axis, place = tube(np.eye(3), 0.8, n=n)
    folder, code, errors = run_text("stick %d" % n, text)
    check(code == 0, name + "exit code %d: %s" % (code, errors))
    energy, nodes = table(folder, "glstat"), table(folder, "nodout")
    # -sqrt(2) sqrt(J/J_M) of the polygon, J = (N/12) sin(2 pi/N) (2 + cos(2 pi/N)) (Ro^4 - Ri^4).
    second = 16 / 12 * sin(pi / 8) * (2 + cos(pi / 8)) * (1.1**4 - 0.9**4)
    after = 1.0 - np.sqrt(2.0) * np.sqrt(second * 4.0 / (energy["angz"][0] / SPIN))
    at_most(abs(energy["angz"][-1] / energy["angz"][0] - after), bound, name + "spin")
    mid = nodes.rows(np.abs(nodes["time"] - 4.0) < 0.5 * step)
    slip = np.hypot(mid["vmx"], mid["vmy"]).mean()
    at_most(slip / SPIN, 0.01, name + "speed of slip")


def ring(step, corners=24, across=3, inner=0.5, outer=1.0, height=0.1):
    """(deck, nodes (x, y) of the foot, their share of the mass, moment of inertia about z): a ring
    that stands on a plane by its weight (g = 1) and spins at 1; density 1, E 1e3, PR 0, mu .3."""

    def node(a, r, k):
        return 1 + a % corners + corners * (r + (across + 1) * k)

    angle = 2.0 * pi * np.arange(corners) / corners
    radius = inner + (outer - inner) * np.arange(across + 1) / across
    foot = np.array([[r * cos(t), r * sin(t)] for r in radius for t in angle])
    out = head(3.4, step, "THETA,1.0,1.0", "CONSISTENT,") + ["*NODE"]
    for k in (0, 1):
        out += [
            "%d,%r,%r,%r" % (1 + i + len(foot) * k, *map(float, x), height * k)
            for i, x in enumerate(foot)
        ]
    out += ["*ELEMENT_SOLID"]
    share, inertia = np.zeros(len(foot)), 0.0
    for r in range(across):
        for a in range(corners):
            four = [(a, r), (a, r + 1), (a + 1, r + 1), (a + 1, r)]
            eight = [node(p, q, k) for k in (0, 1) for p, q in four]
            out += ["%d,1,%s" % (1 + a + corners * r, ",".join(map(str, eight)))]
            rows = [node(p, q, 0) - 1 for p, q in four]
            part, second = quadrature(foot[rows])
            share[rows] += height * part
            inertia += height * second
    out += ["*SECTION_SOLID", "1,1", "*PART", "ring", "1,1,1", "*MAT_ELASTIC", "1,1.0,1e3,0.0"]
    out += ["*INITIAL_VELOCITY_NODE"]
    for k in (0, 1):
        out += [
            "%d,%r,%r,0.0" % (1 + i + len(foot) * k, -float(y), float(x))
            for i, (x, y) in enumerate(foot)
        ]
    out += ["*DEFINE_CURVE", "1,", "0.0,1.0", "10.0,1.0", "*LOAD_BODY_Z", "1,1.0"]
    out += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,0.0,1.0,0.3"]
    out += tables(("GLSTAT", "RWFORC"), step, [1])
    return "\n".join(out + ["*END", ""]), foot, share, inertia


def quadrature(x):
    """Of a quadrilateral (4, 2): integrals of its four shape functions, and of the square of the
    distance from the origin (cubic at most in each direction: exact by 2 x 2 points)."""
    share, second = np.zeros(4), 0.0
    for xi in (-1.0 / np.sqrt(3.0), 1.0 / np.sqrt(3.0)):
        for eta in (-1.0 / np.sqrt(3.0), 1.0 / np.sqrt(3.0)):
            signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
            n = (1 + signs[:, 0] * xi) * (1 + signs[:, 1] * eta) / 4
            slopes = np.stack(
                [signs[:, 0] * (1 + signs[:, 1] * eta), signs[:, 1] * (1 + signs[:, 0] * xi)]
            )
            weight = np.linalg.det(slopes @ x / 4)
            share += weight * n
            second += weight * ((n @ x) ** 2).sum()
    return share, second


def space_ring():
    """A ring that spins on a plane under its weight. While all of it slips, node a of the foot
    carries the weight m_a of the column above it, so the torque is mu g sum m_a |X_a|, constant
    (design: 1.000000 of it measured by an independent program at theta = 1, which damps the
    setting down under the weight: 1e-5). Then it rests: the period of spin is over after
    J/torque."""
    step = 0.02
    text, foot, share, inertia = ring(step)
    folder, code, errors = run_text("ring", text)
    check(code == 0, "ring: exit code %d: %s" % (code, errors))
    energy = table(folder, "glstat")
    torque = 0.3 * (share * np.hypot(*foot.T)).sum()
    time, spin = energy["time"], energy["angz"]
    at_most(abs(spin[0] / inertia - 1.0), 1.0e-13, "ring: moment of inertia")
    # The first steps set it down; two before the end some nodes stick.
    slips = (time > 0.5) & (time < inertia / torque - 3.0 * step)
    slope = -np.diff(spin)[slips[1:]] / step
    at_most(np.abs(slope / torque - 1.0).max(), 1.0e-5, "ring: torque of each step")
    off = np.abs(spin - inertia + torque * time)[slips].max() / inertia
    at_most(off, 1.0e-5, "ring: spin")
    rests = time > inertia / torque + 15.0 * step  # its torsion, theta = 1 leaves .14 of it a step
    at_most(np.abs(spin[rests]).max() / inertia, 1.0e-9, "ring: spin at rest")
    at_most(np.abs(energy["residual"]).max(), 1.0e-11, "ring: ledger")


def block(step, mu, slope=0.5, gravity=10.0):
    """A block of 2 x 2 x 1 hexahedra, .2 x .2 x .02, thrown across a slope."""
    n, size, height = 2, 0.2, 0.02

    def node(i, j, k):
        return 1 + i + 3 * (j + 3 * k)

    out = head(0.2, step, "THETA,0.5", "CONSISTENT,") + ["*NODE"]
    for k in range(2):
        for j in range(n + 1):
            for i in range(n + 1):
                out += ["%d,%r,%r,%r" % (node(i, j, k), size * i / n, size * j / n, height * k)]
    out += ["*ELEMENT_SOLID"]
    for j in range(n):
        for i in range(n):
            ring = ((0, 0), (1, 0), (1, 1), (0, 1))
            eight = [node(i + a, j + b, k) for k in (0, 1) for a, b in ring]
            out += ["%d,1,%s" % (1 + i + n * j, ",".join(map(str, eight)))]
    out += ["*SECTION_SOLID", "1,-1", "*PART", "block", "1,1,1", "*MAT_ELASTIC", "1,1.0,1e4,0.0"]
    out += ["*INITIAL_VELOCITY", "0,", "0.0,1.0,0.0"]
    out += ["*DEFINE_CURVE", "1,", "0.0,1.0", "10.0,1.0"]
    out += ["*LOAD_BODY_X", "1,%r" % (-gravity * sin(slope))]
    out += ["*LOAD_BODY_Z", "1,%r" % (gravity * cos(slope))]
    out += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,0.0,1.0,%r" % mu]
    out += tables(("GLSTAT", "RWFORC", "NODOUT"), step, range(1, 19))
    return "\n".join(out + ["*END", ""])


def point(step, mu, time, slope=0.5, gravity=10.0):
    """Place of a point thrown across the slope, by the midpoint rule with friction against the
    middle velocity."""
    place, velocity = np.zeros(2), np.array([0.0, 1.0])
    drive = np.array([gravity * sin(slope) * step, 0.0])
    for _ in range(round(time / step)):
        middle = velocity
        for _ in range(100):
            grip = mu * gravity * cos(slope) * step / np.hypot(*middle)
            middle = velocity + 0.5 * (drive - grip * middle)
        place, velocity = place + step * middle, 2.0 * middle - velocity
    return place


def space_incline():
    """A block that slides, its velocity turning downhill. theta = 1/2 is the midpoint rule: the
    middle of the block is where that puts a point, but for the lean of the block. By its friction
    the top stands back by mu g cos h^2/(2 G) (density 1, height h), swinging up to twice that. The
    error is of order 2 (4, less what the lean adds: 3). The friction is mu of the normal force
    where all of the foot slips."""
    for mu in (0.3, 0.8):
        exact = np.array(analytic.slide_down(0.5, 10.0, mu, (0.0, 1.0), 0.2)[:2])
        lean = mu * 10.0 * cos(0.5) * 0.02**2 / 5.0e3
        off = []
        for step in (0.01, 0.005):
            folder, code, errors = run_text("block %g %g" % (mu, step), block(step, mu))
            check(code == 0, "block: exit code %d: %s" % (code, errors))
            nodes = table(folder, "nodout")
            last = nodes.rows(nodes["time"] == nodes["time"].max())
            place = np.array([last["ux"].mean(), last["uy"].mean()])
            middle = point(step, mu, 0.2)
            name = "block, mu %g, step %g: " % (mu, step)
            at_most(np.abs(place - middle).max(), lean, name + "place of the midpoint rule")
            off += [np.abs(place - exact).max()]
            at_most(off[-1], np.abs(middle - exact).max() + lean, name + "place")
            force, energy = table(folder, "rwforc"), table(folder, "glstat")
            slips = force["nslip"] == 9
            check(slips.any(), "block, mu %g: it slips" % mu)
            bound = np.abs(force["ft"][slips] / (mu * force["fn"][slips]) - 1.0).max()
            at_most(bound, 1.0e-9, name + "friction")
            at_most(np.abs(energy["residual"]).max(), 1.0e-11, "block, mu %g: ledger" % mu)
        at_most(3.0, off[0] / off[1], "block, mu %g: half the step divides the error by" % mu)


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
