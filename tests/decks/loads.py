"""Motions, loads, supports, triangles, the tables of forces and stresses, the ways to name a
surface. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from scenes import at_most, check, deck, finish, run_text, table, two_blocks, within

SCHEMES = ("THETA,0.5,0.5", "NEWMARK,")


def bar(n=50, length=10.0, rows=1):
    """One bar of n elements along x, height 1, E 1000, density 1e-3, Poisson 0: c = 1000, rho c
    = 1. Node sets 1 left face, 2 right face; returns (lines, nodes)."""
    lines, elements = ["*NODE"], []
    for i in range(n + 1):
        for j in range(rows + 1):
            lines.append("%d,%r,%r" % (i * (rows + 1) + j + 1, length * i / n, j / rows))
    for i in range(n):
        for j in range(rows):
            a = i * (rows + 1) + j + 1
            elements.append(
                "%d,1,%d,%d,%d,%d" % (i * rows + j + 1, a, a + rows + 1, a + rows + 2, a + 1)
            )
    nodes = (n + 1) * (rows + 1)
    lines += ["*ELEMENT_SHELL"] + elements
    lines += [
        "*PART",
        "bar",
        "1,1,1",
        "*SECTION_SHELL",
        "1,13",
        "1.0",
        "*MAT_ELASTIC",
        "1,0.001,1000.0,0.0",
        "*SET_NODE_LIST",
        "1,",
        ",".join(str(k + 1) for k in range(rows + 1)) + ",",
        "*SET_NODE_LIST",
        "2,",
        ",".join(str(nodes - k) for k in range(rows + 1)) + ",",
    ]
    return lines, nodes


def closes(name, folder):
    """The ledger: 1e-12 a step, 1e-11 in all."""
    rows = table(folder, "glstat")
    at_most(np.abs(rows["residual"]).max(), 1.0e-11, name + ": ledger residual")
    at_most(np.abs(np.diff(rows["residual"])).max(), 1.0e-12, name + ": ledger, one step")
    return rows


def curve(number, *points):
    """Cards of a curve through (time, value) points."""
    return ["*DEFINE_CURVE", "%d," % number] + ["%r,%r" % p for p in points]


def motions():
    """The left end of a bar moves with velocity 1 from t = 0, given as velocity or as
    displacement: until the wave comes back at 2 L/c = 0.02 the reaction is rho c v A = 1 (1/2
    in the first step, which sees half of the front), the work of the motion its time integral,
    the stress behind the front -1. The mass DISPERSION at Courant 1 is exact: round-off, a
    digit more for the force, which divides it by v h. (NEWMARK has no exact mass: 2 % of
    dispersion.)"""
    lines, _ = bar()
    for scheme in SCHEMES:
        for vad, points in ((0, ((0.0, 1.0), (1.0, 1.0))), (2, ((0.0, 0.0), (1.0, 1.0)))):
            name = "%s VAD %d" % (scheme, vad)
            exact = scheme.startswith("THETA")
            extra = curve(1, *points) + [
                "*BOUNDARY_PRESCRIBED_MOTION_SET",
                "1,1,%d,1" % vad,
                "*DATABASE_SPCFORC",
                "0.0002,",
                "*DATABASE_ELOUT",
                "0.0002,",
                "*DATABASE_HISTORY_SHELL",
                "5,",
            ]
            folder, code, errors = run_text(
                "motion",
                deck(
                    lines,
                    2.0e-4,
                    0.018,
                    scheme,
                    "DISPERSION,0" if exact else "CONSISTENT,0",
                    history=[1],
                    extra=extra,
                ),
            )
            check(code == 0, errors)
            rows = closes(name, folder)
            loose = 1.0e-9 if exact else 0.05
            reaction = (
                table(folder, "spcforc", node=1)["fx"] + table(folder, "spcforc", node=2)["fx"]
            )
            if exact:
                at_most(np.abs(reaction[2:] - 1.0).max(), loose, name + ": reaction")
            work = rows["motion"]
            at_most(
                np.abs(work - rows["time"] + 1.0e-4)[1:].max() / 0.018,
                loose,
                name + ": work of the motion",
            )
            place = table(folder, "nodout", node=1)
            at_most(
                np.abs(place["ux"] - place["time"]).max(), 1.0e-13, name + ": the given motion"
            )
            stress = table(folder, "elout", element=5)
            passed = (stress["time"] > 0.003) & (stress["time"] < 0.017)
            if exact:
                at_most(np.abs(stress["sxx"][passed] + 1.0).max(), 1.0e-9, name + ": stress")


def motion_times():
    """A motion that begins and ends within the run, an acceleration for NEWMARK: the ledger
    closes, the work is that of the reactions, and the set of held dofs costs one factorisation
    each time."""
    lines, _ = bar(n=10)
    for scheme, vad in (
        (SCHEMES[0], 0),
        (SCHEMES[0], 2),
        (SCHEMES[1], 0),
        (SCHEMES[1], 1),
        (SCHEMES[1], 2),
    ):
        name = "%s VAD %d" % (scheme, vad)
        extra = curve(1, (0.0, 0.0), (0.01, 1.0e-3), (0.02, -1.0e-3)) + [
            "*BOUNDARY_PRESCRIBED_MOTION_SET",
            "1,1,%d,1,2.0,,0.015,0.005" % vad,
        ]
        folder, code, errors = run_text("times", deck(lines, 1.0e-4, 0.02, scheme, extra=extra))
        check(code == 0, errors)
        closes(name, folder)
        check(
            "factorisations 3," in open(os.path.join(folder, "bipact.log")).read(),
            name + ": three factorisations",
        )


def held_bodies():
    """Two bodies whose contact nodes are all prescribed: apart they pass, overlapping they
    fail."""
    lines, sets = two_blocks(gap=0.01, nx=(8, 1), ny=(1, 1))
    for speed, wanted in ((-0.5, 0), (-2.0, 1)):
        extra = (
            ["*BOUNDARY_SPC_SET", "1,,1,1"]
            + curve(1, (0.0, speed), (1.0, speed))
            + ["*BOUNDARY_PRESCRIBED_MOTION_SET", "2,2,0,1", "2,1,2,2"]
            + curve(2, (0.0, 0.0), (1.0, 0.0))
        )
        folder, code, errors = run_text("held", deck(lines, 1.0e-3, 0.01, mu=0.1, extra=extra))
        check(code == wanted, "speed %g: exit code %d %s" % (speed, code, errors))
        check((wanted == 0) or "prescribed motions overlap" in errors, errors)
        if wanted == 0:
            closes("held bodies", folder)


def pressure():
    """Pressure 1 on the left face of a bar, by a segment set, by a single segment, and by nodal
    forces: the same to round-off; momentum the integral of p A; with an arrival time the answer
    comes later by just that."""
    lines, _ = bar(n=20)
    segment = ["*SET_SEGMENT", "5,", "2,1,"]
    loads = {
        "set": segment + ["*LOAD_SEGMENT_SET", "5,1"],
        "segment": ["*LOAD_SEGMENT", "1,,,1,2"],
        "nodes": ["*LOAD_NODE_SET", "1,1,1,0.5"],
        "late": segment + ["*LOAD_SEGMENT_SET", "5,1,1.0,0.002"],
    }
    found = {}
    for name, load in loads.items():
        folder, code, errors = run_text(
            "pressure",
            deck(
                lines,
                1.0e-4,
                0.01,
                history=[1],
                extra=curve(1, (0.0, 0.0), (0.001, 1.0), (1.0, 1.0)) + load,
            ),
        )
        check(code == 0, errors)
        closes(name, folder)
        found[name] = table(folder, "nodout", node=1)["ux"]
        if name != "late":
            rows = table(folder, "matsum")
            exact = np.where(
                rows["time"] < 0.001, 500.0 * rows["time"] ** 2, rows["time"] - 0.0005
            )
            at_most(
                np.abs(rows["momx"] - exact).max() / 0.01,
                1.0e-12,
                name + ": momentum of p(t) A",
            )
    scale = np.abs(found["nodes"]).max()
    for name in ("set", "segment"):
        at_most(
            np.abs(found[name] - found["nodes"]).max() / scale,
            1.0e-13,
            name + " = nodal forces",
        )
    at_most(np.abs(found["late"][:20]).max(), 0.0, "nothing before the arrival")
    at_most(
        np.abs(found["late"][20:] - found["nodes"][:-20]).max() / scale,
        1.0e-12,
        "the same later",
    )


def triangles():
    """Blocks of triangles, of quadrilaterals and of both meet with friction: the ledger closes,
    momentum stays to round-off, forces sum to zero; halves of a mirrored scene move as mirror
    images."""
    base, sets = two_blocks(nx=(8, 4), ny=(2, 3), gap=0.01)

    def split(part):
        out = []
        for line in base:
            f = line.split(",")
            if len(f) == 6 and f[1] == str(part):
                out += [
                    ",".join((f[0], f[1], f[2], f[3], f[4])),
                    ",".join((str(1000 + int(f[0])), f[1], f[2], f[4], f[5])),
                ]
            else:
                out.append(line)
        return out

    both = ["*INITIAL_VELOCITY", "2,", "0.3,-1.0"]
    for name, lines in (("part 2 of triangles", split(2)), ("part 1 of triangles", split(1))):
        for mass in ("CONSISTENT,0", "LUMPED,0", "CONSISTENT,1"):
            folder, code, errors = run_text(
                "triangles", deck(lines, 2.0e-4, 0.04, mass=mass, mu=0.3, extra=both)
            )
            check(code == 0, errors)
            label = "%s, %s" % (name, mass)
            rows = closes(label, folder)
            momentum = np.hypot(rows["momx"] - rows["momx"][0], rows["momy"] - rows["momy"][0])
            at_most(momentum.max() / abs(rows["momy"][0]), 1.0e-12, label + ": momentum")
            one, two = table(folder, "rcforc", side=1), table(folder, "rcforc", side=2)
            check((one["fn"] > 0).any(), label + ": they touch")
            at_most(
                np.abs(one["fx"] + two["fx"]).max() + np.abs(one["fy"] + two["fy"]).max(),
                0.0,
                label + ": sum of forces",
            )


def node_forces():
    """NCFORC: the forces on the nodes of a side add up to its row of RCFORC, and the pressure
    of an even contact is the same at all its nodes."""
    lines, sets = two_blocks(nx=(8, 4), ny=(2, 2), gap=0.01, poisson=0.0)
    extra = ["*INITIAL_VELOCITY", "2,", "0.0,-1.0", "*DATABASE_NCFORC", "0.001,"]
    folder, code, errors = run_text(
        "nodes", deck(lines, 2.0e-4, 0.02, every=0.001, mu=0.2, extra=extra)
    )
    check(code == 0, errors)
    nodes, sums = table(folder, "ncforc"), table(folder, "rcforc")
    pressed = 0
    for side in (1, 2):
        whole = sums.select(side=side)
        for t, fy, fmy in zip(whole["time"], whole["fy"], whole["fmy"]):
            here = (nodes["time"] == t) & (nodes["side"] == side)
            pressed += np.abs(nodes["fy"][here]).max(initial=0.0) > 0
            at_most(abs(nodes["fy"][here].sum() - fy), 1.0e-12 * max(1.0, abs(fy)), "sum of fy")
            at_most(
                abs(nodes["fmy"][here].sum() - fmy), 1.0e-12 * max(1.0, abs(fmy)), "sum of fmy"
            )
    check(pressed > 4, "some rows are of a contact that is pressed")
    check(set(nodes["status"]) <= {0, 1, 2}, "status is open, stick or slip")


def surfaces():
    """A surface named by part set, part, node set, segment set; sets by lists and by ranges;
    contact by either card: the same run, bit for bit."""
    lines, sets = two_blocks(nx=(8, 4), ny=(2, 2), gap=0.01)
    start = ["*INITIAL_VELOCITY", "2,", "0.1,-1.0"]
    top = [n for n in sets[1] if (n - 1) % 3 == 2]
    bottom = [n for n in sets[2] if (n - sets[2][0]) % 3 == 0]
    named = ["*SET_NODE_LIST", "21,"] + [
        ",".join(map(str, top[k : k + 8])) + "," for k in range(0, len(top), 8)
    ]
    named += ["*SET_NODE_LIST", "22,", ",".join(map(str, bottom)) + ","]
    named += ["*SET_SEGMENT", "31,"] + ["%d,%d" % pair for pair in zip(top[1:], top)]
    named += ["*SET_SEGMENT", "32,"] + ["%d,%d" % pair for pair in zip(bottom, bottom[1:])]
    ranges = [
        "*SET_PART_LIST_GENERATE",
        "41,",
        "1,1,",
        "*SET_PART_LIST_GENERATE",
        "42,",
        "2,9,",
    ]
    card = "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE"
    ways = {
        "parts": [card, "1,2,,,0.2", "*BIPACT_PAIR", "1,,PART,PART"],
        "node sets": [card, "-21,-22,,,0.2"],
        "segments": [card, "31,32,,,0.2", "*BIPACT_PAIR", "1,,SEGSET,SEGSET"],
        "ranges": ranges + [card, "41,42,,,0.2"],
        "with an id": [
            card + "_ID",
            "       300two blocks",
            "11,12,,,0.2",
            "*BIPACT_PAIR",
            "300,B",
        ],
        "nodes to surface": ["*CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE", "-22,11,,,0.2"],
    }

    def run(name, cards):
        text = deck(
            lines + named, 2.0e-4, 0.02, extra=start + cards + ["*DATABASE_RCFORC", "2.0e-4,"]
        )
        folder, code, errors = run_text("surface", text)
        check(code == 0, name + ": " + errors)
        rows, force = table(folder, "glstat"), table(folder, "rcforc")
        return [rows[c] for c in rows.names] + [np.sort(np.abs(force["fy"]))]

    plain = run("part sets", [card, "11,12,,,0.2"])
    check(plain[-1].max() > 0, "the blocks touch")
    for name, cards in ways.items():
        check(
            all(np.array_equal(a, b) for a, b in zip(plain, run(name, cards))),
            name + ": other results",
        )


def end_of_energy():
    """ENDENG fails a run whose energy ratio leaves its band: Newmark's growth on impact."""
    options = dict(scheme="NEWMARK", nx=20, dt=1.0e-4)
    path = os.path.join(scenes.TMP, "end.k")
    scenes.make_bars.write(path, **options)
    lines = (
        open(path).read().replace("     &tend\n", "     &tend" + " " * 20 + "      50.0\n", 1)
    )
    folder, code, errors = run_text("ended", lines)
    check(
        code == 1 and "energy ratio" in errors and "step " in errors,
        "exit %d: %s" % (code, errors),
    )


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
