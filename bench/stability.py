#!/usr/bin/env python3
"""The stability atlas: stiff and extreme scenes, every scheme and mass, one verdict a cell.

    stability.py [--quick] [--jobs J] [--out doc/stability] [--fresh]

    within    the contact face stays within (h + c dt)/L of the exact displacement, in units of
              v0 2 L/c: a front is smeared by an element and a step at most
    bounded   not that near (or no exact solution), but: the energy balance never rises by more
              than 1e-9 of its largest term, the ledger closes to 1e-9, momentum is kept to
              1e-8, forces are in Coulomb's cone, nothing penetrates, every number is finite
    named     the run failed with a message, or its log carries WARNING energy-growth
              or WARNING certificate
    refused   the deck was refused with a message before anything was computed
    silent    anything else: a wrong answer that nothing tells of

Writes index.md, cells.csv and heat maps. Results are kept in build/stability, so that an
interrupted study goes on where it stopped. Exit code 1 if a cell is silent, or THETA with the
consistent or lumped mass is named or refused inside its stated range.
"""

import argparse
import csv
import math
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import compare
import make_bars
import make_scenes
import tables
from analytic import SlidingBlock, impact_of

SCHEMES = [
    (scheme, theta, mass, redist)
    for scheme, theta in (("THETA", 0.5), ("THETA", 1.0), ("NEWMARK", 0.5))
    for mass in ("CONSISTENT", "LUMPED", "DISPERSION")
    for redist in (0, 1)
]
TINY = 1.0e-9
POWERS = tuple(10.0**p for p in range(-8, 9, 2))
COURANT = (0.01, 0.1, 0.5, 1.0, 2.0, 10.0, 100.0, 1000.0)
MU = (0.0, 1.0e-6, 0.2, 1.0, 10.0, 1.0e3, 1.0e6)
POISSON = (0.0, 0.3, 0.45, 0.49, 0.499, 0.4999)
UNITS = tuple((name, 10.0**p) for name in ("length", "mass", "time") for p in (-12, -6, 6, 12))
VERDICTS = ("within", "bounded", "named", "refused", "silent")
COLOURS = ("#2b8a3e", "#a9e34b", "#ffd43b", "#ced4da", "#e03131")

# axis: (scene, what varies, its values, is a value inside the range promised for THETA C and L)
AXES = {
    "bars, Courant number": ("bars", "courant", COURANT, lambda v: v <= 100.0),
    "wall, Courant number": ("wall", "courant", COURANT, lambda v: v <= 100.0),
    "block, Courant number": ("block", "courant", COURANT, lambda v: v <= 100.0),
    "bars, density ratio": ("bars", "densities", POWERS, lambda v: 1e-6 <= v <= 1e6),
    "bars, stiffness ratio": ("bars", "youngs", POWERS, lambda v: 1e-6 <= v <= 1e6),
    "block, friction": ("block", "mu", MU, lambda v: v <= 10.0),
    "bars that slide, friction": ("bars", "slip", MU, lambda v: v <= 10.0),
    "bars, Poisson ratio": ("bars", "poisson", POISSON, lambda v: v <= 0.499),
    "wall, Poisson ratio": ("wall", "poisson", POISSON, lambda v: v <= 0.499),
    "bars, gap": ("bars", "gap", (0.0, 1e-15, 1e-12, 1e-6, 0.02), lambda v: True),
    "block that glides at a gap": ("drift", "gap", (0.0, 1e-15, 1e-12), lambda v: True),
    "bars, elements": ("bars", "n", (1, 2, 3, 5, 20), lambda v: True),
    "bars, aspect ratio of elements": (
        "bars",
        "aspect",
        tuple(10.0**p for p in range(-4, 5)),
        lambda v: v <= 1.0e2,
    ),
    "bars, units": ("bars", "unit", UNITS, lambda v: True),
    "bouncing bar, 1e5 steps": ("bouncing", "courant", (0.5, 0.9), lambda v: True),
}
# Two at a time, for THETA alone: (scene, first, values, second, values)
PAIRS = {
    "Courant number and density ratio": ("bars", "courant", COURANT[:-1], "densities", POWERS),
    "Courant number and stiffness ratio": ("bars", "courant", COURANT[:-1], "youngs", POWERS),
    "density and stiffness ratio": ("bars", "densities", POWERS, "youngs", POWERS),
    "Courant number and friction of the block": ("block", "courant", COURANT[:-1], "mu", MU),
}


