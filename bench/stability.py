#!/usr/bin/env python3
"""The stability atlas: stiff and extreme scenes, every scheme and mass, one verdict a cell.

    stability.py [--quick | --reduced] [--only WORD] [--jobs J] [--out doc/stability] [--fresh]

    within    the contact face stays within (h + c dt)/L of the exact displacement, in units of
              v0 2 L/c: a front is smeared by an element and a step at most
    bounded   not that near (or no exact solution), but: the energy balance never rises by more
              than 1e-9 of its largest term, the ledger closes to 1e-9, momentum is kept to
              1e-8, forces are in Coulomb's cone, nothing penetrates by more than half the way
              of a step (contact on velocities: by one more), every number is finite
    named     the run failed with a message, or all that is wrong has a warning that says it:
              energy-growth for energy, balance for the ledger and momentum, certificate for
              contact forces, overlap for penetration
    refused   the deck was refused with a message before anything was computed
    silent    anything else: a wrong answer that nothing tells of

Scenes of rigid parts, of friction that falls with speed and of a moving wall (stability_bodies.py)
are judged by scripts/collide_judge.py, from the places of all nodes: true overlap beyond 1e-2 of
the shorter edge and half the way of a step (contact on velocities: by one more), energy above its
sources, forces that are not opposite, rigid parts that change their shape. Two rigid blocks are
"named" under every scheme without a law for their impacts: the warning rigid-impact says it. Scenes
in space (stability_space.py) are judged alike, by axes of separation of their tetrahedra (3e-2 of the
shorter edge); those at finite deformation (stability_finite.py) by the deformed outlines.

How far the energy rises is printed in each cell, so that "named" hides nothing. Cells are judged by
the tables alone. Writes index.md, cells.csv and heat maps. Results are kept in build/stability, so that an
interrupted study goes on where it stopped; --only runs the axes that have WORD in their name and
takes all other cells from the cells.csv that is there. Exit code 1 if a cell is silent, or THETA with the
consistent or lumped mass is named or refused inside its stated range.
"""

import csv
import math
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import combinations
import common
import compare
import tables
import stability_bodies
import stability_finite
import stability_scenes
import stability_space

PAIRS_OF = [("THETA", mass, redist) for mass in ("CONSISTENT", "LUMPED") for redist in (0, 1)]
# Contact on velocities alone: what penetrates in a step stays.
VELOCITIES = ("MOREAU", "CDLAGRANGE")
TINY = 1.0e-9
POWERS = tuple(10.0**p for p in range(-8, 9, 2))
YOUNGS = (1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e12)
COURANT = (0.01, 0.1, 0.5, 1.0, 2.0, 10.0, 100.0, 1000.0)
MU = (0.0, 1.0e-6, 0.2, 1.0, 10.0, 1.0e3, 1.0e6)
POISSON = (0.0, 0.3, 0.45, 0.49, 0.499, 0.4999)
UNITS = tuple((name, 10.0**p) for name in ("length", "mass", "time") for p in (-12, -6, 6, 12))
VERDICTS = ("within", "bounded", "named", "refused", "silent")
COLOURS = ("#2b8a3e", "#a9e34b", "#ffd43b", "#ced4da", "#e03131")

DENSITIES = tuple(10.0**p for p in range(-4, 5, 2))  # of a rigid part
SLABS = tuple(10.0**p for p in range(-4, 9, 2))
RATIOS = (1.0, 2.0, 10.0, 1.0e3, 1.0e6)  # FS/FD
DECAYS = (1.0e-6, 1.0e-2, 1.0, 1.0e2, 1.0e4, 1.0e8)
WAYS = (1.0e-4, 1.0e-2, 0.1, 1.0, 10.0)  # of a step, in edges

SCENES = dict(stability_scenes.SCENES, **stability_bodies.SCENES, **stability_space.SCENES)
SCENES.update(stability_finite.SCENES)
BARS = ("bars", "mortar")  # scenes of two bars

