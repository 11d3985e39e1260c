"""Forms of solids and masses in space: error against run time on two bars, the tube that spins on a
wall and Hertz's ball, and the rebound of a ball that is thrown obliquely (Maw, Barber & Fawcett 1976).
Part of make report: space.md, space.csv, space.png."""

import csv
import itertools
import math
import os
import statistics
import tempfile

import common
import numpy as np
import solid_forms
import tables
from make_space import graded, grid

ELFORM = {
    "HEX8": 1,
    "HEX8MEAN": 2,
    "HEX8MODE": -1,
    "WEDGE6": 15,
    "TET4": 10,
    "TET10": 16,
    "HEX27": 24,
}
MASSES = ("CONSISTENT", "LUMPED", "DISPERSION")
N = {"bars": (10, 20, 40), "tube": (20, 40, 80), "ball": (1, 2, 3)}
# Of the ball: cells from the pole to the side and from foot to top, and how they grow; the last one
# for slow impacts, whose contact is small.
BALL = {1: (5, 1.6, 8, 1.5), 2: (7, 1.45, 11, 1.38), 3: (10, 1.33, 15, 1.28)}
BALL.update({4: (10, 1.5, 15, 1.4), 5: (10, 1.6, 15, 1.5)})
# Angle of incidence psi_1 and of rebound psi_2 of solid spheres with PR .3: the model of reduced
# dimensions, converged to 1e-4.
MAW = {
    0.25: 0.042,
    0.5: 0.048,
    1.0: -0.060,
    1.5: -0.428,
    2.0: -0.837,
    2.5: -1.162,
    3.0: -1.380,
    3.5: -1.477,
    4.0: -1.437,
    4.7647: -1.000,
    5.2: -0.565,
}
MU, POISSON, YOUNG, DENSITY = 0.3, 0.3, 1000.0, 1.0e-3
# Speed of the thrown ball on its meshes: theory is that of half spaces, contact small in the ball.
SPEED = {4: 0.1, 5: 0.02}
MEASURES = ("err", "force", "energy")
COLUMNS = "scene form mass redist n courant".split() + list(MEASURES) + ["psi", "cpu", "failed"]


def tasks(size):
    """All runs as dictionaries."""
    pick = slice(0, 1) if size == "quick" else slice(0, 2) if size == "reduced" else slice(0, 3)
    for form, mass, n, courant in itertools.product(
        ELFORM, MASSES, N["bars"][pick], (0.5, 1.0)
    ):
        if mass == "DISPERSION" and form[:4] != "HEX8" or size == "quick" and courant < 1.0:
            continue
        for redist in (0, 1)[: 1 if size == "quick" else 2]:
            if not (redist and form in ("TET10", "HEX27")):
                yield task("bars", form, mass, redist, n, courant)
    for form, mass, n in itertools.product(
        ("HEX8", "HEX8MEAN", "HEX8MODE"), MASSES, N["tube"][pick]
    ):
        yield task("tube", form, mass, 0, n, 1.0)
    for form, n in itertools.product(
        ("HEX8", "HEX8MEAN", "HEX8MODE", "TET4", "TET10", "HEX27"), N["ball"][pick]
    ):
        if n == 3 and form in ("TET10", "HEX27") or size == "quick" and form[:4] != "HEX8":
            continue
        for mass in ("CONSISTENT", "LUMPED"):
            yield task("ball", form, mass, 0, n, 0.0)
    for n, psi in itertools.product(SPEED, list(MAW)):
        if size == "full" or (n == 4 and psi == 5.2 and size == "reduced"):
            yield dict(task("maw", "HEX8", "CONSISTENT", 0, n, 0.0), psi=psi)


def task(scene, form, mass, redist, n, courant):
    return dict(scene=scene, form=form, mass=mass, redist=redist, n=n, courant=courant)


def key(run):
    return "|".join(["space"] + [str(run.get(k, "")) for k in COLUMNS[:6] + ["psi"]])


# ---------------------------------------------------------------- decks


