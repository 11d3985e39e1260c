"""Laws at finite deformation: uniaxial states and uniform strains with their closed forms, statics,
the energy balance of every law, scheme and element, plastic work. Every bound has its reason beside
it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import h5py
import numpy as np
from finite_scenes import (
    Grid,
    HYPERELASTIC,
    LAWS,
    PLASTIC,
    body,
    finite,
    kirchhoff,
    lateral,
    run,
    thrown,
)
from scenes import at_most, check, finish, show, table, within
from solids import FORMS, Box, curve, deck, node_set

LEDGER = 1.0e-10  # of the largest term: where Newton's method stops
STATE = 1.0e-8  # of a state in equilibrium: Newton's method stops at 1e-9 of the motion


def pulled(name, stretch, mesh, plane=13):
    """A mesh of a unit cell pulled along x to a stretch in ten steps, free across; its folder and
    the rows of the pulled end."""
    dim = len(mesh.x[0])
    lines = finite(name=name) + body(mesh, name, plane=plane)
    lines += node_set(1, mesh.on(0, 0.0)) + node_set(2, mesh.on(0, 1.0))
    lines += node_set(3, mesh.on(1, 0.0)) + ["*BOUNDARY_SPC_SET", "1,,1,0,0", "3,,0,1,0"]
    if dim == 3:
        lines += node_set(4, mesh.on(2, 0.0)) + ["*BOUNDARY_SPC_SET", "4,,0,0,1"]
    lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "2,1,2,1"]
    lines += curve(1, (0.0, 0.0), (1.0, stretch - 1.0))
    corner = np.argmax(mesh.x.sum(axis=1)) + 1
    element = "SOLID" if dim == 3 else "SHELL"
    lines += ["*DATABASE_HISTORY_NODE", "%d," % corner, "*DATABASE_HISTORY_" + element, "1,"]
    lines += ["*BIPACT_FIELD", "1.0,", "PLASTIC,"]
    tables = ("GLSTAT", "SPCFORC", "NODOUT", "ELOUT")
    folder = run("pulled", deck(lines, 0.1, 1.0, static=True, tables=tables))
    return folder, [r + 1 for r in mesh.on(0, 1.0)]


def along_and_across(name, stretch, plane):
    """Closed form of a pulled bar: Kirchhoff stress along it and the three stretches. J2: tau =
    (sy + H ln l)/(1 + H/E), ln J = (1 - 2 PR) tau/E; a curve of hardening by its segment."""
    if name in HYPERELASTIC:
        stretches = lateral(name, stretch, plane != 13)
        return kirchhoff(name, stretches)[0], stretches
    log = abs(np.log(stretch))
    if name == "plastic":
        slope = 100.0 * 5.0 / (100.0 - 5.0)
        tau = (1.0 + slope * log) / (1.0 + slope / 100.0)
    else:
        slope = 0.5 / 0.45
        tau = (1.5 + slope * (log - 0.05)) / (1.0 + slope / 100.0)
    tau *= np.sign(stretch - 1.0)
    volume = (1.0 - 2.0 * 0.3) * tau / 100.0
    across = np.exp((volume - np.log(stretch)) / 2.0)
    return tau, (stretch, across, across)


def finite_uniaxial():
    """A distorted patch pulled and pushed: force tau/l, lateral stretches and Cauchy stress tau/J of
    all laws, in space, plane strain and plane stress. The deformation is uniform, so that the mesh
    plays no part; SPCFORC is the mean of a step."""
    cases = [(name, plane, "QUAD4") for name in HYPERELASTIC for plane in (12, 13)]
    cases += [(name, 0, "HEX8") for name in LAWS] + [(name, 12, "QUAD4") for name in PLASTIC]
    cases += [(name, 13, "TRI3") for name in ("elastic", "foam")]
    cases += [
        (name, 0, f)
        for name in ("foam", "plastic")
        for f in FORMS
        if f not in ("HEX8", "HEX8MODE")
    ]
    for name, plane, form in cases:
        for stretch in (1.3, 0.75):
            if plane:
                mesh = Grid(2, 2, form=form, shift=0.15)
            else:
                mesh = Box((2, 2, 2), form=form, shift=0.15)
            folder, end = pulled(name, stretch, mesh, plane)
            label = "%s %s %d, stretch %g: " % (name, form, plane, stretch)
            before = 1.0 + 0.9 * (stretch - 1.0)
            want = 0.5 * sum(along_and_across(name, l, plane)[0] / l for l in (before, stretch))
            tau, (_, across, third) = along_and_across(name, stretch, plane)
            rows = table(folder, "spcforc")
            here = (rows["time"] == 1.0) & np.isin(rows["node"], end)
            at_most(abs(rows["fx"][here].sum() / want - 1.0), STATE, label + "force")
            node = table(folder, "nodout")
            at_most(abs(node["uy"][-1] + 1.0 - across), STATE, label + "stretch across")
            if not plane:
                at_most(abs(node["uz"][-1] + 1.0 - third), STATE, label + "stretch across")
            stress = table(folder, "elout")
            cauchy = tau / (stretch * across * third)
            at_most(abs(stress["sxx"][-1] / cauchy - 1.0), STATE, label + "Cauchy stress")
            rest = [np.abs(stress[c][-1]) for c in ("syy", "sxy", "syz", "szx")]
            rest += [abs(stress["szz"][-1])] if plane != 13 else []
            at_most(max(rest) / abs(cauchy), STATE * 10, label + "other stresses")
            rows = table(folder, "glstat")
            at_most(np.abs(rows["residual"]).max(), LEDGER, label + "balance")
            if name in PLASTIC:
                check(rows["plastic"][-1] > 0.0, label + "plastic work")
            with h5py.File(os.path.join(folder, "fields.000.vtkhdf")) as file:
                got = file["VTKHDF/CellData/PLASTIC"][-len(mesh.elements) :]
            want = abs(np.log(stretch) - tau / 100.0) if name in PLASTIC else 0.0
            at_most(np.abs(got - want).max(), STATE, label + "plastic strain")


def finite_statics():
    """A cantilever bent far by forces, gravity and pressure: the support forces balance them, in
    the mean of the step as SPCFORC has it, to where Newton's method stops. A foam block pushed into
    the floor by dead loads: the floor carries them."""
    for name, mesh, plane in (
        ("elastic", Grid(8, 2, (4.0, 1.0), shift=0.2), 13),
        ("mooney", Grid(8, 2, (4.0, 1.0), shift=0.2), 13),
        ("ogden", Grid(8, 2, (4.0, 1.0), form="TRI3"), 12),
        ("foam", Box((6, 2, 2), (4.0, 1.0, 1.0), shift=0.2), 0),
        ("plastic", Box((6, 1, 1), (4.0, 1.0, 1.0)), 0),
        ("elastic", Box((4, 1, 1), (4.0, 1.0, 1.0), "TET10"), 0),
    ):
        dim = len(mesh.x[0])
        load = 0.06 if name == "plastic" else 0.8
        end = mesh.on(0, 4.0)
        lines = finite(name=name) + body(mesh, name, plane=plane)
        lines += node_set(1, mesh.on(0, 0.0)) + node_set(2, end)
        lines += ["*BOUNDARY_SPC_SET", "1,,1,1,1", "*LOAD_NODE_SET"]
        lines += ["2,1,1,%r" % (-0.5 * load / len(end)), "2,2,1,%r" % (-load / len(end))]
        lines += ["*LOAD_BODY_Y", "1,10.0"] + curve(1, (0.0, 0.0), (1.0, 1.0))
        tables = ("GLSTAT", "SPCFORC", "MATSUM", "NODOUT")
        lines += ["*DATABASE_HISTORY_NODE", "%d," % (end[0] + 1)]
        folder = run("bent", deck(lines, 0.05, 1.0, static=True, tables=tables))
        label = "%s %s: " % (name, mesh.form)
        rows = table(folder, "spcforc")
        last = rows["time"] == 1.0
        weight = 10.0 * table(folder, "matsum")["mass"][-1]
        sums = [rows[c][last].sum() for c in ("fx", "fy", "fz")]
        want = [0.975 * 0.5 * load, 0.975 * (load + weight), 0.0]
        at_most(np.abs(np.array(sums) - want).max() / load, STATE, label + "support forces")
        # The tip went far: else all of this is the linear case.
        far = np.hypot(*(table(folder, "nodout")[c][-1] for c in ("ux", "uy")))
        at_most(0.3, far, label + "motion of the tip, at least")
        at_most(np.abs(table(folder, "glstat")["residual"]).max(), LEDGER, label + "balance")
    for mu in (0.0, 0.5):
        mesh = Grid(4, 4)
        lines = finite() + body(mesh, "foam") + node_set(1, mesh.on(1, 1.0))
        lines += node_set(2, mesh.on(0, 0.0)) + ["*BOUNDARY_SPC_SET", "2,,1,0"]
        lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,%r" % mu]
        lines += ["*LOAD_NODE_SET", "1,2,1,-2.0"] + curve(1, (0.0, 0.0), (1.0, 1.0))
        tables = ("GLSTAT", "RWFORC", "MATSUM")
        folder = run("pushed", deck(lines, 0.1, 1.0, static=True, tables=tables))
        force = table(folder, "rwforc")["fy"][-1]
        at_most(abs(force / 10.0 - 1.0), STATE, "mu %g: force of the floor" % mu)
        at_most(np.abs(table(folder, "glstat")["residual"]).max(), LEDGER, "pushed: balance")


def finite_fields():
    """A uniform strain with a turn, U = (F - 1) X on the boundary: STRESS of the fields and ELOUT are
    F S F'/J of the closed forms, in every form of element, plane strain and plane stress."""
    angle = 0.6
    spin = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )
    stretch = np.array([[1.25, 0.1, 0.0], [0.1, 0.85, 0.0], [0.0, 0.0, 1.0]])
    in_space = stretch + np.array([[0, 0, -0.05], [0, 0, 0.08], [-0.05, 0.08, 0.1]])
    cases = [(name, plane, "QUAD4") for name in HYPERELASTIC for plane in (12, 13)]
    cases += [("foam", 13, "TRI3")] + [(name, 0, "HEX8") for name in HYPERELASTIC]
    cases += [("neo-hooke", 0, form) for form in FORMS if form not in ("HEX8", "HEX8MODE")]
    for name, plane, form in cases:
        mesh = Grid(2, 2, form=form, shift=0.2) if plane else Box((2, 1, 1), form=form)
        dim = 2 if plane else 3
        f = spin @ (stretch if plane else in_space)
        lines = finite(name=name) + body(mesh, name, plane=plane)
        lines += curve(1, (0.0, 0.0), (1.0, 1.0)) + curve(2, (0.0, 0.0), (1.0, 0.0))
        lines += ["*BOUNDARY_PRESCRIBED_MOTION_NODE"]
        for r, x in enumerate(mesh.x):
            if dim == 2 and all(0.0 < c < 1.0 for c in x):
                continue
            for d, u in enumerate((f - np.eye(3))[:dim, :dim] @ x):
                number, factor = (1, float(u)) if u else (2, 1.0)
                lines.append("%d,%d,2,%d,%r" % (r + 1, d + 1, number, factor))
        lines += ["*DATABASE_HISTORY_" + ("SHELL" if plane else "SOLID"), "1,2"]
        lines += ["*BIPACT_FIELD", "1.0,", "U,STRESS,STRETCH"]
        text = deck(lines, 0.1, 1.0, static=True, tables=("GLSTAT", "ELOUT"))
        folder = run("uniform", text)
        if plane == 12:  # the third stretch has no stress
            low, high = 0.3, 3.0
            c2 = np.sqrt(np.linalg.eigvalsh(stretch[:2, :2] @ stretch[:2, :2]))
            for _ in range(200):
                middle = 0.5 * (low + high)
                tau = kirchhoff(name, (*c2, middle))[2]
                low, high = (middle, high) if tau < 0 else (low, middle)
            f = spin @ np.diag([1.0, 1.0, low]) @ stretch
        square, axes = np.linalg.eigh(f @ f.T)
        tau = kirchhoff(name, np.sqrt(square))
        want = axes @ np.diag(tau) @ axes.T / np.linalg.det(f)
        six = want[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
        label = "%s %s %d: " % (name, form, plane)
        rows = table(folder, "elout")
        got = np.array([rows[c][-1] for c in ("sxx", "syy", "szz", "sxy", "syz", "szx")])
        at_most(np.abs(got - six).max() / np.abs(six).max(), STATE, label + "ELOUT")
        with h5py.File(os.path.join(folder, "fields.000.vtkhdf")) as file:
            got = file["VTKHDF/CellData/STRESS"][-len(mesh.elements) :]
            stretches = file["VTKHDF/CellData/STRETCH"][-len(mesh.elements) :]
        at_most(np.abs(got - six).max() / np.abs(six).max(), STATE, label + "STRESS")
        want = np.sqrt(square)[::-1]
        at_most(np.abs(stretches - want).max(), STATE, label + "STRETCH")


SCHEMES = (
    ("THETA,0.5", "EMC"),
    ("THETA,0.5", "PAPER"),
    ("THETA,0.5", "MIDPOINT"),
    ("THETA,0.6", "EMC"),
    ("THETA,0.6,0.7", "PAPER"),
    ("NEWMARK,", ""),
    ("PAOLI,,,,,,0.0", ""),
)


def bodies(space, shift, names):
    """Bodies of every form of element, and in the plane of plane strain and stress, with laws taken
    in turn from the shift-th on: supports, loads, gravity, motions, damping by mass and a rough wall.
    """
    if space:
        kinds = [(f, 0) for f in FORMS if f != "HEX8MODE"]
    else:
        kinds = [(f, p) for f in ("QUAD4", "TRI3") for p in (12, 13)]
    lines, ends, first = [], [], 1
    for number, (form, plane) in enumerate(kinds, start=1):
        origin = (0.0, 3.0 * number, 0.0)
        if space:
            mesh = Box((2, 1, 1), (2.0, 1.0, 1.0), form, 0.0, number, origin)
        else:
            mesh = Grid(3, 2, (2.0, 1.0), origin[:2], form, 0.2, number)
        lines += body(mesh, names[(number + shift) % len(names)], number, first, plane)
        lines += node_set(number, mesh.on(0, 0.0), first)
        lines += node_set(20 + number, mesh.on(0, 2.0), first)
        first += 1000
    count = len(kinds)
    lines += ["*BOUNDARY_SPC_SET"] + ["%d,,1,1,1" % k for k in range(2, count)]
    lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "1,2,0,2,1.0,,0.0032"]
    lines += ["*LOAD_NODE_SET"] + ["%d,2,1,0.3" % (20 + k) for k in range(1, count + 1)]
    lines += ["*LOAD_BODY_Y", "1,500.0", "*INITIAL_VELOCITY", "0,", "15.0,-20.0,0.0"]
    lines += curve(1, (0.0, 1.0), (0.003, 0.5), (1.0, 0.5)) + curve(
        2, (0.0, -20.0), (1.0, -20.0)
    )
    lines += ["*RIGIDWALL_PLANAR", "0,", "2.05,0.0,0.0,-1.0,0.0,0.0,0.3"]
    return lines + ["*DAMPING_GLOBAL", "0,20.0"]