# axis: (scene, what varies, its values, is a value inside the range promised for THETA C and L)
AXES = {
    "bars, Courant number": ("bars", "courant", COURANT, lambda v: v <= 100.0),
    "wall, Courant number": ("wall", "courant", COURANT, lambda v: v <= 100.0),
    "block, Courant number": ("block", "courant", COURANT, lambda v: v <= 100.0),
    "bars, density ratio": ("bars", "densities", POWERS, lambda v: 1e-6 <= v <= 1e6),
    "bars, stiffness ratio": ("bars", "youngs", YOUNGS, lambda v: 1e-6 <= v <= 1e6),
    "block, friction": ("block", "mu", MU, lambda v: v <= 10.0),
    "bars that slide, friction": ("bars", "slip", MU, lambda v: v <= 10.0),
    "oblique block, Courant number": ("oblique", "courant", COURANT, lambda v: v <= 100.0),
    "oblique block, friction": ("oblique", "mu", MU, lambda v: v <= 10.0),
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
    "mortar, Courant number": ("mortar", "courant", COURANT, lambda v: v <= 100.0),
    "mortar, stiffness ratio": ("mortar", "youngs", YOUNGS, lambda v: 1e-6 <= v <= 1e6),
    "mortar that slides, friction": ("mortar", "slip", MU, lambda v: v <= 10.0),
    "rigid block, Courant number": ("rigid_block", "courant", COURANT, lambda v: v <= 100.0),
    "rigid block, density": ("rigid_block", "densities", DENSITIES, lambda v: True),
    "rigid block, stiffness of the slab": ("rigid_block", "youngs", SLABS, lambda v: v <= 1e6),
    "rigid block, friction": ("rigid_block", "mu", MU, lambda v: v <= 10.0),
    "two rigid blocks, restitution": ("rigid_pair", "rest", (0.0, 0.5, 1.0), lambda v: False),
    "two rigid blocks, way of a step": ("rigid_pair", "step", WAYS, lambda v: False),
    "two rigid blocks, density ratio": ("rigid_pair", "densities", DENSITIES, lambda v: False),
    "two rigid blocks, friction": ("rigid_pair", "mu", MU, lambda v: False),
    "falling friction, FS over FD": ("falling", "ratio", RATIOS, lambda v: True),
    "falling friction, DC": ("falling", "decay", DECAYS, lambda v: True),
    "falling friction, FS": ("falling", "mu", MU, lambda v: v <= 10.0),
    "falling friction, Courant number": ("falling", "courant", COURANT, lambda v: v <= 100.0),
    "moving wall, friction": ("belt", "mu", (0.0, 0.2, 0.9, 1.0), lambda v: True),
    "moving wall, Courant number": ("belt", "courant", COURANT, lambda v: v <= 100.0),
    "bars in space, Courant number": ("space_bars", "courant", COURANT, lambda v: v <= 100.0),
    "bars in space, stiffness ratio": ("space_bars", "youngs", YOUNGS, lambda v: 1e-6 <= v <= 1e6),
    "bars in space, density ratio": ("space_bars", "densities", POWERS, lambda v: 1e-6 <= v <= 1e6),
    "bars in space, Poisson ratio": ("space_bars", "poisson", POISSON, lambda v: v <= 0.499),
    "bars in space, aspect ratio": (
        "space_bars",
        "aspect",
        tuple(10.0**p for p in range(-4, 5)),
        lambda v: 1.0e-2 <= v <= 1.0e2,
    ),
    "corner on a slab, Courant number": ("space_corner", "courant", COURANT, lambda v: v <= 100.0),
    "corner on a slab, friction": ("space_corner", "mu", MU, lambda v: v <= 10.0),
    "corner on a slab, stiffness of the slab": (
        "space_corner",
        "youngs",
        SLABS,
        lambda v: v <= 1e6,
    ),
    "flat block of tetrahedra, Courant number": (
        "space_flat",
        "courant",
        COURANT,
        lambda v: v <= 100.0,
    ),
    "flat block of tetrahedra, friction": ("space_flat", "mu", MU, lambda v: v <= 10.0),
    "bouncing bar, 1e5 steps": ("bouncing", "courant", (0.5, 0.9), lambda v: True),
    **stability_finite.AXES,
}
# Two at a time, for THETA alone: (scene, first, values, second, values)
PAIRS = {
    "Courant number and density ratio": ("bars", "courant", COURANT[:-1], "densities", POWERS),
    "Courant number and stiffness ratio": ("bars", "courant", COURANT[:-1], "youngs", POWERS),
    "density and stiffness ratio": ("bars", "densities", POWERS, "youngs", POWERS),
    "Courant number and friction of the block": ("block", "courant", COURANT[:-1], "mu", MU),
}