def mesh(form, counts, place):
    """(places, elements) of a grid; place(i, j, k) takes halves for nodes between corners of
    hexahedra; those of tetrahedra, which would turn inside out in a ball, stay straight."""
    at, elements = grid(counts, lambda i, j, k: [i, j, k])
    if form[:3] == "TET":
        elements = solid_forms.split(elements)
    if form == "WEDGE6":
        elements = solid_forms.wedges(elements)
    if form == "HEX27":
        at, elements = solid_forms.with_middles(at, elements)
    x = np.array([place(*p) for p in at])
    return solid_forms.with_middles(x, elements) if form == "TET10" else (x, elements)


def body(x, elements, number, form, v, young=YOUNG, density=DENSITY, poisson=0.0):
    """Cards of a body with velocities (n, 3) of its nodes."""
    first = 1 + 100000 * (number - 1)
    out = ["*NODE"] + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(x)]
    out += solid_forms.cards(elements, number, first, first)
    out += ["*PART", form, "%d,%d,%d" % (number, number, number), "*SECTION_SOLID"]
    out += ["%d,%d" % (number, ELFORM[form]), "*MAT_ELASTIC"]
    out += ["%d,%r,%r,%r" % (number, density, young, poisson), "*INITIAL_VELOCITY_NODE"]
    return out + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(v)]


def deck(run, lines, step, end, *names):
    out = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % end, "*CONTROL_IMPLICIT_GENERAL"]
    out += ["1,%r" % step, "*CONTROL_IMPLICIT_DYNAMICS", "1,", "*BIPACT_TIME", "THETA,0.5"]
    out += ["*BIPACT_MASS", "%s,%d" % (run["mass"], run["redist"])] + lines
    for name in names:
        out += ["*DATABASE_" + name, "%r," % step]
    return "\n".join(out + ["*END", ""])


def held(number, ids, directions):
    """A set of nodes and its supports."""
    out = ["*SET_NODE_LIST", "%d," % number] + ["%d," % i for i in ids]
    return out + ["*BOUNDARY_SPC_SET", "%d,,%s" % (number, directions)]


def plane(mu):
    return ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,0.0,1.0,%r" % mu]


def bars(run):
    """Two bars of 10 x 1 x 1, 2 x 2 elements a section, that touch in mid-step; PR 0."""
    n = run["n"]
    step = run["courant"] * 10.0 / n / 1000.0
    touch = (round(0.01 / step) + 0.5) * step
    x, e = mesh(run["form"], (n, 2, 2), lambda i, j, k: [10.0 * i / n, j / 2, k / 2])
    y = x + [10.0 + 2.0 * touch, 0.0, 0.0]
    lines = body(x, e, 1, run["form"], np.tile([1.0, 0.0, 0.0], (len(x), 1)))
    lines += body(y, e, 2, run["form"], np.tile([-1.0, 0.0, 0.0], (len(x), 1)))
    lines += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,3,3", "%r," % MU]
    lines += ["*DATABASE_HISTORY_NODE"]
    lines += ["%d," % (1 + k) for k, p in enumerate(x) if p[0] > 10.0 - 1.0e-9]
    end = round((touch + 0.03) / step) * step
    return deck(run, lines, step, end, "GLSTAT", "NODOUT", "RCFORC"), touch


def judge_bars(run, folder, touch):
    rows, force = (tables.read_run(folder, t) for t in ("nodout", "rcforc"))
    t = np.unique(rows["time"])
    u = rows["ux"].reshape(len(t), -1).mean(axis=1)
    exact = np.where(t < touch, t, np.where(t < touch + 0.02, touch, 2.0 * touch + 0.02 - t))
    side = force["side"] == 1
    t, f = force["time"][side][2:], np.abs(force["fmx"][side][2:])
    dt = t[1] - t[0]
    inside = (t - 2.0 * dt > touch) & (t < touch + 0.02)
    return {
        "err": math.sqrt(((u - exact) ** 2).sum() / (exact**2).sum()),
        "force": np.abs(f[inside] - 1.0).mean(),
        "energy": energy(folder),
    }


def energy(folder):
    """Change of the energy with what friction took."""
    rows = tables.read_run(folder, "glstat")
    return abs((rows["total"][-1] + rows["friction"][-1]) / rows["total"][0] - 1.0)