def cells(quick):
    """All cells: {axis, scene, scheme..., options, promised}."""
    for axis, (scene, name, values, inside) in AXES.items():
        for scheme, theta, mass, redist in SCHEMES:
            for value in values[:: 3 if quick else 1]:
                ours = (scheme, theta) == ("THETA", 0.5) and mass != "DISPERSION"
                yield cell(
                    axis,
                    scene,
                    (scheme, theta, mass, redist),
                    {name: value},
                    ours and inside(value),
                )
    for axis, (scene, first, firsts, second, seconds) in PAIRS.items():
        inside = {AXES[a][1]: AXES[a][3] for a in AXES if AXES[a][0] == scene}
        for mass in ("CONSISTENT", "LUMPED"):
            for redist in (0, 1):
                for a in firsts[:: 3 if quick else 1]:
                    for b in seconds[:: 4 if quick else 1]:
                        yield cell(
                            axis,
                            scene,
                            ("THETA", 0.5, mass, redist),
                            {first: a, second: b},
                            inside[first](a) and inside[second](b),
                        )


def cell(axis, scene, scheme, options, promised):
    names = ("scheme", "theta", "mass", "redist")
    return dict(zip(names, scheme), axis=axis, scene=scene, options=options, promised=promised)


def key(c):
    """Identity of a cell as text."""
    return "|".join(map(str, (c["axis"], common.label(c), c["options"])))


def write_scene(path, c):
    """Writes the deck of a cell; returns (data for the comparison, h, c dt, L)."""
    scheme = {k: c[k] for k in ("scheme", "theta", "mass", "redist")}
    if c["scheme"] == "NEWMARK":
        scheme.pop("theta")
    return SCENES[c["scene"]](path, scheme, dict(c["options"]))


def bars(path, scheme, o):
    """Two bars of 20 elements, touch in mid-step unless the gap is what varies."""
    n, courant = o.pop("n", 20), o.pop("courant", 0.5)
    width = 10.0 / n
    options = dict(scheme, nx=n, nx2=n, courant=courant, gap=0.02, touch=0.5)
    if "gap" in o:
        options.update(gap=o.pop("gap"), touch=None)
    # Waves are small where the speed is well below that of sound in both bars.
    sound = math.sqrt(min(1.0, o.get("youngs", 1.0) / o.get("densities", 1.0)))
    options["v0"] = min(1.0, 10.0 * sound)
    options["gap"] *= options["v0"]
    if "densities" in o:
        options["density2"] = 1.0e-3 * o.pop("densities")
    if "youngs" in o:
        options["young2"] = 1.0e3 * o.pop("youngs")
    if "slip" in o:
        options.update(mu=o.pop("slip"), slide=0.25, poisson=0.3, ny=2)
    if "poisson" in o:
        options.update(poisson=o.pop("poisson"), ny=4)
    if "aspect" in o:
        options["height"] = width / o.pop("aspect")
    if "unit" in o:
        name, factor = o.pop("unit")
        options["scale_" + name] = factor
    dt = courant * width / 1.0e3
    options["tend"] = max(0.05, 30.0 * dt)
    options = {k: v for k, v in options.items() if v is not None}
    meta = make_bars.write(path, output="step", **options)
    return {
        "meta": meta,
        "exact": options.get("poisson", 0.0) == 0.0,
        "bound": (1.0 + courant) / n,
        "mu": options.get("mu", 0.0),
    }


def wall(path, scheme, o):
    """A bar of 20 elements on a rigid wall."""
    courant, poisson = o.get("courant", 0.5), o.get("poisson", 0.0)
    dt = courant * 0.5 / 1.0e3
    touch = 0.5 if courant <= 10.0 else None
    meta = make_scenes.write(
        path,
        "wall",
        n=20,
        ny=4 if poisson else 1,
        courant=courant,
        poisson=poisson,
        touch=touch,
        tend=max(0.05, 30.0 * dt),
        **scheme
    )
    return {"meta": meta, "exact": not poisson, "bound": (1.0 + courant) / 20, "mu": 0.0}