def few(values, size):
    """Values of an axis for a short study: every third, or the last (both ends of ratios)."""
    both = (POWERS, YOUNGS, DENSITIES, SLABS, RATIOS, DECAYS)
    if any(values is a[2] for a in stability_finite.AXES.values()):
        return {"full": values, "quick": values[-2:], "reduced": values}[size]
    ends = values[:: len(values) - 1] if values in both else values[-1:]
    return {"full": values, "quick": values[::3], "reduced": ends}[size]


def cells(size, pairs):
    """All cells: {axis, scene, method..., options, promised}."""
    for axis, (scene, name, values, inside) in AXES.items():
        if scene == "bouncing" and size == "reduced":
            continue
        for pair in pairs_of(scene, pairs):
            for value in few(values, size):
                ours = pair[0] == "THETA" and pair[1] != "DISPERSION"
                yield cell(axis, scene, pair, {name: value}, ours and inside(value))
    for axis, (scene, first, firsts, second, seconds) in PAIRS.items():
        inside = {AXES[a][1]: AXES[a][3] for a in AXES if AXES[a][0] == scene}
        for pair in PAIRS_OF:
            for a in few(firsts, size):
                for b in few(seconds, size):
                    promised = inside[first](a) and inside[second](b)
                    yield cell(axis, scene, pair, {first: a, second: b}, promised)


def pairs_of(scene, pairs):
    """Combinations of a scene: those that finite deformation takes, or those of all others."""
    if scene in stability_finite.SCENES:
        return stability_finite.PAIRS
    return [p for p in pairs if p[0] not in stability_finite.FORCES]


def cell(axis, scene, pair, options, promised):
    names = ("method", "mass", "redist")
    return dict(zip(names, pair), axis=axis, scene=scene, options=options, promised=promised)


def key(c):
    """Identity of a cell as text."""
    return "|".join(map(str, (c["axis"], common.label(c), c["options"])))


def write_scene(path, c):
    """Writes the deck of a cell; returns the data for its judgement."""
    if c["scene"] in stability_finite.SCENES:
        return SCENES[c["scene"]](path, c, dict(c["options"]))
    of = combinations.bar_options if c["scene"] in BARS else combinations.options
    return SCENES[c["scene"]](path, of(c), dict(c["options"]))


def error_of(folder, c, data):
    """Distance from the exact solution in its own unit, or None where there is none."""
    meta = data["meta"]
    if "finite" in data:
        return stability_finite.error_of(folder, data)
    if data["exact"]:
        found = compare.measure(folder, meta)
        return found["e_u"]
    if data.get("block"):
        parts = tables.read_run(folder, "matsum")
        steps = np.diff(parts["time"])
        place = np.cumsum(0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * steps)
        return np.max(np.abs(place - data["block"].place(parts["time"][1:])))
    if data.get("oblique"):
        rows, exact = tables.read_run(folder, "nodout"), meta["exact"]
        rows = rows.select(node=meta["middle"])
        after = np.maximum(rows["time"] - meta["touch"], 0.0)
        slip = exact.slip(0.5 * meta["tend"])
        off_x = rows["ux"] - exact.layer.tangential * (rows["time"] - after) - slip * after
        off_y = rows["uy"] + exact.layer.normal * (rows["time"] - after)
        return np.max(np.hypot(off_x, off_y)) / meta["tend"]
    if c["scene"] == "drift":
        force = tables.read_run(folder, "rwforc")
        # Round-off of the gap is 1e-16; as a gap closed within a step it is a force of
        # m 1e-16/dt^2.
        return max(0.0, np.max(np.abs(force["fy"])) / (0.5 * 1e-14 / meta["dt"] ** 2) - 1.0)
    return None