def tube(run):
    """The tube of input/space, n elements along it."""
    n, corners, inner, outer, length, scale = run["n"], 16, 0.9, 1.1, 4.0, 1.0e-3

    def place(k, ring, a):
        r, angle = (inner, outer)[ring], 2.0 * math.pi * a / corners
        return [r * math.cos(angle), r * math.sin(angle), length * k / n]

    x = np.array([place(k, r, a) for k in range(n + 1) for r in (0, 1) for a in range(corners)])
    around = [(a, (a + 1) % corners) for a in range(corners)]
    e = [
        [
            (m * 2 + r) * corners + c
            for m in (k, k + 1)
            for c, r in ((a, 0), (a, 1), (b, 1), (b, 0))
        ]
        for k in range(n)
        for a, b in around
    ]
    v = scale * (np.cross([0.0, 0.0, 1.0], x) - [0.0, 0.0, 1.0])
    step = length / n
    lines = body(x, e, 1, run["form"], v, 1.0, 1.0) + plane(MU)
    area = 0.5 * corners * math.sin(2.0 * math.pi / corners) * (outer**2 - inner**2)
    lever = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2)
    loss = 8.0 * MU * scale * area * lever
    return deck(run, lines, step, (2 * n + 20) * step, "GLSTAT", "RWFORC"), (scale * area, loss)


def judge_tube(run, folder, data):
    force, loss = data
    found = tables.read_run(folder, "glstat")
    rows = tables.read_run(folder, "rwforc")
    t = rows["time"]
    inside = (t > 0.3) & (t < 7.9)
    two = 0.5 * (rows["fz"][1:] + rows["fz"][:-1])[inside[1:] & inside[:-1]]
    return {
        "err": abs((found["angz"][0] - found["angz"][-1]) / loss - 1.0),
        "force": np.abs(two / force - 1.0).mean(),
        "energy": energy(folder),
    }


def sphere(n, half):
    """(counts, place) of a ball of radius 1 above z = 0; half: y >= 0, else a quarter."""
    across, growth, up, growth_up = BALL[n]
    side, height = graded(across, growth), graded(up, growth_up)

    def between(values, i):
        return np.sign(i) * np.interp(abs(i), range(len(values)), values)

    def place(i, j, k):
        a = between(side, i - across if half else i)
        b, c = between(side, j), 2.0 * between(height, k) - 1.0
        q = [
            p * math.sqrt(max(0.0, 1.0 - r * r / 2.0 - s * s / 2.0 + r * r * s * s / 3.0))
            for p, r, s in ((a, b, c), (b, a, c), (c, a, b))
        ]
        return [q[0], q[1], q[2] + 1.0 + 1.0e-5]

    return (2 * across if half else across, across, up), place


def hertz(speed=1.0, steps=2000):
    """Hertz's impact on a rigid plane: (duration, times, forces)."""
    stiff, mass = YOUNG / (1.0 - POISSON**2), DENSITY * 4.0 / 3.0 * math.pi
    time = 2.86827 * (mass**2 / (stiff**2 * speed)) ** 0.2
    h, deep, forces = time / steps, 0.0, []
    for _ in range(steps + 1):  # Stoermer and Verlet
        forces.append(4.0 / 3.0 * stiff * max(deep, 0.0) ** 1.5)
        speed -= 0.5 * h * forces[-1] / mass
        deep += h * speed
        speed -= 0.5 * h * 4.0 / 3.0 * stiff * max(deep, 0.0) ** 1.5 / mass
    return time, h * np.arange(steps + 1), np.array(forces)


def ball(run):
    """A quarter of a ball falls on a rigid plane."""
    time = hertz()[0]
    counts, place = sphere(run["n"], False)
    x, e = mesh(run["form"], counts, place)
    v = np.tile([0.0, 0.0, -1.0], (len(x), 1))
    lines = body(x, e, 1, run["form"], v, poisson=POISSON) + plane(0.0)
    for axis, word in enumerate(("1,0,0", "0,1,0")):
        lines += held(axis + 1, [1 + k for k, p in enumerate(x) if abs(p[axis]) < 1e-9], word)
    step = time / 300.0
    return deck(run, lines, step, 1.2 * time, "GLSTAT", "RWFORC"), None