def block(path, scheme, o):
    """A block that slides to rest; exact for a rigid one, up to mu = 1, where it may tip. On a
    wall up to mu = 1 (there FRIC 1 means no sliding), on a fixed body from there."""
    mu, courant = o.get("mu", 0.2), o.get("courant", 0.5)
    dt = courant * 0.25 / math.sqrt(1.0e5)
    base = 1 if mu >= 1.0 else 0
    tend = max(0.7, 30.0 * dt)
    meta = make_scenes.write(
        path, "sliding", mu=mu, courant=courant, tend=tend, base=base, **scheme
    )
    exact = SlidingBlock(meta["v"], mu, meta["g"], meta["mass"]) if 0.0 < mu < 1.0 else None
    bound = meta["v"] * (meta["bounce"] + dt)
    return {
        "meta": meta,
        "block": exact,
        "exact": False,
        "bound": bound,
        "mu": mu,
        "base": base,
    }


def drift(path, scheme, o):
    """A body that glides along a plane at a gap of nothing: no force may appear."""
    meta = make_scenes.write(path, "drift", gap=o["gap"], v=1.0, **scheme)
    return {"meta": meta, "exact": False, "bound": 0.0, "mu": 0.5}


def bouncing(path, scheme, o):
    """The bouncing bar for 1e5 steps."""
    one = make_scenes.write(path, "bouncing", n=20, periods=1.0, courant=o["courant"], **scheme)
    meta = make_scenes.write(
        path,
        "bouncing",
        n=20,
        periods=1.0e5 * one["dt"] / one["tend"],
        courant=o["courant"],
        output=100.0 * one["dt"],
        **scheme
    )
    return {"meta": meta, "exact": False, "bound": 0.0, "mu": 0.0}


SCENES = {"bars": bars, "wall": wall, "block": block, "drift": drift, "bouncing": bouncing}


def error_of(folder, c, data):
    """Distance from the exact solution in its own unit, or None where there is none."""
    meta = data["meta"]
    if data["exact"]:
        found = compare.measure(folder, meta)
        return found["e_u"]
    if data.get("block"):
        parts = tables.read_run(folder, "matsum")
        steps = np.diff(parts["time"])
        place = np.cumsum(0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * steps)
        return np.max(np.abs(place - data["block"].place(parts["time"][1:])))
    if c["scene"] == "drift":
        force = tables.read_run(folder, "rwforc")
        # Round-off of the gap is 1e-16; as a gap closed within a step it is a force of
        # m 1e-16/dt^2.
        return max(0.0, np.max(np.abs(force["fy"])) / (0.5 * 1e-14 / meta["dt"] ** 2) - 1.0)
    return None


def faults(folder, c, data, log):
    """What a run does that physics forbids: list of words."""
    found = []
    glstat = tables.read_run(folder, "glstat")
    columns = [glstat[name] for name in glstat.names]
    if not all(np.all(np.isfinite(column)) for column in columns):
        return ["not finite"]
    terms = ("kinetic", "internal", "external", "friction", "contact", "algorithmic", "initial")
    largest = max(np.max(np.abs(glstat[name])) for name in terms) or 1.0
    balance = glstat["total"] - glstat["external"] - glstat["motion"]
    rise = np.max(balance - np.minimum.accumulate(balance)) / largest
    rise -= log.get("corrections", 0.0) / largest
    if rise > TINY:
        found.append("energy rises by %.1e" % rise)
    if np.max(np.abs(glstat["residual"])) > TINY:
        found.append("ledger open by %.1e" % np.max(np.abs(glstat["residual"])))
    two_bodies = c["scene"] == "bars" or data.get("base")
    name = "rcforc" if two_bodies else "rwforc"
    force = tables.read_run(folder, name)
    if np.any(np.abs(force["ft"]) > data["mu"] * np.abs(force["fn"]) * (1.0 + 1e-6) + 1e-300):
        found.append("outside the cone")
    if c["scene"] == "bars":
        momentum = compare.measure(folder, data["meta"])["momentum"]
        # Round-off of stiffness x displacement: ratios of 1e15 leave nine digits.
        if momentum > 10.0 * TINY:
            found.append("momentum changes by %.1e" % momentum)
    if log.get("certificate", "met") != "met":
        found.append("certificate %s" % log["certificate"])
    return found


