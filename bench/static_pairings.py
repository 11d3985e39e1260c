"""The pairings NODE and MORTAR in statics: error against run time on Westergaard's wave and on case H
(Hertz, then Cattaneo and Mindlin), faces that match and faces that do not; CalculiX beside them
on case H where it is installed. Part of make report: static.md, static.csv, static.png, and the
words on pairings in choose.md."""

import csv
import math
import os
import statistics
import tempfile

import common
import contact_errors
import make_scenes
import peers
import static_peer

PAIRINGS = ("NODE", "MORTAR")
# Edges of (upper, lower) in parts of the coarser.
MESHES = {
    "matching": (1.0, 1.0),
    "2:3, upper finer": (1.5, 1.0),
    "2:3, lower finer": (1.0, 1.5),
    "1:3, upper finer": (3.0, 1.0),
    "1:3, lower finer": (1.0, 3.0),
}
RATIOS = {"matching": 1.0, "2:3, upper finer": 1.5}  # of the edges of case H
WAVE, HERTZ = (8, 16, 32, 64), (0.005, 0.0025, 0.00125)  # edges of the coarser face; h
PEER = (0.005, 0.0025)
MEASURES = {
    "inner": "inner pressure of the wave, coarser face",
    "inner_finer": "inner pressure of the wave, finer face",
    "p": "L2 of the pressure of the wave, coarser face",
    "p_finer": "L2 of the pressure of the wave, finer face",
    "p_y": "L2 of the pressure of case H, forces y",
    "q_x": "L2 of the shear of case H, forces x",
    "p_n": "L2 of the pressure of case H, r_n of the rows",
    "q_t": "L2 of the shear of case H, r_t of the rows",
}
COLUMNS = "program scene pairing mesh size h_b".split() + list(MEASURES)
COLUMNS += "cpu contact_solves sweeps failed".split()
JUDGED = {"westergaard": ("inner", "inner_finer", "p", "p_finer"), "hertz": ("p_y", "q_x", "p_n", "q_t")}
ALIKE = 1.5  # errors within this factor are no finding
TIMES = 5  # runs of which the median time counts


def times_of(size):
    return 1 if size == "quick" else TIMES


def tasks(size, with_peer):
    """All runs as dictionaries, the program's and those of CalculiX."""
    quick, times = size == "quick", times_of(size)
    for pairing in PAIRINGS:
        for mesh in MESHES if not quick else RATIOS:
            for n in WAVE[:1] if quick else WAVE:
                yield task("bipact", "westergaard", pairing, mesh, n, times)
        for mesh in RATIOS:
            for h in HERTZ[:1] if quick else HERTZ:
                yield task("bipact", "hertz", pairing, mesh, h, times)
    path, version = peers.installed() if with_peer else (None, "")
    if with_peer and path is None:
        print("static pairings: no ccx (CalculiX) is installed; its rows are left out")
    if path is None:
        return
    for mesh in RATIOS:
        for h in PEER[:1] if quick else PEER:
            for dependent in static_peer.DEPENDENT:
                found = task("CalculiX " + version, "hertz", dependent + " dependent", mesh, h, 1)
                yield dict(found, path=path, dependent=dependent)


def task(program, scene, pairing, mesh, size, times):
    names = "program scene pairing mesh size times".split()
    return dict(zip(names, (program, scene, pairing, mesh, size, times)))


def key(run):
    names = "program scene pairing mesh size".split()
    return "|".join(["static"] + [str(run[k]) for k in names])


def options_of(run):
    """Options of its scene. Case H: the flat face has the multipliers of MORTAR."""
    if run["scene"] == "hertz":
        side = "B" if run["pairing"] == "MORTAR" else "AUTO"
        return {"h": run["size"], "ratio": RATIOS[run["mesh"]], "side": side}
    upper, lower = (int(run["size"] * k) for k in MESHES[run["mesh"]])
    return {"upper": upper, "lower": lower, "side": "AUTO"}


def measure(run):
    """One run: its line of results."""
    result = {k: run[k] for k in COLUMNS[:5]}
    if "path" in run:
        found = static_peer.measure(
            run["path"], run["size"], RATIOS[run["mesh"]], run["dependent"]
        )
        return dict(result, **found)
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "run.k"), os.path.join(folder, "out")
        options = dict(options_of(run), pairing=run["pairing"])
        meta = make_scenes.write(deck, run["scene"], **options)
        done = common.run(deck, out, limit=600)
        if done["code"] != 0:
            said = done["errors"].replace(folder + "/", "").splitlines() or ["no word"]
            reason = next((x for x in said if not x.startswith("WARNING")), said[0])
            return dict(result, failed="exit %s: %s" % (done["code"], reason))
        result.update(errors_of(run, meta, out))
        log = common.read_log(out)
        result.update({k: log[k] for k in ("contact_solves", "sweeps")})
        silent = common.without_tables(deck)
        times = [common.run(silent, out)["cpu"] for _ in range(run["times"])]
        return dict(result, cpu=statistics.median(times))


