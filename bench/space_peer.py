#!/usr/bin/env python3
"""CalculiX (ccx) beside bipact in space, on the same meshes with the same steps: two bars end to
end, a quarter of a ball on a plate.  bench/space_peer.py

CalculiX as in peers.py: C3D8 with eight points, *DYNAMIC of Hilber, Hughes and Taylor with
its default alpha -0.05, increments of at most the step (it cuts them at impacts), surface to
surface contact by a linear penalty of 10 E/h, no friction. Without ccx its rows are left out."""

import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import startup
import numpy as np

import make_space
import peers
import tables

YOUNG, DENSITY = 1000.0, 1.0e-3
COLUMNS = (
    "scene  program                      steps      err   E end/E0 - 1  penetration     CPU s"
)


def bars_mesh(n=20):
    """Places and elements of both bars, the elements at the faces, nodes of the left end face."""
    gap = 0.02
    x, e = make_space.grid((n, 2, 2), lambda i, j, k: [10.0 * i / n, j / 2, k / 2])
    y = x + [10.0 + gap, 0.0, 0.0]
    return x, e, y, e, range(4 * (n - 1), 4 * n), range(4), range(9 * n, 9 * n + 9)


def bars_exact(t):
    return np.where(t < 0.01, t, np.where(t < 0.03, 0.01, 0.01 - (t - 0.03)))


def off(t, u):
    wanted = bars_exact(t)
    return float(np.sqrt(((u - wanted) ** 2).sum() / (wanted**2).sum()))


def bipact_bars(step, mass, program):
    """(error, energy, penetration, CPU) of the deck."""
    x, e, y, f, _, _, face = bars_mesh()
    out = make_space.head("bars", 0.04, step, mass) + make_space.NODE
    out += make_space.nodes(x) + make_space.nodes(y, 1001) + make_space.SOLID
    out += make_space.solids(e, 1, 1) + make_space.solids(f, 2, 1001, 1001)
    for number in (1, 2):
        out += make_space.part(number, "bar", 1, DENSITY, YOUNG, 0.0)
    out += make_space.VELOCITY + make_space.velocity(range(1, 1 + len(x)), [[1, 0, 0]] * len(x))
    out += make_space.velocity(range(1001, 1001 + len(y)), [[-1, 0, 0]] * len(y))
    out += make_space.contact(0.0) + make_space.history(1 + r for r in face)
    out += make_space.tables(step, "GLSTAT", "NODOUT", "SLEOUT")
    folder, cpu = run_bipact("\n".join(out + ["*END", ""]), program)
    with folder:
        nodes, energy, contact = read(folder, "nodout", "glstat", "sleout")
        t = np.unique(nodes["time"])
        u = nodes["ux"].reshape(len(t), -1).mean(axis=1)
        return (
            off(t, u),
            energy["total"][-1] / energy["total"][0] - 1.0,
            contact["penetration"].max(),
            cpu,
        )


def run_bipact(text, program):
    folder = tempfile.TemporaryDirectory()
    with open(os.path.join(folder.name, "run.k"), "w", encoding="ascii") as file:
        file.write(text)
    usage = peers.resource_of([program, "run.k", "-o", "out", "--quiet"], folder.name)
    if usage["code"]:
        raise SystemExit("bipact: " + usage["said"])
    return folder, usage["cpu"]


def read(folder, *names):
    return [tables.read_table(os.path.join(folder.name, "out", n + ".tab")) for n in names]


def ball_mesh():
    """(ball, its elements, plate, its elements, faces at the pole, step, end) of the deck
    input/space/ball_on_plate.k, whose numbers this reads."""
    path = os.path.join(startup.ROOT, "input", "space", "ball_on_plate.k")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    nodes, solids, keyword, step, end = {}, [], "", 0.0, 0.0
    for line in text.splitlines():
        if line.startswith("*"):
            keyword = line
        elif line.startswith("$"):
            continue
        elif keyword == "*NODE":
            nodes[int(line[:8])] = [float(line[k : k + 16]) for k in (8, 24, 40)]
        elif keyword == "*ELEMENT_SOLID":
            solids.append([int(line[k : k + 8]) for k in range(8, 80, 8)])
        elif keyword == "*CONTROL_TERMINATION":
            end = float(line)
        elif keyword == "*CONTROL_IMPLICIT_GENERAL":
            step = float(line[10:20])
    return text, nodes, solids, step, end