def judge_ball(run, folder, _):
    time, t, f = hertz()
    rows = tables.read_run(folder, "rwforc")
    exact = np.interp(rows["time"] - 1.0e-5, t, f, right=0.0)
    window = np.ones(8) / 8.0  # of the chatter of nodes
    found = np.convolve(4.0 * np.abs(rows["fz"]), window, "same")
    exact = np.convolve(exact, window, "same")
    return {
        "err": math.sqrt(((found - exact) ** 2).sum() / (exact**2).sum()),
        "force": abs(found.max() / exact.max() - 1.0),
        "energy": energy(folder),
    }


def incidence(run):
    """Tangential speed of an angle psi_1."""
    return SPEED[run["n"]] * run["psi"] * MU * (2.0 - POISSON) / (2.0 * (1.0 - POISSON))


def maw(run):
    """Half a ball is thrown at a rigid plane, at the angle psi_1."""
    time = hertz(SPEED[run["n"]])[0]
    counts, place = sphere(run["n"], True)
    x, e = mesh(run["form"], counts, place)
    v = np.tile([incidence(run), 0.0, -SPEED[run["n"]]], (len(x), 1))
    lines = body(x, e, 1, run["form"], v, poisson=POISSON) + plane(MU)
    lines += held(2, [1 + k for k, p in enumerate(x) if abs(p[1]) < 1e-9], "0,1,0")
    return deck(run, lines, time / 300.0, 1.2 * time, "GLSTAT"), gyration(x, e)


def gyration(x, elements):
    """(height of the centre of mass, square of the radius of gyration about y) of hexahedra: of the
    mesh, which is no whole ball."""
    corner = np.array(elements)
    ends = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]] * 2)
    ends[4:, 2] = 1
    weights, places = [], []
    for q in ends / math.sqrt(3.0):
        f = 0.5 * (1.0 + ends * q)
        d = [0.5 * ends[:, i] * np.prod(np.delete(f, i, axis=1), axis=1) for i in range(3)]
        jacobian = np.einsum("eki,kj->eij", x[corner], np.transpose(d))
        weights.append(np.linalg.det(jacobian))
        places.append(np.einsum("eki,k->ei", x[corner], np.prod(f, axis=1)))
    w, p = np.concatenate(weights), np.concatenate(places)
    middle = (w @ p[:, 2]) / w.sum()
    return middle, w @ (p[:, 0] ** 2 + (p[:, 2] - middle) ** 2) / w.sum()


def judge_maw(run, folder, data):
    """psi_2 of the point of contact, from momentum and angular momentum about the middle."""
    middle, square = data
    rows = tables.read_run(folder, "glstat")
    mass = rows["momx"][0] / incidence(run)
    spin = (rows["angy"][-1] - middle * rows["momx"][-1]) / (square * mass)
    found = run["psi"] * (rows["momx"][-1] / mass - middle * spin) / incidence(run)
    return {"err": abs(found - MAW[run["psi"]]), "force": found, "energy": energy(folder)}


SCENES = {"bars": (bars, judge_bars), "tube": (tube, judge_tube), "ball": (ball, judge_ball)}
SCENES["maw"] = (maw, judge_maw)


def measure(run, scenes=None):
    """One run: its line of results; the time is that without tables, the median of three."""
    write_deck, judge = (scenes or SCENES)[run["scene"]]
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "run.k"), os.path.join(folder, "out")
        text, data = write_deck(run)
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        done = common.run(path, out, limit=900)
        if done["code"] != 0:
            said = done["errors"].replace(folder + "/", "").splitlines() or ["no word"]
            reason = next((x for x in said if not x.startswith("WARNING")), said[0])
            return dict(run, failed="exit %s: %s" % (done["code"], reason))
        found = {k: float(v) for k, v in judge(run, out, data).items()}
        silent = common.without_tables(path)
        times = [common.run(silent, out)["cpu"] for _ in range(3 if done["cpu"] < 2.0 else 1)]
        return dict(run, cpu=statistics.median(times), **found)