def ledger_of(label, lines, scheme, force):
    """Runs a scene with a scheme and checks its balance; rows of GLSTAT."""
    explicit = scheme.startswith("PAOLI")
    h, steps = (2.0e-5, 200) if explicit else (2.5e-4, 18)
    text = deck(
        finite(force) + lines,
        h,
        h * steps,
        scheme=scheme,
        mass="LUMPED,0" if explicit else "CONSISTENT,0",
        tables=("GLSTAT",),
        every=10 * h,
    )
    rows = table(run("ledger", text), "glstat")
    at_most(
        np.abs(rows["residual"]).max(), LEDGER, "%s %s %s: balance" % (label, scheme, force)
    )
    return rows


def finite_ledgers():
    """The energy balance of every law, scheme and form of element with supports, loads, gravity,
    motions, damping by mass and a rough wall."""
    names = tuple(name for name in LAWS if name != "hencky")  # of all *MAT_ELASTIC or none
    for scheme, force in SCHEMES:
        for shift in range(len(names)):
            for space in (False, True):
                label = "%s %d" % ("space" if space else "plane", shift)
                rows = ledger_of(label, bodies(space, shift, names), scheme, force)
                check(rows["damping"][-1] > 0.0, label + ": damping")
                check(rows["friction"][-1] != 0.0, label + ": friction")
                if space:
                    check(rows["plastic"][-1] > 0.0, label + ": plastic work")