def errors_of(run, meta, folder):
    if run["scene"] == "hertz":
        found = contact_errors.hertz_errors(meta, folder)
        exact, _ = contact_errors.hertz_of(meta, folder)
        found["h_b"] = meta["h"] / exact.half_width
    else:
        upper, lower = MESHES[run["mesh"]]
        coarser = 1 if lower > upper else 2
        names = ("inner", "p"), ("inner_finer", "p_finer")
        found = {}
        for both, side in zip(names, (coarser, 3 - coarser)):
            found.update(zip(both, contact_errors.wave_errors(meta, folder, side)))
    return {k: float(v) for k, v in found.items()}


def study(store, size, jobs, with_peer):
    """All lines of results; those that the store has are not made again."""
    wanted = list(tasks(size, with_peer))
    found = common.sweep(measure, wanted, key, store, jobs)
    return [found[key(run)] for run in wanted]


# ---------------------------------------------------------------- words


def finest(results, scene, pairing, mesh):
    runs = [
        r
        for r in results
        if (r["program"], r["scene"], r["pairing"], r["mesh"])
        == ("bipact", scene, pairing, mesh)
        and "failed" not in r
    ]
    return min(runs, key=lambda r: r["size"] * (-1 if scene == "westergaard" else 1), default=None)


def judged(results):
    """[(kind of mesh, mesh, measure, error of NODE, of MORTAR)] on the finest mesh of each kind."""
    found = []
    for scene, measures in JUDGED.items():
        for mesh in MESHES if scene == "westergaard" else RATIOS:
            node, mortar = (finest(results, scene, p, mesh) for p in PAIRINGS)
            if node is None or mortar is None:
                continue
            kind = mesh.partition(",")[0]
            found += [(kind, mesh, name, node[name], mortar[name]) for name in measures]
    return found


def kind_line(kind, rows):
    """Which pairing has the smaller errors on a kind of mesh, with the clearest figures."""
    groups = {
        "MORTAR smaller": [r for r in rows if r[3] > ALIKE * r[4]],
        "NODE smaller": [r for r in rows if r[4] > ALIKE * r[3]],
        "alike": [r for r in rows if max(r[3:]) <= ALIKE * min(r[3:])],
    }
    words = []
    for name, own in groups.items():
        if own:
            most = max(own, key=lambda r: abs(math.log(r[3] / r[4])))
            figures = MEASURES[most[2]], most[3], most[4]
            which = "at most apart" if name == "alike" else "most"
            words.append("%s in %d of %d (%s: " % (name, len(own), len(rows), which))
            words[-1] += "%s, %.1e and %.1e)" % figures
    return "- Faces %s: %s." % (kind, "; ".join(words))


def time_ratio(results):
    """Geometric mean over all runs of the time of NODE over that of MORTAR."""
    times = {key(r): r["cpu"] for r in results if "cpu" in r}
    logs = []
    for r in results:
        other = key(dict(r, pairing="MORTAR"))
        if r["pairing"] == "NODE" and key(r) in times and other in times:
            logs.append(math.log(times[key(r)] / times[other]))
    return math.exp(sum(logs) / max(1, len(logs)))


def choice_lines(results):
    """What to take, from the results: for choose.md and static.md."""
    rows = judged(results)
    lines = [
        "Errors of NODE and of MORTAR on the finest mesh of each kind; within a factor of %g they are "
        "alike. NODE takes %.2f of the time of MORTAR (geometric mean of all runs). NODE is the "
        "default and right where its errors are alike or smaller, MORTAR elsewhere:"
        % (ALIKE, time_ratio(results)),
        "",
    ]
    kinds = dict.fromkeys(row[0] for row in rows)
    return lines + [kind_line(k, [r for r in rows if r[0] == k]) for k in kinds] + [""]


def cell(value, form="%.1e"):
    return "-" if value is None else form % value


def table(results, scene, measures, sizes):
    """Rows by mesh and size."""
    lines = ["| mesh | %s | pairing | %s | CPU s | contact solves | sweeps |" % (
        sizes, " | ".join(measures))]
    lines.append("|---" * (6 + len(measures)) + "|")
    for r in results:
        if r["scene"] != scene:
            continue
        name = r["pairing"] if r["program"] == "bipact" else "%s, %s" % (r["program"], r["pairing"])
        size = "%d" % r["size"] if scene == "westergaard" else "%g" % r["size"]
        cells = [r["mesh"], size, name]
        if "failed" in r:
            cells += [r["failed"][:60].replace("|", "/")] + (len(measures) + 2) * [""]
        else:
            if scene == "hertz":
                cells[1] += " (%.3f)" % r["h_b"]
            cells += [cell(r.get(k)) for k in measures]
            cells += [cell(r["cpu"], "%.3f"), cell(r.get("contact_solves"), "%d")]
            cells.append(cell(r.get("sweeps"), "%d"))
        lines.append("| %s |" % " | ".join(cells))
    return lines + [""]