TERMS = ("kinetic", "internal", "external", "friction", "contact", "algorithmic", "initial")


def growth(folder, log):
    """Rise of the energy balance over its largest term; None where there is no table."""
    glstat = tables.read_run(folder, "glstat")
    if glstat is None or not len(glstat):
        return None
    with np.errstate(all="ignore"):
        largest = max(np.max(np.abs(glstat[name])) for name in TERMS) or 1.0
        balance = glstat["total"] - glstat["external"] - glstat["motion"]
        rise = np.max(balance - np.minimum.accumulate(balance))
        # The log gives seven digits.
        return float((rise - (1.0 + 5.0e-7) * log.get("corrections", 0.0)) / largest)


def faults(folder, c, data, log):
    """What a run does that physics forbids: [(words, warning that would say so or '')]."""
    found = []
    glstat = tables.read_run(folder, "glstat")
    columns = [glstat[name] for name in glstat.names]
    if not all(np.all(np.isfinite(column)) for column in columns):
        return [("not finite", "")]
    rise = growth(folder, log)
    if rise > TINY:
        found.append(("energy rises by %.1e" % rise, "energy-growth"))
    if np.max(np.abs(glstat["residual"])) > TINY:
        found.append(("ledger open by %.1e" % np.max(np.abs(glstat["residual"])), "balance"))
    two_bodies = c["scene"] in BARS + ("oblique",) or data.get("base")
    force = tables.read_run(folder, "rcforc" if two_bodies else "rwforc")
    if np.any(np.abs(force["ft"]) > data["mu"] * np.abs(force["fn"]) * (1.0 + 1e-6) + 1e-300):
        found.append(("outside the cone", "certificate"))
    # Rows hold gaps in the frame of the start of a step: a face that turns within it leaves an
    # overlap of a part of its way; contact on velocities lets the way itself in. Round-off of
    # places: a hundred bits of the way flown.
    # Velocities are those that the energy allows, which a scheme may have raised.
    faster = math.sqrt(max(1.0, np.max(glstat["kinetic"]) / (glstat["kinetic"][0] or np.inf)))
    allowed = 0.5 * faster * data["way"] + 100.0 * 2.3e-16 * (10.0 + data["way"] * len(glstat))
    # Where faces have slid from each other, nodes may sink 1e-3 of an edge besides (README,
    # Limits), in the frame of the start of the step; between faces with multipliers more.
    if data["mu"] > 0.0:
        allowed += data.get("sink", 1.0e-3 * data.get("edge", 0.0))
    if c["method"] in VELOCITIES:
        allowed += data["way"]
    if -np.min(force["gapmin"]) > allowed:
        found.append(("penetrates by %.1e" % -np.min(force["gapmin"]), "overlap"))
    if c["scene"] in BARS:
        momentum = compare.measure(folder, data["meta"])["momentum"]
        # Round-off of stiffness x displacement: ratios of 1e15 leave nine digits.
        if momentum > 10.0 * TINY:
            found.append(("momentum changes by %.1e" % momentum, "balance"))
    if log.get("certificate", "met") != "met":
        found.append(("certificate %s" % log["certificate"], "certificate"))
    return found


def value_of(c):
    """What varies in a cell, as text."""
    return " ".join("%s=%s" % item for item in c["options"].items())