def finite_contact_ledgers():
    """The same for contact with friction between bodies of two laws, in the plane and in space."""
    pairs = (
        ("foam", "rubber"),
        ("mooney", "plastic"),
        ("elastic", "ogden"),
        ("neo-hooke", "piecewise"),
    )
    for k, (scheme, force) in enumerate(SCHEMES):
        for j, names in enumerate(pairs):
            for space in (False, True):
                if space and (j + k) % 2:
                    continue
                lines = []
                for number, name in enumerate(names, start=1):
                    low = (0.0, 0.0, 0.0) if number == 1 else (0.31, 1.003, 0.17)
                    size = 1.0
                    if space:
                        mesh = Box((2, 2, 2), (size,) * 3, origin=low)
                    else:
                        mesh = Grid(3, 3, (size, size), low[:2])
                    v = [8.0, 5.0] if number == 1 else [-4.0, -10.0]
                    lines += body(mesh, name, number, 1000 * number)
                    lines += thrown([v] * len(mesh.x), range(len(mesh.x)), 1000 * number)
                if space:
                    lines += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,2,2", "0.3,"]
                else:
                    lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,,,0.3"]
                rows = ledger_of("%s on %s" % names, lines, scheme, force)
                check(rows["friction"][-1] != 0.0, "friction")


