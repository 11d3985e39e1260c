"""Forces of a step and schemes at finite deformation: error against run time on a bar whose
impact is known and on the rubber disc that bounces off a floor. Part of make report: finite.md,
finite.csv, finite.png."""

import csv
import functools
import itertools
import json
import math
import os
import tempfile

import common
import make_finite
import numpy as np
import space_forms
import tables
from space_forms import cell

# Name: (scheme of *BIPACT_TIME, FORCE of *BIPACT_KINEMATICS).
FORCES = {
    "EMC": ("THETA,0.5", "EMC"),
    "PAPER": ("THETA,0.5", "PAPER"),
    "MIDPOINT": ("THETA,0.5", "MIDPOINT"),
    "NEWMARK": ("NEWMARK,", ""),
    "PAOLI 0": ("PAOLI,,,,,,0.0", ""),
}
N = {"bar": (25, 50, 100), "disc": (4, 8, 16)}
COURANT = {"bar": (0.25, 0.5, 1.0, 2.0), "disc": (0.25, 0.5, 1.0, 2.0)}
EXPLICIT = {"bar": (0.25, 0.5, 0.9), "disc": (0.125, 0.25, 0.5)}
SPEED = 0.1  # of the bar, of its wave
SHEAR, POISSON, DENSITY, FALL, END = 1000.0, 0.3, 1.0e-3, 200.0, 6.0e-3
WAVE = math.sqrt(SHEAR * 2.0 * (1.0 - POISSON) / (1.0 - 2.0 * POISSON) / DENSITY)
# (elements across the disc, Courant number) of its reference.
FINE = {"full": (32, 0.125), "reduced": (32, 0.125), "quick": (8, 0.25)}
MEASURES = ("err", "force", "energy", "rise")
COLUMNS = "scene form mass n courant".split() + list(MEASURES) + ["cpu", "failed"]


def tasks(size):
    """All runs as dictionaries: EMC with both masses, the others lumped."""
    pick = {"quick": 1, "reduced": 2, "full": 3}[size]
    for scene, form in itertools.product(N, FORCES):
        numbers = (EXPLICIT if form == "PAOLI 0" else COURANT)[scene]
        for n, courant in itertools.product(N[scene][:pick], numbers):
            if size == "quick" and courant != numbers[1]:
                continue
            for mass in ("LUMPED", "CONSISTENT")[: 2 if form == "EMC" else 1]:
                yield dict(scene=scene, form=form, mass=mass, n=n, courant=courant, redist=0)


def key(run):
    return "|".join(["finite"] + [str(run[k]) for k in COLUMNS[:5]])


# ---------------------------------------------------------------- the bar


def wave(stretch):
    """Speed of a wave in the reference, over that of small strain: P = (l^3 - l)/2."""
    return np.sqrt((3.0 * stretch**2 - 1.0) / 2.0)


@functools.lru_cache
def behind(speed):
    """The stretch behind the wave: speed is the integral of wave from it to 1."""
    points, weights = np.polynomial.legendre.leggauss(20)
    low, high = 1.0 / math.sqrt(3.0), 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        half = 0.5 * (1.0 - middle)
        given = half * (weights @ wave(middle + half * (1.0 + points)))
        low, high = (middle, high) if given > speed else (low, middle)
    return middle


def exact_stretch(place, time, speed=SPEED):
    """The stretch at a distance from the touching face, in the reference, at a time after
    it."""
    least = behind(speed)
    ratio = np.clip(place / time, wave(least), 1.0)
    return np.sqrt((2.0 * ratio**2 + 1.0) / 3.0)


def control(run, step, end, *names):
    """Cards of a run without its bodies."""
    scheme, force = FORCES[run["form"]]
    out = ["*KEYWORD", "*CONTROL_TERMINATION", "%r," % end, "*CONTROL_IMPLICIT_GENERAL"]
    out += ["1,%r" % step, "*CONTROL_IMPLICIT_DYNAMICS", "1,", "*BIPACT_TIME", scheme]
    out += ["*CONTROL_IMPLICIT_SOLUTION", "12,", "*BIPACT_MASS", run["mass"] + ","]
    out += ["*BIPACT_KINEMATICS", force + ","] if force else []
    for name in names:
        out += ["*DATABASE_" + name, "%r," % step]
    return out