HOW = """Westergaard's wave, half contact .45, no friction: edges of the coarser face, SIDE AUTO
(rows on the finer face with NODE, multipliers on the coarser with MORTAR). `inner`: largest error
of a nodal pressure at |x| < .8 a in parts of the largest pressure, on the coarser face,
`inner_finer` on the finer; `p`, `p_finer`: relative L2 of the lines between the nodes."""
HOW_HERTZ = """Case H: two blocks 2 x 1, the upper with the face y = x^2/2, pressed by .003, then dragged by .0007
in five steps, mu .3; h is the edge of the upper face near the middle (h/b), the lower, flat face
has the multipliers of MORTAR. Relative L2 over the nodes of the lower face against Hertz and
Cattaneo for the measured load: `p_y`, `q_x` of the components of nodal forces, `p_n`, `q_t` of
normal and tangential reactions in the frames of the rows. Theory is good to b/R = .04: slopes of
the frame enter `q` by up to b/(R mu) = .13, half of it with NODE on matching faces, whose frame
is the mean of both."""
HOW_PEER = """CalculiX (`bench/static_peer.py`, where `ccx` is installed): the same mesh, one layer of C3D8, surface to surface penalty
10 E/h, its nodal CPRESS and CSHEAR on the dependent face."""


def write_page(results, times, command, out):
    """static.md."""
    lines = ["# Pairings NODE and MORTAR: error against run time in statics", ""]
    lines += [
        "%s, %s. Processor time is user + system of the whole process, tables off, the median of %d "
        "runs (CalculiX: one). Made by `%s` (STATIC=1: this page alone); every run: "
        "[static.csv](static.csv). Decks: `scripts/make_scenes.py westergaard`, `hertz`; errors: "
        "`scripts/contact_errors.py`." % (common.today(), common.machine(), times, command),
        "",
    ]
    lines += choice_lines(results)
    lines += ["![error over run time](static.png)", "", "## Westergaard's wave", "", HOW, ""]
    names = ("inner", "inner_finer", "p", "p_finer")
    lines += table(results, "westergaard", names, "edges")
    lines += ["## Case H: Hertz, Cattaneo, Mindlin", "", HOW_HERTZ, "", HOW_PEER, ""]
    lines += table(results, "hertz", ("p_y", "q_x", "p_n", "q_t"), "h (h/b)")
    with open(os.path.join(out, "static.md"), "w") as file:
        file.write("\n".join(lines))


def write_csv(results, out):
    with open(os.path.join(out, "static.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for r in results:
            writer.writerow({k: "%.4g" % v if isinstance(v, float) else v for k, v in r.items()})


COLOUR = dict(zip(MESHES, ("#000000", "#D55E00", "#E69F00", "#0072B2", "#56B4E9")))
PANELS = (
    ("westergaard", "inner", "wave, inner pressure, coarser face"),
    ("westergaard", "inner_finer", "wave, inner pressure, finer face"),
    ("hertz", "p_n", "case H, L2 of p (r_n)"),
    ("hertz", "q_t", "case H, L2 of q (r_t)"),
)


def draw(results, out):
    """static.png: a line for each pairing and mesh, crosses for CalculiX."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, grid = plt.subplots(2, 2, figsize=(11.5, 8.5))
    for axes, (scene, name, title) in zip(grid.flat, PANELS):
        for mesh, colour in COLOUR.items():
            runs = [r for r in results if (r["scene"], r["mesh"]) == (scene, mesh) and name in r]
            for pairing, look in (("NODE", "o-"), ("MORTAR", "s--")):
                own = [r for r in runs if r["pairing"] == pairing]
                label = "%s, %s" % (pairing, mesh)
                if own:
                    axes.loglog([r["cpu"] for r in own], [r[name] for r in own], look,
                                color=colour, ms=4, lw=1.3, label=label)
            own = [r for r in runs if r["program"] != "bipact"]
            if own:
                axes.loglog([r["cpu"] for r in own], [r[name] for r in own], "x", color=colour,
                            ms=7, label="%s, %s" % (own[0]["program"], mesh))
        axes.set(xlabel="processor time [s]")
        axes.set_title(title, loc="left", fontsize=10)
        axes.grid(True, which="both", alpha=0.2)
        axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(os.path.join(out, "static.png"), dpi=80)
    plt.close(figure)


def write(results, size, command, out):
    write_csv(results, out)
    draw(results, out)
    write_page(results, times_of(size), command, out)