def finite_plastic():
    """A plastic block thrown at a wall: what kinetic energy loses is strain energy, plastic work, the
    loss of contact and what the scheme takes, each by its own formula. The last is of second order
    of a step, of first in a run: over two halvings it falls by 1.6^2 at least; 4 when waves
    of yielding are resolved. Laws without hardening and with either kind and both."""
    for beta, etan in ((1.0, 5.0), (0.0, 5.0), (0.5, 5.0), (1.0, 0.0)):
        taken = []
        for h in (2.0e-4, 1.0e-4, 5.0e-5):
            mesh = Grid(6, 3, (2.0, 1.0), (0.01, 0.0))
            lines = finite() + body(mesh, "plastic")
            lines = [x.replace("1.0,5.0,0.5", "1.0,%r,%r" % (etan, beta)) for x in lines]
            lines += thrown([(-12.0, 0.0)] * len(mesh.x), range(len(mesh.x)))
            lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,1.0,0.0,0.0,0.2"]
            text = deck(lines, h, 0.048, mass="LUMPED,0", tables=("GLSTAT",), every=4.0e-4)
            rows = table(run("plastic", text), "glstat")
            label = "beta %g, etan %g, step %g: " % (beta, etan, h)
            at_most(np.abs(rows["residual"]).max(), LEDGER, label + "balance")
            gone = rows["kinetic"][0] - rows["kinetic"]
            found = sum(
                rows[c] for c in ("internal", "plastic", "algorithmic", "friction", "contact")
            )
            at_most(np.abs(gone - found).max() / rows["kinetic"][0], LEDGER, label + "sum")
            check(np.diff(rows["plastic"]).min() >= 0.0, label + "plastic work grows")
            within(rows["plastic"][-1] / rows["kinetic"][0], 0.5, 1.0, label + "plastic work")
            taken.append(abs(rows["algorithmic"][-1]) / rows["kinetic"][0])
        within(taken[0] / taken[-1], 1.6**2, 100.0, label + "algorithmic falls by")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