def study(store, size, jobs):
    """All lines of results; those that the store has are not made again."""
    wanted = list(tasks(size))
    found = common.sweep(measure, wanted, key, store, jobs)
    return [found[key(run)] for run in wanted]


# ---------------------------------------------------------------- pages


def radius(n):
    """Half width of the contact of the thrown ball over its radius."""
    stiff, mass = YOUNG / (1.0 - POISSON**2), DENSITY * 4.0 / 3.0 * math.pi
    return (15.0 * mass * SPEED[n] ** 2 / (16.0 * stiff)) ** 0.2


HOW = {
    "bars": """Two bars of 10 x 1 x 1, PR 0, sections of 2 x 2 cells (six tetrahedra or two wedges a cell),
friction .3, touch in mid-step; n cells along each, Courant number of a cell. `err`: displacement of
the face in the mean square, relative; `force`: of two steps, inside the contact, over rho c v A;
`energy`: change of the energy. * massless contact nodes.""",
    "tube": """The tube of input/space that spins onto a wall, mu .3, all of the foot slips: `err` is
that of the loss of angular momentum, `force` of the normal force of two steps.""",
    "ball": """A quarter of a ball falls on a rigid plane at speed 1 (contact .08 of the radius), 300
steps a contact: `err` is that of the force over time against Hertz, in the mean square, relative, means
of eight steps; `force` that of its largest value. Meshes 1 to 3 have a/h = 1.3, 2.2, 4 at the pole. Hertz is
the theory of slow impacts of half spaces: some per cent of every error are that.""",
    "maw": """A ball is thrown at a rigid plane with friction .3; PR .3. psi_1 = 2 (1 - nu)/(mu (2 - nu)) V_t/V_n before,
psi_2 the same of the point of contact after, from momentum and angular momentum. The theory (Maw,
Barber & Fawcett 1976; here the model of reduced dimensions) is for contacts that are small in the
ball: at two speeds, and what a line through both finds for a contact of no width.""",
}


def cell(value, form="%.1e"):
    return "-" if value is None else form % value


def table(results, scene):
    lines = ["| form | mass | n | Courant | err | force | energy | CPU s |", "|---" * 8 + "|"]
    for r in results:
        if r["scene"] != scene:
            continue
        mass = r["mass"] + ("*" if r["redist"] else "")
        cells = [r["form"], mass, str(r["n"]), cell(r["courant"] or None, "%g")]
        if "failed" in r:
            cells += [r["failed"][:70].replace("|", "/"), "", "", ""]
        else:
            cells += [cell(r[k]) for k in MEASURES] + [cell(r["cpu"], "%.3f")]
        lines.append("| %s |" % " | ".join(cells))
    return lines + [""]


def rebound(results):
    """{psi_1: {n: psi_2}}."""
    found = {}
    for r in results:
        if r["scene"] == "maw" and "failed" not in r:
            found.setdefault(r["psi"], {})[r["n"]] = r["force"]
    return found


def limit(of):
    """A line through the figures of both speeds, at a contact of no width; None with one of them."""
    if len(of) < 2:
        return None
    a, b = radius(4), radius(5)
    return of[5] + (of[5] - of[4]) * b / (a - b)


def maw_table(results):
    lines = [
        "| psi_1 | theory | %s | limit |"
        % " | ".join("V %g, a/R %.3f" % (SPEED[n], radius(n)) for n in SPEED)
    ]
    lines.append("|---" * 5 + "|")
    for psi, of in rebound(results).items():
        cells = ["%g" % psi, "%.3f" % MAW[psi]] + [cell(of.get(n), "%.3f") for n in SPEED]
        lines.append("| %s | %s |" % (" | ".join(cells), cell(limit(of), "%.3f")))
    return lines + [""]


def best_lines(results):
    """For each scene and form the least error and what it takes."""
    lines = ["| scene | form | least err | with | CPU s |", "|---" * 5 + "|"]
    for scene in N:
        for form in ELFORM:
            runs = [
                r for r in results if (r["scene"], r["form"]) == (scene, form) and "err" in r
            ]
            if runs:
                best = min(runs, key=lambda r: r["err"])
                words = best["mass"] + ("*" if best["redist"] else "") + ", n %d" % best["n"]
                words += ", Courant %g" % best["courant"] if best["courant"] else ""
                cells = (scene, form, cell(best["err"]), words, cell(best["cpu"], "%.3f"))
                lines.append("| %s | %s | %s | %s | %s |" % cells)
    return lines + [""]