def calculix(nodes, elements, sets, surfaces, fixed, moves, poisson, size, step, end, watched):
    """The whole input."""
    stiff = peers.PENALTY * YOUNG / size
    out = ["*NODE, NSET=NALL"] + [
        "%d, %.12g, %.12g, %.12g" % ((i,) + tuple(p)) for i, p in nodes.items()
    ]
    out += ["*ELEMENT, TYPE=C3D8, ELSET=EALL"]
    out += ["%d, %s" % (k, ", ".join(map(str, e))) for k, e in enumerate(elements, 1)]
    for name, ids in sets.items():
        out += ["*NSET, NSET=" + name] + peers.listed(list(ids))
    for name, (cells, face) in surfaces.items():
        out += peers.surface(name, list(cells), face)
    out += ["*MATERIAL, NAME=M", "*ELASTIC", "%r, %r" % (YOUNG, poisson), "*DENSITY"]
    out += [
        "%r," % DENSITY,
        "*SOLID SECTION, ELSET=EALL, MATERIAL=M",
        "*SURFACE INTERACTION, NAME=I",
    ]
    out += [
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        "%r, %r" % (stiff, 1.0e-3 * YOUNG),
    ]
    out += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER"]
    out += (["*BOUNDARY"] + fixed) if fixed else []
    out += ["*INITIAL CONDITIONS, TYPE=VELOCITY"] + moves
    out += ["*STEP, INC=1000000", "*DYNAMIC, ALPHA=-0.05"]
    out += ["%r, %r, %r, %r" % (step, end, 1.0e-6 * step, step)]
    out += ["*NODE PRINT, NSET=%s, FREQUENCY=1" % watched, "U, V"]
    out += ["*EL PRINT, ELSET=EALL, TOTALS=ONLY, FREQUENCY=1", "ELSE, ELKE", "*END STEP", ""]
    return "\n".join(out)


def run_calculix(path, text):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "run.inp"), "w", encoding="ascii") as file:
            file.write(text)
        usage = peers.resource_of([path, "-i", "run"], folder)
        if usage["code"]:
            raise SystemExit("ccx: " + usage["said"])
        found = peers.read_blocks(os.path.join(folder, "run.dat"))
    t, u = peers.series(found["displacements"])
    energy = sum(peers.series(found[k])[1][:, 0, 0] for k in found if k.startswith("total"))
    return t, u, energy, usage["cpu"]


def calculix_bars(path, step):
    x, e, y, f, last, first, face = bars_mesh()
    nodes = {1 + k: p for k, p in enumerate(x)}
    nodes.update({1001 + k: p for k, p in enumerate(y)})
    elements = [[1 + n for n in c] for c in e] + [[1001 + n for n in c] for c in f]
    sets = {
        "LEFT": range(1, 1 + len(x)),
        "RIGHT": range(1001, 1001 + len(y)),
        "TIP": [1 + r for r in face] + [1001 + r for r in range(9)],
    }
    surfaces = {
        "SLAVE": ([1 + k for k in last], "S4"),
        "MASTER": ([len(e) + 1 + k for k in first], "S6"),
    }
    text = calculix(
        nodes,
        elements,
        sets,
        surfaces,
        [],
        ["LEFT, 1, 1.0", "RIGHT, 1, -1.0"],
        0.0,
        0.5,
        step,
        0.04,
        "TIP",
    )
    t, u, energy, cpu = run_calculix(path, text)
    even = step * np.arange(1, int(t[-1] / step + 1.5))
    left = u[:, u[0, :, 0] < 1000, 1].mean(axis=1)
    right = u[:, u[0, :, 0] > 1000, 1].mean(axis=1)
    return (
        off(even, np.interp(even, t, left)),
        energy[-1] / 0.01 - 1.0,
        (left - right - 0.02).max(),
        cpu,
    )


