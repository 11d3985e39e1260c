"""Decks around an axis, small displacements: patch test, tube, masses, flight, wave, ledgers,
restart, engines, static contact. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import h5py
import numpy as np
from rings import (Mesh, ball, curve, deck, elastic, flight, mesh_cards, node_set, part_cards,
                   pressed)
from scenes import at_most, check, finish, run_text, show, table, within, words_of

# Of the largest term: round-off of a few hundred steps (conventions of the ledger tests).
LEDGER = 1.0e-11


def run(name, text, *options):
    """Runs a deck that must run; returns its folder."""
    folder, code, errors = run_text(name, text, *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder


def prescribed(mesh, rows, field):
    """Cards of the displacement field(r, z) of nodes, grown by curve 1; by curve 2, which stays 0,
    where it is 0: a factor of 0 would be 1. Nothing for nodes on the axis, which are held."""
    lines = ["*BOUNDARY_PRESCRIBED_MOTION_NODE"]
    for r in rows:
        for d, u in enumerate(field(*mesh.x[r])):
            if d == 0 and mesh.x[r][0] == 0.0:
                continue
            number, factor = (1, float(u)) if u else (2, 1.0)
            lines.append("%d,%d,2,%d,%r" % (1 + r, d + 1, number, factor))
    return lines + curve(1, (0.0, 0.0), (1.0, 1.0)) + curve(2, (0.0, 0.0), (1.0, 0.0))


def axis_patch():
    """A displacement (a r, b z) of the boundary of a patch of distorted elements gives it inside,
    and one stress with that around the axis: to round-off times the condition of the patch,
    below 100."""
    a, b = 1.0e-3, -2.0e-3
    lam, mu = 0.3 * 1000.0 / (1.3 * 0.4), 1000.0 / 2.6
    trace = 2.0 * a + b
    want = np.array([lam * trace + 2.0 * mu * e for e in (a, b, a)] + [0.0, 0.0, 0.0])
    for triangles in (False, True):
        for radii in ((0.0, 1.0), (3.0, 4.0)):
            what = "%s from radius %g" % ("triangles" if triangles else "quadrilaterals", radii[0])
            mesh = Mesh((4, 4), radii, triangles=triangles, shift=0.25, seed=3)
            inside = [r for r in range(len(mesh.x)) if r not in mesh.boundary()]
            lines = mesh_cards(mesh) + part_cards() + elastic()
            lines += prescribed(mesh, mesh.boundary(), lambda r, z: (a * r, b * z))
            lines += ["*DATABASE_HISTORY_NODE"] + ["%d," % (r + 1) for r in inside]
            lines += ["*DATABASE_HISTORY_SHELL"]
            lines += ["%d," % (e + 1) for e in range(len(mesh.elements))]
            lines += ["*BIPACT_FIELD", "1.0,", "STRESS,PRINCIPAL"]
            folder = run(
                "patch", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT", "ELOUT"))
            )
            nodes = table(folder, "nodout")
            last = nodes["time"] == 1.0
            u = np.stack([nodes[c][last] for c in ("ux", "uy")], axis=1)
            exact = mesh.x[np.array(nodes["node"][last], dtype=int) - 1] * [a, b]
            at_most(np.abs(u - exact).max() / np.abs(mesh.x * [a, b]).max(), 1.0e-13,
                    what + ": displacement")
            rows = table(folder, "elout")
            last = rows["time"] == 1.0
            got = np.stack([rows[c][last] for c in ("sxx", "syy", "szz", "sxy", "syz", "szx")])
            at_most(np.abs(got - want[:, None]).max() / np.abs(want).max(), 1.0e-12,
                    what + ": stress")
            m = len(mesh.elements)
            with h5py.File(os.path.join(folder, "fields.000.vtkhdf")) as file:
                fields = file["VTKHDF/CellData"]
                got = [fields["STRESS"][m:2 * m] - want,
                       fields["PRINCIPAL"][m:2 * m] - np.sort(want[:3])[::-1]]
            at_most(max(np.abs(g).max() for g in got) / np.abs(want).max(), 1.0e-12,
                    what + ": stress of the fields")
            energy = rows["energy"][last].sum()
            volume = np.pi * (radii[1] ** 2 - radii[0] ** 2)
            exact = 0.5 * volume * (2.0 * want[0] * a + want[1] * b)
            at_most(abs(energy / exact - 1.0), 1.0e-13, what + ": energy of the whole ring")


def axis_tube():
    """Lame: a thick tube under inner pressure, plane strain; radial displacement of the bore with
    order 2, hoop stress of the elements at their centres."""
    inner, outer, p, young, nu = 1.0, 2.0, 10.0, 1000.0, 0.3
    c = p * inner**2 / (outer**2 - inner**2)

    def exact(r):
        return c * (1.0 + nu) / young * ((1.0 - 2.0 * nu) * r + outer**2 / r)

    for triangles in (False, True):
        errors, stresses = [], []
        for n in (4, 8, 16):
            mesh = Mesh((n, 2), (inner, outer), (0.0, 2.0 / n), triangles=triangles)
            lines = mesh_cards(mesh) + part_cards() + elastic(young=young, poisson=nu)
            lines += node_set(1, mesh.bottom() + mesh.top()) + ["*BOUNDARY_SPC_SET", "1,,,1"]
            lines += curve(1, (0.0, 0.0), (1.0, p)) + pressed(mesh.inner())
            lines += ["*DATABASE_HISTORY_NODE", "%d," % (mesh.row(0, 1) + 1)]
            lines += ["*DATABASE_HISTORY_SHELL"]
            lines += ["%d," % (e + 1) for e in range(len(mesh.elements))]
            folder = run(
                "tube", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT", "ELOUT"))
            )
            errors.append(abs(table(folder, "nodout")["ux"][-1] / exact(inner) - 1.0))
            rows = table(folder, "elout")
            last = rows["time"] == 1.0
            middle = np.array([mesh.x[e].mean(axis=0)[0] for e in mesh.elements])
            hoop = c * (1.0 + outer**2 / middle**2)
            stresses.append(np.abs(rows["szz"][last] / hoop - 1.0).max())
        order = np.log2(errors[1] / errors[2])
        what = "triangles" if triangles else "quadrilaterals"
        show("%s: errors of the bore %s" % (what, errors))
        show("%s: errors of the hoop stress %s" % (what, stresses))
        within(order, 1.9, 2.1, what + ": order of the displacement")
        at_most(stresses[2], 0.5 * stresses[0], what + ": hoop stress converges")


SCHEMES = (
    ("THETA,0.5,0.5", ("CONSISTENT,0", "LUMPED,0", "CONSISTENT,1")),
    ("THETA,0.7,0.6", ("CONSISTENT,0",)),
    ("NEWMARK,", ("CONSISTENT,0", "LUMPED,0")),
    ("HHT,", ("CONSISTENT,0",)),
    ("GENALPHA,,,,0.7", ("CONSISTENT,0",)),
    ("MOREAU,0.6,0.55", ("LUMPED,0",)),
    ("PAOLI,", ("CONSISTENT,0",)),
    ("CDLAGRANGE,", ("LUMPED,0",)),
    ("THETAPV,", ("CONSISTENT,0",)),
    ("NSGENALPHA,,,,0.7", ("CONSISTENT,0",)),
    ("CSNEWMARK,", ("CONSISTENT,0",)),
)


def meeting(poisson=0.3, law=None, triangles=True, speed=-5.0):
    """A ball falls with friction on a block of triangles that stands on a wall in a cone."""
    top, low = ball(4, centre=1.01), Mesh((5, 4), (0.0, 1.5), (-1.0, 0.0), triangles=triangles)
    n = len(top.x)
    lines = mesh_cards(top) + mesh_cards(low, 2, n + 1)
    lines += part_cards() + ["*PART", "block", "2,1,1"] + (law or elastic(poisson=poisson))
    lines += node_set(1, range(n)) + flight(vy=speed)
    lines += ["*SET_PART_LIST", "11,", "1,", "*SET_PART_LIST", "12,", "2,"]
    lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,0.3"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,-1.0,0.0,0.0,1.0,0.0,0.2"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "1.501,-1.0,0.0,0.501,-0.8,0.0,0.1"]
    lines += curve(1, (0.0, 9.81), (1.0, 9.81)) + ["*LOAD_BODY_Y", "1,100.0"]
    lines += curve(2, (0.0, 0.0), (0.01, 6.0)) + pressed(low.outer(), n + 1, 2)
    return lines


def axis_ledgers():
    """Every scheme on a ball that falls on a block, with friction, walls, gravity and pressure:
    the energy balance closes to round-off."""
    listed = {s.split(",")[0] for s, _ in SCHEMES}
    missing = set(words_of("SCHEME")) - listed
    check(not missing, "schemes without a scene: %s" % ", ".join(sorted(missing)))
    for scheme, masses in SCHEMES:
        for mass in masses:
            if mass[-1] == "1" and scheme[:5] != "THETA":
                continue
            step = 1.0e-4 if scheme != "CDLAGRANGE," else 5.0e-5    # explicit
            text = deck(meeting(), step, 0.01, scheme=scheme, mass=mass)
            if scheme == "HHT,":
                card = "*CONTROL_IMPLICIT_DYNAMICS\n"
                text = text.replace(card + "1,", card + "1,,,,,,,-0.2")
            rows = table(run("ledger", text), "glstat")
            what = "%s %s" % (scheme, mass)
            at_most(np.abs(rows["residual"]).max(), LEDGER, what)
            check(rows["friction"].any(), what + ": it slides")
            check(not rows["momx"].any() and not rows["angz"].any(), what + ": nothing radial")
    damping = ["*DAMPING_GLOBAL", "0,20.0,1.0,2.0,0.5", "*DAMPING_PART_STIFFNESS", "2,-1e-5"]
    rows = table(run("damped", deck(meeting() + damping, 1.0e-4, 0.01)), "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "damped")
    mesh = Mesh((6, 6), heights=(0.01, 1.01))
    lines = mesh_cards(mesh) + part_cards() + elastic()
    lines += node_set(1, range(len(mesh.x))) + flight(vy=-5.0) + [
        "*RIGIDWALL_GEOMETRIC_CYLINDER", "0,", "0.0,-2.0,0.0,0.0,-2.0,1.0,0.3", "2.0,"]
    folder = run("sphere", deck(lines, 1.0e-4, 0.01, tables=("GLSTAT", "RWFORC")))
    rows, wall = table(folder, "glstat"), table(folder, "rwforc")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "a block on a wall that is a sphere")
    change = rows["momy"] - rows["momy"][0] - wall["iy"]
    at_most(np.abs(change).max() / abs(rows["momy"][0]), 1.0e-11, "its momentum")
    check(rows["friction"][-1] > 0.0, "it slides")
    text = deck(meeting(), 2.0e-5, 0.01, scheme="PAOLI,,,,,,0.0", mass="LUMPED,0")
    rows = table(run("explicit", text), "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "explicit")


def axis_engines():
    """Every linear solver gives the same motion: 1e-9 of the largest displacement, round-off times
    the condition of A and 100 steps (conventions.md 4)."""
    history = ["*DATABASE_HISTORY_NODE", "1,5,21,45,60"]
    found = {}
    for engine in words_of("ENGINE"):
        if engine in ("DIAGONAL", "MUMPS"):
            continue
        cards = meeting() + history + ["*BIPACT_SOLVER", engine + ","]
        text = deck(cards, 1.0e-4, 0.01, tables=("NODOUT",))
        rows = table(run("engine " + engine, text), "nodout")
        found[engine] = np.stack([rows[c] for c in ("ux", "uy")])
    for engine, u in found.items():
        scale = np.abs(found["LDLT"]).max()
        at_most(np.abs(u - found["LDLT"]).max() / scale, 1.0e-9, engine)


def contents(folder):
    """The tables of a run, as text."""
    return {
        f: open(os.path.join(folder, f)).read() for f in os.listdir(folder) if f[-4:] == ".tab"
    }


def axis_restart():
    """A run that goes on from its restart file is the whole run, in every byte of its tables: also
    at finite deformation, with a law that has a history."""
    law = ["*MAT_PLASTIC_KINEMATIC", "1,1.0e-3,1000.0,0.3,20.0,50.0"]
    for finite in (False, True):
        text = deck(meeting(law=law if finite else None, triangles=not finite), 1.0e-4, 0.01,
                    finite=finite)
        plain = contents(run("plain", text))
        cut = text.replace("*END", "*BIPACT_RESTART\n40,,99\n*END")
        folder = run("cut", cut)
        whole = contents(folder)
        check(whole == plain, "restart files change the tables")
        for name in sorted(f for f in os.listdir(folder) if "restart" in f)[:2]:
            run("cut", cut, "--restart", os.path.join(folder, name))
            check(contents(folder) == whole, "from " + name)


def axis_flight():
    """Masses are those of rings (Pappus), whatever the elements; a body that flies along the axis
    keeps its energy and momentum, and nothing strains it: round-off of 100 steps. ELFORM 14 and a
    thickness change nothing but notes."""
    for triangles in (False, True):
        for mass in ("CONSISTENT,0", "LUMPED,0"):
            mesh = Mesh((4, 3), (0.5, 2.0), (1.0, 2.0), triangles=triangles, shift=0.2)
            lines = mesh_cards(mesh) + part_cards() + elastic()
            lines += node_set(1, range(len(mesh.x))) + flight(vy=300.0)
            text = deck(lines, 1.0e-4, 0.01, mass=mass)
            folder = run("flight", text)
            rows, parts = table(folder, "glstat"), table(folder, "matsum")
            what = ("triangles " if triangles else "quadrilaterals ") + mass
            exact = 1.0e-3 * np.pi * (2.0**2 - 0.5**2)
            at_most(abs(parts["mass"][0] / exact - 1.0), 1.0e-14, what + ": mass")
            at_most(np.abs(rows["momy"] / (300.0 * exact) - 1.0).max(), 1.0e-13,
                    what + ": momentum")
            at_most(np.abs(rows["total"] / rows["total"][0] - 1.0).max(), 1.0e-12,
                    what + ": energy")
            at_most(rows["internal"].max() / rows["total"][0], 1.0e-25, what + ": no strain")
            other = run("fourteen", text.replace("1,15\n1.0", "1,14\n3.0"))
            check(contents(other) == contents(folder), "ELFORM 14 and T1 change nothing")
            log = open(os.path.join(other, "bipact.log")).read()
            check("is read as 15" in log and "T1 of an axisymmetric" in log, "their notes")


def axis_wave():
    """A rod with PR 0 hits a wall: its waves are those of a plane strip, for every displacement is
    the same over the radius. Displacements and the force over the area, to round-off of 300
    steps; while the wave travels the force is rho c v A: 2 %, the mean over a step that
    oscillates."""
    radius, speed, found = 0.5, 2.0, {}
    for form in (15, 13):
        mesh = Mesh((2, 40), (0.0, radius), (0.0, 10.0))
        lines = mesh_cards(mesh) + part_cards(form=form) + elastic(poisson=0.0)
        lines += node_set(1, range(len(mesh.x))) + flight(vy=-speed)
        lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0"]
        lines += ["*DATABASE_HISTORY_NODE", "%d,%d" % (mesh.row(1, 20) + 1, mesh.row(2, 40) + 1)]
        folder = run("wave", deck(lines, 2.0e-4, 0.06, tables=("NODOUT", "RWFORC")))
        area = np.pi * radius**2 if form == 15 else radius
        rows = table(folder, "nodout")
        found[form] = rows["uy"], rows["ux"], table(folder, "rwforc")["fy"] / area
    scale = np.abs(found[13][0]).max()
    at_most(np.abs(found[15][0] - found[13][0]).max() / scale, 1.0e-11, "axial displacement")
    at_most(np.abs(found[15][1]).max() / scale, 1.0e-12, "no radial displacement")
    force = np.abs(found[15][2])
    at_most(np.abs(force - np.abs(found[13][2])).max() / force.max(), 1.0e-10, "force")
    exact = np.sqrt(1000.0 * 1.0e-3) * speed    # rho c v, c = sqrt(E/rho), over 2 L/c = 0.02
    at_most(abs(force[20:91].mean() / exact - 1.0), 0.02, "rho c v A")


def sphere_meshes(n, a, width, bend):
    """Bottom at r^2/(2 bend), n elements over 1.5 a, growing by a quarter from there on."""
    grid = list(np.linspace(0.0, 1.5 * a, n + 1))
    step = grid[1]
    while width - grid[-1] > 1e-12:
        step = min(1.25 * step, width - grid[-1])
        if width - grid[-1] - step < 0.6 * step:
            step = width - grid[-1]
        grid.append(grid[-1] + step)
    m = len(grid) - 1

    def upper(s, t):
        r, z = grid[round(s)], grid[round(t)]
        return r, z + r * r / (2.0 * bend) * (1.0 - z / width)

    def lower(s, t):
        r, z = upper(s, m - t)
        return r, -z

    sides = ((0.0, float(m)), (0.0, float(m)))
    return Mesh((m, m), *sides, shape=upper), Mesh((m, m), *sides, shape=lower)


def axis_hertz():
    """Two equal bodies with the curvature 1/R pressed together (Hertz for spheres, a^3 = 3 P R*/(4
    E*)): pressure of the nodes within .9 a over the largest one of Hertz, its L2 error, and a by
    the second moment of the forces. The pole has an error of order h, an element there has one
    ring of nodes around the axis: 5 % and 2.5 % were measured. Forces sum up to the load."""
    young, nu, a, bend = 1000.0, 0.3, 0.1, 10.0
    modulus = 0.5 * young / (1.0 - nu**2)
    load = 4.0 * modulus * a**3 / (3.0 * 0.5 * bend)
    peak = 1.5 * load / (np.pi * a**2)
    worst = {}
    for n, l2, inner in ((8, 0.06, 0.06), (16, 0.01, 0.03)):
        top, low = sphere_meshes(n, a, 1.0, bend)
        count = len(top.x)
        lines = mesh_cards(top) + mesh_cards(low, 2, count + 1) + part_cards()
        lines += ["*PART", "low", "2,1,1"] + elastic(young=young, poisson=nu)
        lines += curve(1, (0.0, 0.0), (1.0, 1.0)) + pressed(top.top(), factor=load / np.pi)
        lines += node_set(3, low.bottom(), count + 1) + ["*BOUNDARY_SPC_SET", "3,,,1"]
        lines += ["*SET_PART_LIST", "11,", "1,", "*SET_PART_LIST", "12,", "2,"]
        lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,0.0"]
        folder = run("hertz", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NCFORC")))
        rows = table(folder, "ncforc")
        rows = {c: rows[c][(rows["time"] == 1.0) & (rows["side"] == 1)] for c in rows.names}
        r = top.x[np.array(rows["node"], dtype=int) - 1][:, 0]
        exact = peak * np.sqrt(np.maximum(0.0, 1.0 - (r / a) ** 2))
        error = rows["pressure"] - exact
        what = "%d elements over 1.5 a: " % n
        worst[n] = np.abs(error[r < 0.9 * a]).max() / peak
        at_most(worst[n], inner, what + "pressure")
        at_most(np.sqrt((r * error**2).sum() / (r * exact**2).sum()), l2, what + "L2")
        total = rows["fy"].sum()
        at_most(abs(total / load - 1.0), 1.0e-9, what + "sum of the forces")
        moment = np.sqrt(2.5 * (rows["fy"] * r**2).sum() / total)
        at_most(abs(moment / a - 1.0), 5.0e-3, what + "radius of contact")
    at_most(worst[16], 0.6 * worst[8], "the pressure converges")


def axis_weight():
    """A cylinder that stands on a wall under its weight, sides free, PR 0: stress rho g (H - y) at
    the centres of the elements, and the force of the wall is the weight: 1e-9 by RES 1e-10."""
    density, gravity, height, radius = 1.0e-3, 9.81, 2.0, 0.7
    mesh = Mesh((3, 8), (0.0, radius), (0.0, height))
    lines = mesh_cards(mesh) + part_cards() + elastic(poisson=0.0, density=density)
    lines += curve(1, (0.0, gravity), (1.0, gravity)) + ["*LOAD_BODY_Y", "1,1.0"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0"]
    lines += ["*DATABASE_HISTORY_SHELL"] + ["%d," % (e + 1) for e in range(len(mesh.elements))]
    folder = run("weight", deck(lines, 1.0, 1.0, static=True, tables=("ELOUT", "RWFORC")))
    weight = density * gravity * np.pi * radius**2 * height
    at_most(abs(abs(table(folder, "rwforc")["fy"][-1]) / weight - 1.0), 1.0e-9, "weight")
    rows = table(folder, "elout")
    last = rows["time"] == 1.0
    middle = np.array([mesh.x[e].mean(axis=0)[1] for e in mesh.elements])
    exact = -density * gravity * (height - middle)
    at_most(np.abs(rows["syy"][last] - exact).max() / np.abs(exact).max(), 1.0e-9, "stress")
    others = max(np.abs(rows[c][last]).max() for c in ("sxx", "szz", "sxy"))
    at_most(others / np.abs(exact).max(), 1.0e-9, "no other stress")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