def bar(run):
    """A bar of length 1, E = rho = 1, PR 0, that meets a wall after three and a half steps.
    Motion across is held: a slender bar would buckle."""
    n = run["n"]
    step = run["courant"] / n
    touch = 3.5 * step
    x, e = make_finite.quadrilaterals(n, 1, lambda i, j: (-1.0 - touch * SPEED + i / n, j / n))
    lines = control(run, step, touch + 2.0, "GLSTAT", "RWFORC", "NODOUT")
    lines += make_finite.shells(x, e)
    lines += make_finite.part(1, "bar", ["*MAT_ELASTIC", "1,1.0,1.0,0.0"])
    lines += ["*INITIAL_VELOCITY", "0,", "%r,0.0" % SPEED]
    lines += ["*SET_NODE_GENERAL", "9,", "ALL,", "*BOUNDARY_SPC_SET", "9,,0,1"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,-1.0,0.0,0.0,0.0"]
    low = [k for k in range(len(x)) if x[k, 1] == 0.0]
    lines += ["*DATABASE_HISTORY_NODE"] + ["%d," % (1 + k) for k in low]
    return "\n".join(lines + ["*END", ""]), touch


def judge_bar(run, folder, touch):
    """err: stretches of the elements .9 of a crossing after the touch, in the mean square, over
    the strain behind the wave. force: of two steps, in the mean square."""
    n, least = run["n"], behind(SPEED)
    nodes, force, energy = (tables.read_run(folder, t) for t in ("nodout", "rwforc", "glstat"))
    times = np.unique(nodes["time"])
    x = nodes["x"].reshape(len(times), -1)
    x = x[:, np.argsort(x[0])]
    at = int(np.argmin(np.abs(times - touch - 0.9)))
    place = 1.0 - (np.arange(n) + 0.5) / n
    off = n * np.diff(x[at]) - exact_stretch(place, times[at] - touch)
    step = times[1] - times[0]
    f, wanted = np.abs(force["fn"]) * n, 0.5 * (least - least**3)
    two, t = 0.5 * (f[1:] + f[:-1]), 0.5 * (force["time"][1:] + force["time"][:-1])
    inside = (t > touch + 4.0 * step) & (t < touch + 2.0 - 8.0 * step)
    found = {"err": math.sqrt((off**2).mean()) / (1.0 - least)}
    found["force"] = math.sqrt(((two[inside] / wanted - 1.0) ** 2).mean())
    return dict(found, **kept(energy))


def kept(energy):
    """Change of the energy in the run, its largest rise above the start."""
    total = energy["total"] / energy["total"][0]
    return {"energy": abs(total[-1] - 1.0), "rise": (total - 1.0).max()}


# ---------------------------------------------------------------- the disc


def disc(run):
    """The disc of input/finite; a Courant number of an edge 2/n and waves of pressure."""
    n = run["n"]
    steps = math.ceil(END / (run["courant"] * 2.0 / n / WAVE))
    x, e = make_finite.disc(n, (0.0, 1.01))
    lines = control(run, END / steps, END, "GLSTAT", "MATSUM", "RWFORC")
    lines += make_finite.shells(x, e)
    law = make_finite.NEO_HOOKE + ["1,%r,%r" % (DENSITY, POISSON), "%r," % (SHEAR / 2.0)]
    lines += make_finite.part(1, "disc", law)
    lines += ["*INITIAL_VELOCITY", "0,", "0.0,%r" % -FALL] + make_finite.floor(0.0)
    return "\n".join(lines + ["*END", ""]), None


def history(folder):
    """Times, velocity of the centre, impulse of the floor over the momentum at the start."""
    parts, force = tables.read_run(folder, "matsum"), tables.read_run(folder, "rwforc")
    impulse = np.abs(force["iy"]) / (parts["mass"][0] * FALL)
    return parts["time"], parts["vy"] / FALL, np.interp(parts["time"], force["time"], impulse)


def judge_disc(reference, run, folder, _):
    """err: velocity of the centre, mean over time of what it is off. force: impulse at the
    end."""
    energy = tables.read_run(folder, "glstat")
    t, v, impulse = history(folder)
    wanted = np.interp(t, reference["time"], reference["v"])
    found = kept(energy)
    found.update(err=np.abs(v - wanted).mean())
    found.update(force=abs(impulse[-1] / reference["impulse"][-1] - 1.0))
    return found


def fine_disc(store, size):
    """History of the reference, made once."""
    n, courant = FINE[size]
    path = os.path.join(store, "finite_disc_%d.json" % n)
    if not os.path.exists(path):
        run = dict(form="EMC", mass="LUMPED", n=n, courant=courant)
        with tempfile.TemporaryDirectory() as folder:
            deck, out = os.path.join(folder, "fine.k"), os.path.join(folder, "out")
            with open(deck, "w", encoding="ascii") as file:
                file.write(disc(run)[0])
            done = common.run(deck, out)
            if done["code"] != 0:
                raise SystemExit("the fine reference failed: " + done["errors"])
            found = dict(zip(("time", "v", "impulse"), (x.tolist() for x in history(out))))
        with open(path, "w", encoding="utf-8") as file:
            json.dump(found, file)
    with open(path, encoding="utf-8") as file:
        return {k: np.array(v) for k, v in json.load(file).items()}


def study(store, size, jobs):
    """All lines of results; those that the store has are not made again."""
    reference = fine_disc(store, size)
    scenes = {"bar": (bar, judge_bar)}
    scenes["disc"] = (disc, functools.partial(judge_disc, reference))
    work = functools.partial(space_forms.measure, scenes=scenes)
    wanted = list(tasks(size))
    found = common.sweep(work, wanted, key, store, jobs)
    return [found[key(run)] for run in wanted]


# ---------------------------------------------------------------- pages

HOW = {
    "bar": """A bar of St Venant and Kirchhoff's law, PR 0, n elements along it and one across,
meets a wall at v/c = .1. The law softens in compression, so that the wave is a simple one and
known: the stretch behind it is .890885, the stress of contact .0919057 E until it is back.
`err`: stretches of all elements when the wave has gone .9 of the bar, its fan too, in the mean
square over the strain behind; `force`: of two steps while in contact, in the mean square over
the exact one; `energy`: change of the energy in the run, most of it of the node that closes
with its mass; `rise`: its largest rise above the start. Courant number of an element at small
strain.""",
    "disc": """The rubber disc of `input/finite`, n x n elements, at .2 of its speed of shear
waves onto a smooth floor. **The reference is bipact's own**: EMC with %d x %d elements at
Courant number %g; no exact solution is known, and errors near that between the reference and
the next mesh say nothing. `err`: velocity of the centre over that of the fall, mean over time
of what it is off; `force`: impulse of the floor at the end; `energy` and `rise` as of the bar.
Courant number of an edge 2/n and waves of pressure.""",
}
TITLES = {"bar": "A bar against a wall", "disc": "A rubber disc on a floor"}


def table(results, scene):
    heads = ["force of the step", "mass", "n", "Courant"] + list(MEASURES) + ["CPU s"]
    lines = ["| %s |" % " | ".join(heads), "|---" * len(heads) + "|"]
    for r in results:
        if r["scene"] != scene:
            continue
        cells = [r["form"], r["mass"], str(r["n"]), "%g" % r["courant"]]
        if "failed" in r:
            cells += [r["failed"][:90].replace("|", "/")] + [""] * len(MEASURES)
        else:
            cells += [cell(r[k]) for k in MEASURES] + [cell(r["cpu"], "%.3f")]
        lines.append("| %s |" % " | ".join(cells))
    return lines + [""]


def best_lines(results):
    """For each scene and force the least error and what it takes, and the largest rise of
    energy."""
    heads = "scene, force of the step, least err, with, CPU s, largest rise of energy, failed"
    lines = ["| %s |" % " | ".join(heads.split(", ")), "|---" * 7 + "|"]
    for scene, form in itertools.product(N, FORCES):
        own = [r for r in results if (r["scene"], r["form"]) == (scene, form)]
        runs = [r for r in own if "err" in r]
        if runs:
            best = min(runs, key=lambda r: r["err"])
            words = "%s, n %d, Courant %g" % (best["mass"], best["n"], best["courant"])
            cells = (scene, form, cell(best["err"]), words, cell(best["cpu"], "%.3f"))
            rise = cell(max(r["rise"] for r in runs))
            lines.append("| %s | %s | %d |" % (" | ".join(cells), rise, len(own) - len(runs)))
    return lines + [""]


def write_page(results, size, command, out):
    """finite.md."""
    failed = sum("failed" in r for r in results)
    lines = ["# Finite deformation: error against run time", ""]
    lines += [
        "%s, %s. %d runs, %d failed. Processor time is user + system of the whole process, "
        "tables off, median of three (of runs beyond two seconds: one). Made by `%s` "
        "(FINITE=1: this page alone); every run: [finite.csv](finite.csv)."
        % (common.today(), common.machine(), len(results), failed, command),
        "",
        "EMC, PAPER, MIDPOINT: THETA 1/2 with this FORCE of `*BIPACT_KINEMATICS`; NEWMARK: "
        "gamma 1/2, beta 1/4; PAOLI 0: PAOLI with PBETA 0, explicit.",
        "",
    ]
    lines += best_lines(results) + ["![error over run time](finite.png)", ""]
    for scene, title in TITLES.items():
        how = HOW[scene]
        if scene == "disc":
            n, courant = FINE[size]
            how = how % (n, n, courant)
        lines += ["## " + title, "", how, ""] + table(results, scene)
    with open(os.path.join(out, "finite.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def write_csv(results, out):
    with open(os.path.join(out, "finite.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for r in results:
            writer.writerow(
                {k: "%.4g" % v if isinstance(v, float) else v for k, v in r.items()}
            )


COLOUR = dict(zip(FORCES, ("#000000", "#0072B2", "#D55E00", "#CC79A7", "#009E73")))
LOOK = {0.125: "v", 0.25: "^", 0.5: "o", 0.9: "D", 1.0: "s", 2.0: "x"}


def draw(results, out):
    """finite.png: error and change of the energy over run time of both scenes; a sign for each
    Courant number, a line through the meshes at one half."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.lines import Line2D

    figure, axes_of = plt.subplots(2, 2, figsize=(11.5, 9.0))
    for (scene, title), row in zip(TITLES.items(), axes_of):
        for axes, name in zip(row, ("err", "energy")):
            for form, colour in COLOUR.items():
                own = [
                    r
                    for r in results
                    if (r["scene"], r["form"], r["mass"]) == (scene, form, "LUMPED")
                    and r.get(name) is not None
                ]
                middle = [r for r in own if r["courant"] == 0.5]
                axes.loglog(
                    [r["cpu"] for r in middle],
                    [r[name] for r in middle],
                    "-",
                    color=colour,
                    lw=1.2,
                )
                for r in own:
                    axes.loglog(
                        r["cpu"], r[name], LOOK[r["courant"]], color=colour, ms=5, mfc="none"
                    )
            words = {"err": "err", "energy": "change of the energy"}[name]
            axes.set(xlabel="processor time [s]", ylabel=words)
            axes.set_title(title, loc="left", fontsize=10)
            axes.grid(True, which="both", alpha=0.2)
    signs = [Line2D([], [], color=c, label=f) for f, c in COLOUR.items()]
    signs += [
        Line2D([], [], color="k", ls="", marker=m, mfc="none", label="Courant %g" % c)
        for c, m in LOOK.items()
    ]
    axes_of[0, 0].legend(handles=signs, fontsize=7, ncol=2)
    figure.tight_layout()
    figure.savefig(os.path.join(out, "finite.png"), dpi=80)
    plt.close(figure)


def write(results, size, command, out):
    write_csv(results, out)
    draw(results, out)
    write_page(results, size, command, out)
