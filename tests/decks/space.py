"""Decks in space: patch test, bending, a slab against the plane, waves, flight, pressure, ledgers of
all schemes, restarts, fields. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import h5py
import numpy as np
import scenes
import solids
from scenes import at_most, check, finish, run_text, show, table, within
from solids import FORMS, Box, cards, curve, deck, node_set, part

# Of the largest term: round-off of a few hundred steps (conventions of the ledger tests).
LEDGER = 1.0e-11
SCHEMES = (
    ("THETA,0.5,0.5", ("CONSISTENT,0", "LUMPED,0", "DISPERSION,0")),
    ("THETA,0.7,0.6", ("CONSISTENT,0", "LUMPED,0")),
    ("NEWMARK,", ("CONSISTENT,0", "LUMPED,0")),
    ("HHT,", ("CONSISTENT,0", "LUMPED,0")),
    ("GENALPHA,,,,0.7", ("CONSISTENT,0",)),
    ("MOREAU,0.6,0.55", ("CONSISTENT,0", "LUMPED,0")),
    ("PAOLI,", ("CONSISTENT,0", "LUMPED,0")),
    ("CDLAGRANGE,", ("LUMPED,0",)),
    ("THETAPV,", ("CONSISTENT,0",)),
    ("NSGENALPHA,,,,0.7", ("CONSISTENT,0",)),
    ("CSNEWMARK,", ("CONSISTENT,0",)),
)


def run(name, text, *options):
    """Runs a deck that must run; returns its folder."""
    folder, code, errors = run_text(name, text, *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder


def prescribed(rows, x, gradient, first=1):
    """Cards of the displacement A x of nodes, grown by curve 1; by curve 2, which stays 0, where
    it is 0: a factor of 0 would be 1."""
    lines = ["*BOUNDARY_PRESCRIBED_MOTION_NODE"]
    for r in rows:
        for d, u in enumerate(gradient @ x[r]):
            number, factor = (1, float(u)) if u else (2, 1.0)
            lines.append("%d,%d,2,%d,%r" % (first + r, d + 1, number, factor))
    return lines + curve(2, (0.0, 0.0), (1.0, 0.0))


def listed(numbers):
    """Numbers with all their digits, with commas between."""
    return ",".join(repr(float(a)) for a in numbers)


def space_patch():
    """A linear displacement of the boundary of a patch of distorted elements gives it inside, and
    one stress: to round-off times the condition of the patch, below 100."""
    gradient = np.array([[2.0, 1.0, -0.5], [0.3, -1.0, 0.7], [-0.4, 0.6, 1.5]]) * 1.0e-3
    strain = 0.5 * (gradient + gradient.T)
    lam, mu = 0.3 * 1000.0 / (1.3 * 0.4), 1000.0 / 2.6
    stress = 2.0 * mu * strain + lam * np.trace(strain) * np.eye(3)
    for form in FORMS:
        box = Box((2, 2, 2), form=form, shift=0.25, seed=3, free=True)
        outer = box.boundary()
        inner = [r for r in range(len(box.x)) if r not in outer]
        lines = cards(box.x, box.elements, two=form == "HEX8MODE") + part(form)
        lines += curve(1, (0.0, 0.0), (1.0, 1.0)) + prescribed(outer, box.x, gradient)
        lines += ["*DATABASE_HISTORY_NODE", ",".join(str(r + 1) for r in inner[:8]) + ","]
        lines += ["*DATABASE_HISTORY_SOLID", "1,2,3,4,5,6,7,8"]
        folder = run(
            "patch " + form,
            deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT", "ELOUT")),
        )
        nodes = table(folder, "nodout")
        last = nodes["time"] == 1.0
        u = np.stack([nodes[c][last] for c in ("ux", "uy", "uz")], axis=1)
        exact = box.x[np.array(nodes["node"][last], dtype=int) - 1] @ gradient.T
        scale = np.abs(box.x @ gradient.T).max()
        at_most(np.abs(u - exact).max() / scale, 1.0e-13, form + ": displacement")
        rows = table(folder, "elout")
        last = rows["time"] == 1.0
        got = np.stack([rows[c][last] for c in ("sxx", "syy", "szz", "sxy", "syz", "szx")])
        want = stress[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
        at_most(
            np.abs(got - want[:, None]).max() / np.abs(stress).max(), 1.0e-12, form + ": stress"
        )


def bend(form, held, tip):
    """Tip over L^2/(E h) of a bar of 10 x 1 x 1 elements in pure bending: rows of nodes of the root
    whose u_y and u_z are held, and of those whose mean u_z is the tip, chosen by functions of the
    box."""
    box = Box((10, 1, 1), (10.0, 1.0, 1.0), form)
    root, end = box.on(0, 0.0), box.on(0, 10.0)
    lines = cards(box.x, box.elements) + part(form)
    for number, rows in enumerate(held(box, root), start=2):
        lines += node_set(number, rows)
    lines += node_set(1, root) + ["*BOUNDARY_SPC_SET", "1,,1", "2,,,1", "3,,,,1"]
    lines += curve(1, (0.0, 0.0), (1.0, 1.0)) + ["*LOAD_NODE_POINT"]
    for r in end:    # int N (2 z/h - 1) dA of one face
        force = (2.0 * box.x[r][2] - 1.0) / 12.0
        if form == "HEX27":    # products of int N = 1/6, 4/6 and int N (2 z - 1) = 1/6, 0
            force = (2.0 * box.x[r][2] - 1.0) / 36.0 * (4 if box.x[r][1] == 0.5 else 1)
        if force != 0.0:
            lines.append("%d,1,1,%r" % (r + 1, float(force)))
    rows = tip(box, end)
    lines += ["*DATABASE_HISTORY_NODE"] + ["%d," % (r + 1) for r in rows]
    folder = run("bend", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT")))
    return np.abs(table(folder, "nodout")["uz"][-len(rows):].mean()) * 1000.0 / 100.0


def space_bending():
    """Pure bending of a bar of 10 x 1 x 1 elements: tip over L^2/(E h), as measured with another
    program (design; 1e-3 are its digits); 1 is exact, and HEX27 has it, for the displacement is
    quadratic: 1e-11, round-off times the condition."""
    for form, want in (
        ("HEX8", 0.649), ("HEX8MEAN", 1.211), ("HEX8MODE", 0.998), ("TET4", 0.225)
    ):
        got = bend(
            form,
            lambda box, root: [[r for r in root if box.x[r][axis] == 0.0] for axis in (1, 2)],
            lambda box, end: end,
        )
        at_most(abs(got - want), 1.0e-3, form + ": tip")

    def corners(box, rows):
        return [r for r in rows if box.x[r][1] != 0.5 and box.x[r][2] == 0.5]

    got = bend(
        "HEX27",
        lambda box, root: [[r for r in root if box.x[r][1] == 0.5], corners(box, root)],
        corners,
    )
    at_most(abs(got - 1.0), 1.0e-11, "HEX27: tip")


ENERGIES = ("kinetic internal total initial external motion friction contact unsolved "
    "algorithmic damping").split()


class Slab:
    """A plane deck of one part, fixed columns, as a slab of thickness 1 one element thick with
    u_z = 0: each node twice, the second 1000 numbers on."""

    def __init__(self, text):
        self.out, self.nodes, self.all = [], {}, []
        keyword = None
        for line in text.splitlines():
            if line.startswith("$"):
                continue
            if line.startswith("*"):
                keyword, self.count = line.strip(), 0
                if keyword == "*END":
                    break
                self.out.append(keyword.replace("SHELL", "SOLID"))
                continue
            self.count += 1
            self.card(keyword, line)
        self.out += ["*SET_NODE_LIST", "99,"]
        self.out += [",".join(map(str, self.all[k : k + 8])) + "," for k in range(0, len(self.all), 8)]
        self.out += ["*BOUNDARY_SPC_SET", "99,0,0,0,1", "*END", ""]
        self.text = "\n".join(self.out)

    def card(self, keyword, line):
        f = line.split()
        if keyword == "*NODE":
            self.all += [int(f[0]), int(f[0]) + 1000]
            self.out += ["%s,%s,%s,0.0" % tuple(f[:3]), "%d,%s,%s,1.0" % (int(f[0]) + 1000, *f[1:3])]
        elif keyword == "*ELEMENT_SHELL":
            n = [int(k) for k in f[2:]]
            up = [k + 1000 for k in n]
            if len(n) == 3:    # a wedge: triangles 1-2-5 and 4-3-6, its base n0 n1 up1 up0
                n = [n[1], n[0], up[0], up[1], n[2], n[2], up[2], up[2]]
            else:
                n += up
            self.out.append(",".join(f[:2] + [str(k) for k in n]))
        elif keyword == "*SECTION_SHELL":
            self.out += ["%s,1" % f[0]] if self.count == 1 else []
        elif keyword == "*SET_NODE_LIST" and self.count > 1:
            self.out.append(",".join(f + [str(int(k) + 1000) for k in f]) + ",")
        elif keyword == "*SET_SEGMENT" and self.count > 1:
            a, b = int(f[0]), int(f[1])
            self.out.append("%d,%d,%d,%d" % (a, b, b + 1000, a + 1000))
        elif keyword == "*LOAD_NODE_POINT":
            for more in (0, 1000):
                self.out.append("%d,%s,%s,%r" % (int(f[0]) + more, f[1], f[2], float(f[3]) / 2))
        elif keyword == "*BOUNDARY_SPC_NODE":
            for more in (0, 1000):
                self.out.append(",".join([str(int(f[0]) + more)] + f[1:]))
        else:
            self.out.append(line)


def space_slab():
    """A slab whose nodes do not leave their planes is the plane strain body: the lessons without
    contact, in every column of their tables. 1e-9 of the largest value, of a vector, an energy or a
    stress that of its kin, because one of them may be round-off in both."""
    for lesson in ("pushed_bar", "damped_bar", "pressed_square", "falling_block"):
        with open(os.path.join(scenes.ROOT, "input", "lessons", lesson + ".k")) as file:
            text = file.read()
        plane, slab = run(lesson, text), run(lesson + "-slab", Slab(text).text)
        for name in ("glstat", "matsum", "nodout", "elout"):
            if not os.path.exists(os.path.join(plane, name + ".tab")):
                continue
            a, b = table(plane, name), table(slab, name)
            same = [c for c in a.names if c not in ("ratio", "residual", "angx", "angy", "z")]
            if name == "nodout":
                check(np.array_equal(a["node"], b["node"]), lesson + ": nodes")
            for c in same:
                if name == "elout" and c == "szz":
                    continue    # in damped_bar plane stress, with PR 0
                kin = [d for d in same if d.rstrip("xyz") == c.rstrip("xyz")]
                if c in ENERGIES or (name == "elout" and c[0] == "s"):
                    kin = [d for d in same if d in ENERGIES or d[0] == "s"]
                scale = max([np.abs(a[d]).max() for d in kin] + [1.0e-300])
                at_most(np.abs(a[c] - b[c]).max() / scale, 1.0e-9, "%s %s %s" % (lesson, name, c))


def space_wave():
    """The end of a bar in space is moved at a constant velocity: with PR 0, DISPERSION and steps of
    one element the wave is exact (Guddati & Yue 2004), 1e-12 being round-off of 80 steps; in the
    other forms too. Sections of 2 x 2 elements, parallelepipeds."""
    speed = np.sqrt(1000.0 / 1.0e-3)
    for form in ("HEX8", "HEX8MEAN", "HEX8MODE"):
        box = Box((40, 2, 2), (40.0, 2.0, 1.0), form)
        dt = float(1.0 / speed)
        lines = cards(box.x, box.elements) + part(form, poisson=0.0) + node_set(1, box.on(0, 0.0))
        lines += curve(1, (0.0, 1.0), (1.0, 1.0)) + ["*BOUNDARY_PRESCRIBED_MOTION_SET", "1,1,0,1"]
        lines += ["*DATABASE_HISTORY_SOLID", "1,77,78,79,80,81"]
        text = deck(lines, dt, 60 * dt, mass="DISPERSION,0", tables=("GLSTAT", "ELOUT"))
        rows = table(run("wave " + form, text), "elout", element=77)
        # Element 77 is the 20th along x. The front, which the mid-point rule sees over two steps,
        # has passed it after step 20; the wave from the free end, which unloads it, comes at 60.
        stress = -1000.0 / speed
        at_most(np.abs(rows["sxx"][:19]).max() / abs(stress), 1.0e-12, form + ": before")
        at_most(np.abs(rows["sxx"][21:60] / stress - 1.0).max(), 1.0e-12, form + ": behind")
        within(rows["sxx"][19] / stress, 0.0, 0.5, form + ": front")


def space_flight():
    """Free bodies of every form. A motion V + omega n x (X - C) has no strain: its energy is the
    round-off of products of the stiffness with the turn, eps E V (omega t)^2 times a few. A random motion keeps
    momentum, angular momentum (about the reference places) and energy; 1e-12 is round-off of 100
    steps."""
    spin, axis = 0.02, np.array([1.0, 2.0, -2.0]) / 3.0
    centre, velocity = np.array([0.3, -0.2, 0.5]), np.array([1.0, -2.0, 0.5])
    chance = np.random.default_rng(5)
    for form in FORMS:
        box = Box((2, 2, 2), form=form, shift=0.2, seed=8, free=True)
        mesh = cards(box.x, box.elements) + part(form)
        lines = mesh + ["*INITIAL_VELOCITY_GENERATION", "0,2,%r,%s" % (spin, listed(velocity))]
        lines += ["%s,1.0,2.0,-2.0" % listed(centre)]
        lines += ["*DATABASE_HISTORY_NODE", "1,14,27"]
        text = deck(lines, 1.0e-3, 0.1, tables=("GLSTAT", "NODOUT"))
        folder = run("rigid " + form, text)
        rows = table(folder, "glstat")
        turned = 1000.0 * (spin * 0.1) ** 2
        at_most(np.abs(rows["internal"]).max(), 1.0e-15 * turned, form + ": strain energy")
        for n in (1, 14, 27):
            node = table(folder, "nodout", node=n)
            v = velocity + spin * np.cross(axis, box.x[n - 1] - centre)
            got = np.array([node[c][-1] for c in ("vx", "vy", "vz")])
            # eps v of each solve, times 2/h h in each of 100 steps, times the condition, about 10
            at_most(np.abs(got - v).max(), 1.0e-11, form + ": velocity")
        lines = mesh + ["*INITIAL_VELOCITY_NODE"]
        for r in range(len(box.x)):
            lines.append("%d,%s" % (r + 1, listed(chance.normal(size=3))))
        for mass in ("CONSISTENT,0", "LUMPED,0"):
            rows = table(run("random " + form, deck(lines, 1.0e-4, 0.01, mass=mass)), "glstat")
            names = ("momx", "momy", "momz", "angx", "angy", "angz")
            scale = np.sqrt(2.0 * rows["kinetic"][0] * 1.0e-3)    # of the momentum: sqrt(2 E m)
            for c in names:
                at_most(np.abs(rows[c] - rows[c][0]).max() / scale, 1.0e-12, form + ": " + c)
            at_most(np.abs(rows["total"] / rows["total"][0] - 1).max(), 1.0e-12, form + ": energy")


def space_pressure():
    """Uniform pressure on all faces of a random element has neither force nor moment: int n dA and
    int X x n dA over a closed surface are 0, and 2 x 2 points are exact on warped faces. 1e-13 of
    p A t; so too on curved faces of quadratic elements, whose mid nodes are anywhere. On one face of a
    box it is p A. Segments in every order that names the face."""
    chance = np.random.default_rng(11)
    for form in ("HEX8", "PYRAMID5", "WEDGE6", "TET4", "TET10", "HEX27"):
        box = Box((1, 1, 1), form=form, shift=0.25, seed=int(chance.integers(99)), free=True)
        far = 0.05 if form in ("TET10", "HEX27") else 0.15
        x = box.x + far * chance.uniform(-1.0, 1.0, box.x.shape)
        element = box.elements[0]
        used = sorted(set(element))
        local = [used.index(n) for n in element]
        if form in ("TET4", "TET10"):
            faces = [[local[i] for i in f] for f in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
        else:
            faces = [list(dict.fromkeys(local[i] for i in f)) for f in solids.HEX_FACES]
            faces = [f for f in faces if len(f) > 2]
        lines = cards(x[used], [local]) + part(form) + ["*SET_SEGMENT", "1,"]
        for k, f in enumerate(faces):
            turned = f[k % len(f):] + f[:k % len(f)]
            turned = [n + 1 for n in (turned[::-1] if k % 2 else turned)]
            lines.append(",".join(map(str, turned + ([0] if len(f) == 3 and k % 3 else []))))
            if len(f) == 3 and k % 3 == 0:
                lines[-1] += ",%d" % turned[-1]
        lines += ["*LOAD_SEGMENT_SET", "1,1,1.0"] + curve(1, (0.0, 2.0), (1.0, 2.0))
        rows = table(run("closed " + form, deck(lines, 1.0e-3, 0.02)), "glstat")
        check(rows["external"].max() > 0.0, form + ": the pressure works")
        for c in ("momx", "momy", "momz", "angx", "angy", "angz"):
            at_most(np.abs(rows[c]).max() / (2.0 * 0.02), 1.0e-13, form + ": " + c)
    box = Box((2, 2, 2), (1.0, 2.0, 3.0))
    lines = cards(box.x, box.elements) + part() + curve(1, (0.0, 2.0), (1.0, 2.0))
    lines += ["*DEFINE_BOX", "1,-1.0,2.0,-1.0,3.0,2.999,3.001"]
    lines += ["*SET_SEGMENT_GENERAL", "1,", "BOX,1", "*LOAD_SEGMENT_SET", "1,1,1.0"]
    rows = table(run("top", deck(lines, 1.0e-3, 0.02)), "glstat")
    at_most(abs(rows["momz"][-1] + 2.0 * 2.0 * 0.02), 1.0e-14, "pressure on top")
    for c in ("momx", "momy"):
        at_most(np.abs(rows[c]).max(), 1.0e-14, "pressure on top: " + c)


def all_forms(dispersion=False):
    """A box of each form beside the other, with supports, gravity along z, a pressure, a force, a
    motion that ends and damping; returns cards."""
    lines, first, sets = [], 1, []
    for number, form in enumerate(FORMS, start=1):
        if dispersion and form[:4] != "HEX8":
            continue
        box = Box((3, 2, 1), (3.0, 2.0, 1.0), form, 0.2, number, (0.0, 0.0, 3.0 * number))
        lines += cards(box.x, box.elements, number, first) + part(form, number=number)
        lines += node_set(number, box.on(0, 0.0), first)
        lines += node_set(10 + number, box.on(0, 3.0), first)
        sets.append(number)
        first += 1000
    lines += ["*BOUNDARY_SPC_SET"] + ["%d,,1,1,1" % k for k in sets[1:]]
    lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "%d,3,0,2,1.0,,0.0155" % sets[0]]
    lines += ["*LOAD_NODE_SET"] + ["%d,3,1,0.1" % (10 + k) for k in sets]
    lines += ["*LOAD_BODY_Z", "1,30.0", "*INITIAL_VELOCITY", "0,", "0.5,-0.2,0.3"]
    lines += curve(1, (0.0, 1.0), (0.01, 0.0), (1.0, 0.0)) + curve(2, (0.0, 0.3), (1.0, 0.3))
    lines += ["*SET_SEGMENT_GENERAL", "1,", "ALL", "*LOAD_SEGMENT_SET", "1,1,2.0"]
    return lines


def space_ledgers():
    """Every scheme and mass on bodies of every form, with loads, motions and supports: the energy
    balance closes to round-off."""
    listed = {s.split(",")[0] for s, _ in SCHEMES}
    missing = set(scenes.words_of("SCHEME")) - listed
    check(not missing, "schemes without a scene: %s" % ", ".join(sorted(missing)))
    for scheme, masses in SCHEMES:
        for mass in masses:
            text = deck(all_forms(mass[:4] == "DISP"), 1.0e-4, 0.02, scheme=scheme, mass=mass)
            if scheme == "HHT,":
                card = "*CONTROL_IMPLICIT_DYNAMICS\n"
                text = text.replace(card + "1,", card + "1,,,,,,,-0.2")
            rows = table(run("ledger", text), "glstat")
            at_most(np.abs(rows["residual"]).max(), LEDGER, "%s %s" % (scheme, mass))
            check(rows["kinetic"].max() > 0.0, "it moves")
    text = deck(all_forms(), 1.0e-4, 0.02, scheme="PAOLI,,,,,,0.0", mass="LUMPED,0")
    rows = table(run("explicit", text), "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "explicit")
    damping = ["*DAMPING_GLOBAL", "0,20.0,1.0,2.0,0.5", "*DAMPING_PART_STIFFNESS", "2,-1e-5"]
    rows = table(run("damped", deck(all_forms() + damping, 1.0e-4, 0.02)), "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "damped")
    check(rows["damping"][-1] > 0.0, "damping takes energy")


def space_engines():
    """Every linear solver gives the same motion: 1e-9 of the largest displacement, round-off times
    the condition of A and 200 steps (conventions.md 4)."""
    history = ["*DATABASE_HISTORY_NODE", "12,1012,2012,3012,4012,5012"]
    found = {}
    for engine in scenes.words_of("ENGINE"):
        if engine in ("DIAGONAL", "MUMPS"):
            continue
        cards = all_forms() + history + ["*BIPACT_SOLVER", engine + ","]
        text = deck(cards, 1.0e-4, 0.02, tables=("NODOUT",), every=1.0e-3)
        rows = table(run("engine " + engine, text), "nodout")
        found[engine] = np.stack([rows[c] for c in ("ux", "uy", "uz")])
    for engine, u in found.items():
        scale = np.abs(found["LDLT"]).max()
        at_most(np.abs(u - found["LDLT"]).max() / scale, 1.0e-9, engine)


def space_statics():
    """A free body between forces in balance is solved by proximal passes: six rigid motions are not
    held. Its stress is that of the forces, 1e-9 by RES 1e-10. With five of six motions held as well;
    forces out of balance end with exit code 1."""
    box = Box((3, 2, 2), (3.0, 2.0, 2.0))
    lines = cards(box.x, box.elements) + part() + curve(1, (0.0, 0.0), (1.0, 1.0))
    ends = ["*DEFINE_BOX", "1,-0.01,0.01,-1.0,3.0,-1.0,3.0", "*DEFINE_BOX"]
    ends += ["2,2.99,3.01,-1.0,3.0,-1.0,3.0", "*SET_SEGMENT_GENERAL", "1,", "BOX,1,2"]
    pull = ends + ["*LOAD_SEGMENT_SET", "1,1,-5.0", "*DATABASE_HISTORY_SOLID", "1,6,12"]
    held = node_set(1, box.on(0, 0.0)[:1]) + node_set(2, box.on(1, 0.0)[-1:])
    held += ["*BOUNDARY_SPC_SET", "1,,1,1,1", "2,,,1,1"]
    for name, more in (("free", []), ("half held", held)):
        text = deck(lines + pull + more, 1.0, 1.0, static=True, tables=("ELOUT", "GLSTAT"))
        rows = table(run(name, text), "elout")
        got = rows["sxx"][rows["time"] == 1.0]
        at_most(np.abs(got - 5.0).max(), 5.0e-9, name + ": stress")
        other = [np.abs(rows[c]).max() for c in ("syy", "szz", "sxy", "syz", "szx")]
        at_most(max(other), 5.0e-9, name + ": other stresses")
    one = lines + ["*LOAD_NODE_POINT", "1,3,1,1.0"]
    folder, code, errors = run_text("lost", deck(one, 1.0, 1.0, static=True))
    check(code == 1 and "part 1 is not held" in errors, "exit %d: %s" % (code, errors))


def space_supports():
    """A distorted box of every form stands on nodes that TC of *NODE holds, under LOAD_BODY_Z, which
    acts against z: the mass of MATSUM is density times volume (to 1e-14: plane faces), the reactions
    are its weight: 1e-11, round-off times the condition of the matrix."""
    for form in FORMS:
        box = Box((3, 2, 2), (3.0, 2.0, 2.0), form, 0.2, 4)
        lines = cards(box.x, box.elements)
        foot = box.on(2, 0.0)
        for r in foot:
            lines[1 + r] += ",7"
        lines += part(form) + curve(1, (0.0, 0.0), (1.0, 1.0)) + ["*LOAD_BODY_Z", "1,10.0"]
        text = deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "MATSUM", "SPCFORC"))
        folder = run("stands " + form, text)
        weight = 10.0 * 1.0e-3 * 12.0
        at_most(abs(table(folder, "matsum")["mass"][-1] / (weight / 10.0) - 1.0), 1.0e-14, form)
        rows = table(folder, "spcforc")
        last = rows["time"] == 1.0
        check(sorted(rows["node"][last]) == [r + 1 for r in foot], form + ": held nodes")
        force = np.stack([rows[c][last] for c in ("fx", "fy", "fz")], axis=1)
        # The mean over the step, in which the load grows from 0: half of the weight.
        total = force.sum(axis=0) - [0.0, 0.0, 0.5 * weight]
        at_most(np.abs(total).max() / weight, 1.0e-11, form + ": reactions")


def space_warnings():
    """An element that turns by more than ROTWARN is told, by the arc tangent of t omega; a part of
    tetrahedra with a high PR, or of full elements with one near 1/2, is warned of, ELFORM 1 noted."""
    box = Box((2, 2, 2), form="HEX8", shift=0.2, seed=8)
    lines = cards(box.x, box.elements) + part()
    lines += ["*INITIAL_VELOCITY_GENERATION", "0,2,2.0", "0.5,0.5,0.5,1.0,1.0,1.0"]
    folder, code, errors = run_text("turned", deck(lines, 1.0e-3, 0.1))
    said = [x for x in errors.splitlines() if "WARNING rotation" in x]
    degrees = np.degrees(np.arctan(2.0 * 0.044))    # the first step beyond 5 degrees
    check(len(said) == 1 and "turned by %.6f " % degrees in said[0], "%g: %s" % (degrees, errors))
    for form, poisson, locks in (
        ("TET4", 0.45, True), ("TET4", 0.35, False), ("HEX8", 0.495, True), ("HEX8", 0.45, False),
        ("HEX8MEAN", 0.499, False), ("HEX8MODE", 0.499, False), ("WEDGE6", 0.495, True),
    ):
        box = Box((1, 1, 1), form=form)
        lines = cards(box.x, box.elements) + part(form, poisson=poisson)
        folder, code, errors = run_text("locks", deck(lines, 1.0e-3, 0.01))
        check(code == 0 and ("part 1 locks" in errors) == locks, "%s: %s" % (form, errors))
    log = open(os.path.join(run("full", deck(cards(box.x, box.elements) + part("HEX8"), 1e-3,
                                             0.01)), "bipact.log")).read()
    check("2 x 2 x 2 points" in log, "the note of ELFORM 1")


def space_restart():
    """A run that goes on from its restart file is the whole run, in every byte of its tables."""
    text = deck(all_forms(), 1.0e-4, 0.02)
    plain = contents(run("plain", text))
    cut = text.replace("*END", "*BIPACT_RESTART\n70,,99\n*END")
    folder = run("cut", cut)
    whole = contents(folder)
    check(whole == plain, "restart files change the tables")
    for name in sorted(f for f in os.listdir(folder) if "restart" in f)[:2]:
        run("cut", cut, "--restart", os.path.join(folder, name))
        check(contents(folder) == whole, "from " + name)


def contents(folder):
    """The tables of a run, as text."""
    return {
        f: open(os.path.join(folder, f)).read() for f in os.listdir(folder) if f[-4:] == ".tab"
    }


def space_fields():
    """Field files: cells and their nodes as VTK wants them (positive volumes there), stress,
    principal stresses and displacements of a uniform strain."""
    gradient = np.diag([1.0e-3, -2.0e-3, 0.5e-3])
    gradient[0, 1] = gradient[1, 2] = 1.0e-3
    strain = 0.5 * (gradient + gradient.T)
    stress = 2.0 * 1000.0 / 2.6 * strain + 0.3 * 1000.0 / (1.3 * 0.4) * np.trace(strain) * np.eye(3)
    kinds = {
        "HEX8": 12, "HEX8MEAN": 12, "HEX8MODE": 12, "WEDGE6": 13, "PYRAMID5": 14, "TET4": 10,
        "TET10": 24, "HEX27": 29,
    }
    for form in FORMS:
        box = Box((1, 2, 1), form=form, shift=0.2, seed=2)
        lines = cards(box.x, box.elements) + part(form) + curve(1, (0.0, 0.0), (1.0, 1.0))
        lines += prescribed(range(len(box.x)), box.x, gradient)
        lines += ["*BIPACT_FIELD", "1.0,", "U,STRESS,PRINCIPAL,ENERGY,PART"]
        folder = run("fields " + form, deck(lines, 1.0, 1.0, static=True))
        with h5py.File(os.path.join(folder, "fields.000.vtkhdf")) as file:
            root = file["VTKHDF"]
            n, m = len(box.x), len(box.elements)
            check(set(root["Types"][:]) == {kinds[form]}, form + ": types")
            check(np.array_equal(root["Points"][:], box.x), form + ": points")
            offsets, ids = root["Offsets"][:], root["Connectivity"][:]
            for e in range(m):
                cell = ids[offsets[e] : offsets[e + 1]]
                check(set(cell) == set(box.elements[e]), form + ": nodes")
                p = box.x[cell]
                if form == "WEDGE6":    # normal of the first triangle toward the second
                    normal = np.cross(p[1] - p[0], p[2] - p[0])
                    check(normal @ (p[3:].mean(axis=0) - p[:3].mean(axis=0)) > 0.0, "wedge")
                    check(all(abs(p[k] - p[k + 3]) @ [1, 0, 1] < 0.5 for k in range(3)), "edges")
            u = root["PointData/U"][n : 2 * n]
            at_most(np.abs(u - box.x @ gradient.T).max(), 1.0e-15, form + ": U")
            got = root["CellData/STRESS"][m : 2 * m]
            want = stress[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]
            at_most(np.abs(got - want).max() / np.abs(want).max(), 1.0e-13, form + ": STRESS")
            got = root["CellData/PRINCIPAL"][m : 2 * m]
            want = np.linalg.eigvalsh(stress)[::-1]
            at_most(np.abs(got - want).max() / np.abs(want).max(), 1.0e-13, form + ": PRINCIPAL")
        xdmf = open(os.path.join(folder, "fields.xdmf")).read()
        names = {
            12: "Hexahedron", 13: "Wedge", 14: "Pyramid", 10: "Tetrahedron", 24: "Tetrahedron_10",
            29: "Hexahedron_27",
        }
        check('TopologyType="%s"' % names[kinds[form]] in xdmf, form + ": XDMF")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