def judge(c):
    """One cell: its line of results."""
    result = {k: c[k] for k in ("axis", "scene", "method", "mass", "redist", "promised")}
    result["value"] = value_of(c)
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "cell.k"), os.path.join(folder, "out")
        try:
            data = write_scene(deck, c)
        except ValueError as problem:
            return dict(result, verdict="refused", reason=str(problem))
        soft = c["scene"] in stability_finite.SCENES
        done = common.run(deck, out, limit=stability_finite.LIMIT if soft else 300)
        if done["code"] == 2:
            return dict(result, verdict="refused", reason=first_words(done, folder))
        log = common.read_log(out) if os.path.exists(os.path.join(out, "bipact.log")) else {}
        result["growth"] = growth(out, log) if os.path.isdir(out) else None
        if done["code"] != 0:
            said = done["code"] == 1 and done["errors"]
            verdict = "named" if said else "silent"
            return dict(result, verdict=verdict, reason=first_words(done, folder))
        if "bodies" in data:
            wrong = stability_bodies.faults(folder, c, data, log, result["growth"])
        elif "space" in data:
            wrong = stability_space.faults(out, c, data, log, result["growth"])
        else:
            wrong = faults(out, c, data, log)
        error = error_of(out, c, data)
        near = error is not None and error <= data["bound"] <= 0.5
        if c["scene"] == "drift" and not near:
            wrong.append(("a force without cause", ""))
        result.update(error=None if error is None else float(error), bound=data["bound"])
        if wrong:
            warned = [w.partition(":")[0].split()[0] for w in log.get("warnings", ())]
            told = all(warning in warned for _, warning in wrong)
            verdict = "named" if told else "silent"
            return dict(result, verdict=verdict, reason="; ".join(words for words, _ in wrong))
        return dict(result, verdict="within" if near else "bounded", reason="")


def first_words(done, folder):
    """What a run that failed said: its error, before its warnings."""
    said = done["errors"].replace(folder + "/", "").splitlines() or ["exit %s" % done["code"]]
    return next((x for x in said if not x.startswith("WARNING")), said[0])