def judge(c):
    """One cell: its line of results."""
    result = {
        k: c[k] for k in ("axis", "scene", "scheme", "theta", "mass", "redist", "promised")
    }
    result["value"] = " ".join("%s=%s" % item for item in c["options"].items())
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "cell.k"), os.path.join(folder, "out")
        try:
            data = write_scene(deck, c)
        except ValueError as problem:
            return dict(result, verdict="refused", reason=str(problem))
        done = common.run(deck, out, limit=300)
        if done["code"] != 0:
            said = done["errors"].replace(folder + "/", "").splitlines()
            verdict = (
                {1: "named", 2: "refused"}.get(done["code"], "silent") if said else "silent"
            )
            return dict(result, verdict=verdict, reason=(said or ["exit %s" % done["code"]])[0])
        log = common.read_log(out)
        words = ("energy-growth", "certificate")
        grown = [w for w in log.get("warnings", ()) if w.startswith(words)]
        if grown:
            return dict(result, verdict="named", reason=grown[0])
        wrong = faults(out, c, data, log)
        error = error_of(out, c, data)
        if wrong:
            return dict(result, verdict="silent", reason="; ".join(wrong))
        near = error is not None and error <= data["bound"] <= 0.5
        if c["scene"] == "drift" and not near:
            return dict(result, verdict="silent", reason="a force without cause")
        return dict(
            result,
            verdict="within" if near else "bounded",
            reason="",
            error=None if error is None else float(error),
            bound=data["bound"],
        )