def write_page(results, command, out):
    """space.md."""
    failed = sum("failed" in r for r in results)
    lines = ["# Forms of solids and masses in space: error against run time", ""]
    lines += [
        "%s, %s. THETA 1/2. %d runs, %d failed. Processor time is user + system of the whole process, "
        "tables off, median of three (of runs beyond two seconds: one). Made by `%s` (SPACE=1: this page alone); "
        "every run: [space.csv](space.csv)."
        % (common.today(), common.machine(), len(results), failed, command),
        "",
    ]
    lines += best_lines(results) + ["![error over run time, rebound](space.png)", ""]
    titles = {"bars": "Two bars", "tube": "A tube that spins on a wall", "ball": "Hertz's ball"}
    for scene, title in titles.items():
        lines += ["## " + title, "", HOW[scene], ""] + table(results, scene)
    lines += ["## Rebound of a thrown ball", "", HOW["maw"], ""] + maw_table(results)
    with open(os.path.join(out, "space.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def write_csv(results, out):
    with open(os.path.join(out, "space.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for r in results:
            writer.writerow(
                {k: "%.4g" % v if isinstance(v, float) else v for k, v in r.items()}
            )


COLOUR = dict(
    zip(ELFORM, ("#000000", "#0072B2", "#D55E00", "#CC79A7", "#E69F00", "#56B4E9", "#009E73"))
)
LOOK = {"CONSISTENT": "o-", "LUMPED": "s--", "DISPERSION": "^:"}


def draw(results, out):
    """space.png: error over run time of three scenes, and the curve of rebounds."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, grid_of = plt.subplots(2, 2, figsize=(11.5, 9.0))
    for axes, (scene, title) in zip(
        grid_of.flat,
        (("bars", "two bars, Courant 1/2"), ("tube", "tube"), ("ball", "ball, against Hertz")),
    ):
        for (form, colour), (mass, look) in itertools.product(COLOUR.items(), LOOK.items()):
            own = [
                r
                for r in results
                if (r["scene"], r["form"], r["mass"], r["redist"]) == (scene, form, mass, 0)
                and "err" in r
                and not (scene == "bars" and r["courant"] == 1.0)
            ]
            if own:
                label = "%s %s" % (form, mass[0])
                axes.loglog(
                    [r["cpu"] for r in own],
                    [max(r["err"], 1e-15) for r in own],
                    look,
                    color=colour,
                    ms=4,
                    lw=1.2,
                    label=label,
                )
        axes.set(xlabel="processor time [s]")
        axes.set_title(title, loc="left", fontsize=10)
        axes.grid(True, which="both", alpha=0.2)
        axes.legend(fontsize=6, ncol=2)
    axes = grid_of.flat[3]
    axes.plot(list(MAW), list(MAW.values()), "k-", lw=1.2, label="theory")
    found = rebound(results)
    for n, look in zip(SPEED, ("s", "^")):
        own = [(psi, of[n]) for psi, of in found.items() if n in of]
        axes.plot(
            *zip(*own) if own else ([], []),
            look,
            ms=5,
            mfc="none",
            label="V %g, a/R %.3f" % (SPEED[n], radius(n))
        )
    ends = [(psi, limit(of)) for psi, of in found.items() if limit(of) is not None]
    if ends:
        axes.plot(*zip(*ends), "o", ms=5, color="#D55E00", label="contact of no width")
    axes.set(xlabel="psi_1", ylabel="psi_2")
    axes.set_title("rebound of a thrown ball", loc="left", fontsize=10)
    axes.grid(True, alpha=0.2)
    axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(os.path.join(out, "space.png"), dpi=80)
    plt.close(figure)


def write(results, command, out):
    write_csv(results, out)
    draw(results, out)
    write_page(results, command, out)