def heat_map(title, rows, columns, results, path):
    """A map of results[row][column]: colour the verdict, figure the power of ten of the rise of
    energy over its largest term, where it is more than round-off (1e-12)."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    figure, axes = plt.subplots(
        figsize=(2.5 + 0.62 * len(columns), 1.3 + 0.32 * len(rows)), layout="constrained"
    )
    values = [[VERDICTS.index(r["verdict"]) if r else -1 for r in row] for row in results]
    axes.imshow(
        np.ma.masked_less(values, 0),
        cmap=ListedColormap(COLOURS),
        vmin=-0.5,
        vmax=4.5,
        aspect="auto",
    )
    for y, row in enumerate(results):
        for x, r in enumerate(row):
            if r and (r.get("growth") or 0.0) > 1.0e-12:
                power = "%.0f" % math.log10(r["growth"])
                axes.text(x, y, power, ha="center", va="center", fontsize=7)
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


def write_maps(results, pairs, size, out, only=""):
    """One map an axis (combinations x values), one a pair and mass (values x values); of axes
    without the word `only` the names alone."""
    found = {key(c): r for c, r in results}
    names = []
    for axis, (scene, name, values, _) in AXES.items():
        values = few(values, size)
        grid = [
            [found.get(key(cell(axis, scene, s, {name: v}, 0))) for v in values]
            for s in pairs_of(scene, pairs)
        ]
        if not any(map(any, grid)):
            continue
        rows = [common.label(s) for s in pairs_of(scene, pairs)]
        names.append(axis.replace(", ", "_").replace(" ", "_") + ".png")
        if only not in axis:
            continue
        heat_map(axis, rows, [short(v) for v in values], grid, os.path.join(out, names[-1]))
    for axis, (scene, first, firsts, second, seconds) in PAIRS.items():
        firsts, seconds = few(firsts, size), few(seconds, size)
        for pair in PAIRS_OF:
            grid = [
                [
                    found.get(key(cell(axis, scene, pair, {first: a, second: b}, 0)))
                    for a in firsts
                ]
                for b in seconds
            ]
            word = common.label(pair)
            names.append((axis + "_" + word).replace(" ", "_").replace("*", "0") + ".png")
            if only not in axis:
                continue
            heat_map(
                "%s\n%s (across, up)" % (word, axis),
                [short(b) for b in seconds],
                [short(a) for a in firsts],
                grid,
                os.path.join(out, names[-1]),
            )
    return names


COMMANDS = {"full": "stability", "quick": "stability QUICK=1", "reduced": "stability REDUCED=1"}


def write_index(results, names, about, out):
    """index.md: counts, failures, maps."""
    lines = [
        "# Stability on stiff and extreme cases",
        "",
        "%s, %s. %d cells. Made by `make %s`."
        % (common.today(), common.machine(), len(results), COMMANDS[about["size"]]),
        "",
    ]
    if about["size"] != "full":
        lines += [
            "**Part of the study**: the extreme of each axis, all values at finite deformation. "
            "The whole: `make stability` (it goes on where it stopped).",
            "",
        ]
    text, outside = __doc__.split("\n\n")[2:4]
    lines += ["- **%s**: %s" % tuple(item) for item in verdict_words(text)]
    lines += ["", " ".join(outside.split())]
    lines += [
        "",
        "C consistent, L lumped, D dispersion-tuned mass; * massless contact nodes. Growth: the "
        "largest rise of the energy balance over its largest term, of all cells that ran; of those "
        "whose verdict is within or bounded it is at most 1e-9. On the maps the power of ten of each "
        "cell's own.",
        "",
        "| combination | " + " | ".join(VERDICTS) + " | largest growth | where |",
        "|---" * 8 + "|",
    ]
    for pair in about["pairs"]:
        word = common.label(pair)
        mine = [r for c, r in results if common.label(c) == word]
        counts = [sum(r["verdict"] == v for r in mine) for v in VERDICTS]
        grown = [r for r in mine if r.get("growth") is not None and r["growth"] > 0.0]
        worst = max(grown, key=lambda r: r["growth"], default=None)
        cells_of = [str(n) for n in counts] + (
            ["%.1e" % worst["growth"], "%s: %s" % (worst["axis"], worst["value"])]
            if worst
            else ["0", ""]
        )
        lines.append("| %s | %s |" % (word, " | ".join(cells_of)))
    promised = [r for _, r in results if r["promised"]]
    broken = [r for r in promised if r["verdict"] not in ("within", "bounded")]
    lines += [
        "",
        "THETA 1/2 with the consistent or lumped mass, Courant 0.01 to 100, ratios 1e-6 "
        "to 1e6, mu up to 10, Poisson ratio up to 0.499; at finite deformation as its axes say "
        "(stability_finite.py): %d cells, %d not within bound or bounded."
        % (len(promised), len(broken)),
        "",
        "## Failures and their words",
        "",
    ]
    lines += reasons([r for _, r in results])
    lines += ["", "## Combinations that the program does not take", ""]
    lines += combinations.refusal_table(about["refused"]) + ["", "## Maps", ""]
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
            group = words.split(" by ")[0] if r["verdict"] == "named" else words
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
        "method",
        "mass",
        "redist",
        "promised",
        "verdict",
        "growth",
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


def row_of(c):
    """Identity of a cell in cells.csv."""
    return c["axis"], value_of(c), c["method"], c["mass"], str(c["redist"])


def read_csv(out):
    """{row_of: result} of the cells.csv that is there, if any."""
    path, found = os.path.join(out, "cells.csv"), {}
    if not os.path.exists(path):
        return found
    with open(path, encoding="utf-8", newline="") as file:
        for r in csv.DictReader(file):
            name = tuple(r[k] for k in ("axis", "value", "method", "mass", "redist"))
            for k in ("growth", "error", "bound"):
                r[k] = float(r[k]) if r[k] else None
            found[name] = dict(r, promised=r["promised"] == "True", redist=int(r["redist"]))
    return found


def main():
    parser = common.study_parser(__doc__)
    parser.add_argument("--only", metavar="WORD", default="", help="axes with this word anew")
    a = parser.parse_args()
    size = "quick" if a.quick else "reduced" if a.reduced else "full"
    store, out = common.study_folders("stability", a)
    pairs, refused = combinations.taken(store, combinations.ONE_MASS)
    pairs += [p for p in stability_finite.PAIRS if p not in pairs]
    wanted = list(cells(size, pairs))
    kept = read_csv(out) if a.only else {}
    found = common.sweep(judge, [c for c in wanted if a.only in c["axis"]], key, store, a.jobs)
    results = [(c, found[key(c)] if a.only in c["axis"] else kept.get(row_of(c))) for c in wanted]
    results = [(c, r) for c, r in results if r]
    write_csv(results, out)
    names = write_maps(results, pairs, size, out, a.only)
    broken = write_index(
        results, names, dict(size=size, pairs=pairs, refused=refused), out
    )
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