def ball(path, program):
    """Rows of both: the largest penetration is that of the poles, which meet node on node."""
    text, nodes, solids, step, end = ball_mesh()
    folder, cpu = run_bipact(
        text.replace("*DATABASE_GLSTAT", "*DATABASE_SLEOUT\n%r,\n*DATABASE_GLSTAT" % step),
        program,
    )
    with folder:
        energy, contact, parts = read(folder, "glstat", "sleout", "matsum")
        v = parts["vz"][parts["part"] == 1][-1]
        show(
            "ball",
            "bipact, THETA consistent",
            step,
            abs(v),
            energy["total"][-1] / energy["total"][0] - 1,
            contact["penetration"].max(),
            cpu,
        )
    if path is None:
        return
    elements = [s[1:] for s in solids]
    lowest = [k for k, s in enumerate(solids, 1) if s[0] == 1 and pole_face(nodes, s[1:5], 0)]
    top = [
        k
        for k, s in enumerate(solids, 1)
        if s[0] == 2 and all(abs(nodes[n][2]) < 1e-9 for n in s[5:9])
    ]
    of_ball = [i for i in nodes if i < 2001]
    plate = [i for i in nodes if i > 2000]
    far = [i for i in plate if max(nodes[i][:2]) > 2 - 1e-9 or nodes[i][2] < -2 + 1e-9]
    sets = {
        "BALL": of_ball,
        "FAR": far,
        "XS": [i for i in nodes if abs(nodes[i][0]) < 1e-9],
        "YS": [i for i in nodes if abs(nodes[i][1]) < 1e-9],
    }
    poles = [
        min(of_ball, key=lambda i: np.linalg.norm(nodes[i])),
        min(plate, key=lambda i: np.linalg.norm(nodes[i])),
    ]
    sets["SEEN"] = of_ball + poles[1:]
    fixed = ["XS, 1, 1", "YS, 2, 2", "FAR, 1, 3"]
    size = float(np.linalg.norm(np.subtract(nodes[solids[0][1]], nodes[solids[0][2]])))
    text = calculix(
        nodes,
        elements,
        sets,
        {"SLAVE": (lowest, "S1"), "MASTER": (top, "S2")},
        fixed,
        ["BALL, 3, -1.0"],
        0.3,
        size,
        step,
        end,
        "SEEN",
    )
    t, u, energy, cpu = run_calculix(path, text)
    order = {int(k): c for c, k in enumerate(u[0, :, 0])}
    down = u[:, order[poles[1]], 3] - u[:, order[poles[0]], 3] - 1.0e-3
    mass = masses(nodes, solids)
    middle = sum(m * u[:, order[n], 3] for n, m in mass.items()) / sum(mass.values())
    speed = abs(middle[-1] - middle[-11]) / (t[-1] - t[-11])
    show(
        "ball",
        "CalculiX",
        step,
        speed,
        energy[-1] / (0.5 * sum(mass.values())) - 1,
        down.max(),
        cpu,
    )


def pole_face(nodes, corners, axis):
    """Is a face of the ball one of those that look at the plate, on the sphere?"""
    at = np.array([nodes[n] for n in corners]) - [0.0, 0.0, 1.0 + 1.0e-3]
    return bool(
        np.all(np.abs(np.linalg.norm(at, axis=1) - 1.0) < 1e-3) and at[:, 2].max() < 0.0
    )


def masses(nodes, solids):
    """{node: mass} of the ball, an eighth of each of its hexahedra, whose volume is summed over
    eight points."""
    found, g = {}, 1 / np.sqrt(3)
    signs = np.array(
        [
            [-1, -1, -1],
            [1, -1, -1],
            [1, 1, -1],
            [-1, 1, -1],
            [-1, -1, 1],
            [1, -1, 1],
            [1, 1, 1],
            [-1, 1, 1],
        ]
    )
    for s in solids:
        if s[0] != 1:
            continue
        x = np.array([nodes[n] for n in s[1:]])
        for p in signs * g:
            dn = np.array(
                [
                    signs[:, d]
                    / 8
                    * np.prod([1 + signs[:, o] * p[o] for o in range(3) if o != d], axis=0)
                    for d in range(3)
                ]
            )
            for n in s[1:]:
                found[n] = found.get(n, 0.0) + DENSITY * abs(np.linalg.det(dn @ x)) / 8.0
    return found


def show(scene, program, step, err, energy, penetration, cpu):
    print(
        "%-6s %-28s %8.2e %8.1e %14.1e %12.1e %9.2f"
        % (scene, program, step, err, energy, penetration, cpu)
    )


def main():
    program = startup.program()
    path, version = peers.installed()
    if path is None:
        print("no ccx (CalculiX) is installed: its rows are left out")
    print(COLUMNS)
    for step, mass in ((5.0e-4, "DISPERSION"), (2.5e-4, "CONSISTENT"), (5.0e-5, "CONSISTENT")):
        show("bars", "bipact, THETA " + mass.lower(), step, *bipact_bars(step, mass, program))
    for step in (2.5e-4, 5.0e-5) if path else ():
        show("bars", "CalculiX " + version, step, *calculix_bars(path, step))
    print("ball: err is the speed of the ball at the end (Hertz: nearly 1)")
    ball(path, program)
    return 0


if __name__ == "__main__":
    sys.exit(main())