def heat_map(title, rows, columns, verdicts, path):
    """A map of verdicts[row][column]."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    figure, axes = plt.subplots(
        figsize=(2.5 + 0.62 * len(columns), 1.3 + 0.32 * len(rows)), layout="constrained"
    )
    values = [[VERDICTS.index(v) if v else -1 for v in row] for row in verdicts]
    axes.imshow(
        np.ma.masked_less(values, 0),
        cmap=ListedColormap(COLOURS),
        vmin=-0.5,
        vmax=4.5,
        aspect="auto",
    )
    axes.set_xticks(range(len(columns)), columns, rotation=45, ha="right", fontsize=8)
    axes.set_yticks(range(len(rows)), rows, fontsize=8)
    axes.set_title(title, fontsize=9)
    axes.legend(
        handles=[Patch(color=c, label=v) for c, v in zip(COLOURS, VERDICTS)],
        fontsize=7,
        loc="upper left",
        bbox_to_anchor=(1.0, 1.0),
    )
    figure.savefig(path, dpi=80)
    plt.close(figure)


def short(value):
    """A value on an axis of a map."""
    return "%s %.0e" % value if isinstance(value, tuple) else "%g" % value


def write_maps(results, out):
    """One map an axis (combinations x values), one a pair and mass (values x values)."""
    found = {key(c): r["verdict"] for c, r in results}
    names = []
    for axis, (scene, name, values, _) in AXES.items():
        grid = [
            [found.get(key(cell(axis, scene, s, {name: v}, 0))) for v in values]
            for s in SCHEMES
        ]
        rows = [common.label(s) for s in SCHEMES]
        names.append(axis.replace(", ", "_").replace(" ", "_") + ".png")
        heat_map(axis, rows, [short(v) for v in values], grid, os.path.join(out, names[-1]))
    for axis, (scene, first, firsts, second, seconds) in PAIRS.items():
        for mass, redist in (
            ("CONSISTENT", 0),
            ("LUMPED", 0),
            ("CONSISTENT", 1),
            ("LUMPED", 1),
        ):
            scheme = ("THETA", 0.5, mass, redist)
            grid = [
                [
                    found.get(key(cell(axis, scene, scheme, {first: a, second: b}, 0)))
                    for a in firsts
                ]
                for b in seconds
            ]
            word = common.label(scheme)
            names.append((axis + "_" + word).replace(" ", "_").replace("*", "0") + ".png")
            heat_map(
                "%s\n%s (across, up)" % (word, axis),
                [short(b) for b in seconds],
                [short(a) for a in firsts],
                grid,
                os.path.join(out, names[-1]),
            )
    return names


def write_index(results, names, out, quick):
    """index.md: counts, failures, maps."""
    lines = [
        "# Stability on stiff and extreme cases",
        "",
        "%s, %s. %d cells. Made by `make "
        "stability%s`."
        % (common.today(), common.machine(), len(results), " QUICK=1" if quick else ""),
        "",
    ]
    text = __doc__.split("\n\n")[2]
    lines += ["- **%s**: %s" % tuple(item) for item in verdict_words(text)]
    lines += [
        "",
        "C consistent, L lumped, D dispersion-tuned mass; * massless contact nodes.",
        "",
        "| combination | " + " | ".join(VERDICTS) + " |",
        "|---" * 6 + "|",
    ]
    for scheme in SCHEMES:
        word = common.label(scheme)
        mine = [r["verdict"] for c, r in results if common.label(c) == word]
        lines.append("| %s | %s |" % (word, " | ".join(str(mine.count(v)) for v in VERDICTS)))
    promised = [r for _, r in results if r["promised"]]
    broken = [r for r in promised if r["verdict"] not in ("within", "bounded")]
    lines += [
        "",
        "THETA 1/2 with the consistent or lumped mass, Courant 0.01 to 100, ratios 1e-6 "
        "to 1e6, mu up to 10, Poisson ratio up to 0.499: %d cells, %d not within bound or "
        "bounded." % (len(promised), len(broken)),
        "",
        "## Failures and their words",
        "",
    ]
    lines += reasons([r for _, r in results]) + ["", "## Maps", ""]
    lines += ["![%s](%s)" % (name[:-4].replace("_", " "), name) for name in names]
    with open(os.path.join(out, "index.md"), "w") as file:
        file.write("\n".join(lines) + "\n")
    return broken


def verdict_words(text):
    """[(verdict, meaning)] from the head of this file."""
    found = []
    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word in VERDICTS:
            found.append([word, rest.strip()])
        else:
            found[-1][1] += " " + line.strip()
    return found


def reasons(results):
    """Lines of a table: what was named, refused or silent, and how often."""
    counts = {}
    for r in results:
        if r["verdict"] in ("named", "refused", "silent"):
            words = r["reason"].split(";")[0]
            words = words if len(words) < 100 else words[:97] + "..."
            group = (
                words.split(":")[0]
                if words.startswith(("energy-growth", "certificate"))
                else words
            )
            name = (r["verdict"], common.label(r), r["axis"], group)
            counts[name] = counts.get(name, 0) + 1
    lines = ["| verdict | combination | axis | cells | words |", "|---|---|---|---|---|"]
    for (verdict, word, axis, why), n in sorted(counts.items()):
        lines.append(
            "| %s | %s | %s | %d | %s |" % (verdict, word, axis, n, why.replace("|", "/"))
        )
    return lines


def write_csv(results, out):
    names = [
        "axis",
        "value",
        "scheme",
        "theta",
        "mass",
        "redist",
        "promised",
        "verdict",
        "error",
        "bound",
        "reason",
    ]
    with open(os.path.join(out, "cells.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for _, r in results:
            writer.writerow(
                {k: "%.4g" % v if isinstance(v, float) else v for k, v in r.items()}
            )


def main():
    a = common.study_arguments(__doc__)
    store, out = common.study_folders("stability", a)
    wanted = list(cells(a.quick))
    found = common.sweep(judge, wanted, key, store, a.jobs)
    results = [(c, found[key(c)]) for c in wanted]
    write_csv(results, out)
    broken = write_index(results, write_maps(results, out), out, a.quick)
    silent = [r for _, r in results if r["verdict"] == "silent"]
    for r in silent + [b for b in broken if b not in silent]:
        print(
            "%s | %s | %s: %s, %s"
            % (r["axis"], common.label(r), r["value"], r["verdict"], r["reason"])
        )
    print(
        "%d cells, %d silent, %d outside the promise: %s"
        % (
            len(results),
            len(silent),
            len(broken),
            os.path.relpath(os.path.join(out, "index.md")),
        )
    )
    return 1 if silent or broken else 0


if __name__ == "__main__":
    sys.exit(main())
