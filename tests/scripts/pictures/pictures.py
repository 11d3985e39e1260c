"""Pictures of runs of the program: the exact curve is drawn only where it is the scene's, every
id has its line, panels stand as the bodies ask for, bodies in the same place stay apart."""

import contextlib
import io
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from scenes import BIPACT, TMP, bipact, check, finish, make_bars, run_text, table

import exact_scene
import fields
import make_scenes
import plot_fields
import plot_history

FIELDS = "*BIPACT_FIELD\n     1.e-4\n       ALL\n"
figures = []  # what would have been saved


def run_bars(name, cards="", **options):
    """Runs two bars with some cards more; the folder and what make_bars says of the scene."""
    path = os.path.join(TMP, name + ".k")
    options = dict(dict(nx=20, courant=1.0), **options)
    meta = make_bars.write(path, **options)
    with open(path) as file:
        text = file.read()
    folder, code, errors = run_text(name, text.replace("*END", cards + "*END"), "--quiet")
    check(code == 0, "%s: %s" % (name, errors))
    return folder, meta


def same(found, meta, what):
    """A scene that was read is the one that was written; 1e-9: the digits of turned decks."""
    swapped = np.dot(found["axis"], meta["axis"]) < 0.0  # the other bar is the first
    bars = meta["bars"][::-1] if swapped else meta["bars"]
    sign = -1.0 if swapped else 1.0
    for one, other in zip(found["bars"], bars):
        other = dict(other, velocity=sign * other["velocity"])
        for name in ("length", "speed", "impedance", "velocity"):
            close = np.isclose(one[name], other[name], rtol=1e-9, atol=1e-12)
            check(close, "%s: %s %r %r" % (what, name, one[name], other[name]))
    check(np.isclose(found["gap"], meta["gap"], rtol=1e-6), "%s: gap %r" % (what, found["gap"]))
    face = meta["face2" if swapped else "face1"]
    check(sorted(found["face1"]) == sorted(face), what + ": the contact face")
    sides = meta["sides"][::-1] if swapped else meta["sides"]
    check(found["sides"] == sides, "%s: sides %s" % (what, found["sides"]))


def scenes_with_exact_solution():
    """Written in many ways, read as what they are."""
    for name, options in (
        ("plain", {}),
        ("turned", dict(angle=37.0, offset=(3.0, -2.0))),
        ("mirrored", dict(mirror="x", angle=90.0)),
        ("swapped", dict(swap=True)),
        ("unequal", dict(length2=25.0, v2=0.0)),
        ("soft", dict(young2=250.0, density2=2.5e-4)),
        ("random", dict(renumber=3, random=(0.2, 7), ny=3)),
        ("units", dict(scale_length=8.0, scale_time=2.0, scale_mass=0.5)),
        ("friction", dict(mu=0.3, thickness=2.0)),
    ):
        folder, meta = run_bars(name, "*CONTROL_ACCURACY\n         1\n", **options)
        found, why = exact_scene.scene_of(folder)
        check(found is not None, "%s: %s" % (name, why))
        if found:
            same(found, meta, name)
    with open(os.path.join(TMP, "plain.k")) as file:
        text = file.read().replace("        11        12", "        12        11")
    folder, code, errors = run_text("exchanged", text, "--quiet")
    found, why = exact_scene.scene_of(folder)
    check(found is not None and found["sides"] == [2, 1], "sides exchanged: %s" % why)
    path, folder = os.path.join(TMP, "wall.k"), os.path.join(TMP, "wall")
    make_scenes.write(path, "wall", n=20)
    bipact(path, folder, "--quiet")
    found, why = exact_scene.scene_of(folder)
    check(found is not None and found["case"] == "wall", "wall: " + why)
    check(found is not None and np.isclose(found["gap"], 0.01), "wall: the gap")


def scenes_without():
    """Anything else has none, with the reason."""
    load = "*LOAD_BODY_X\n         1       1.0\n*DEFINE_CURVE\n         1\n0.0,1.0\n1.0,1.0\n"
    held = "*BOUNDARY_SPC_SET\n         3                             1\n"
    late = "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n", "\n     0.005"
    for name, options, cards, change, reason in (
        ("poisson", dict(poisson=0.3), "", None, "Poisson"),
        ("shifted", dict(slide=0.2), "", None, "do not cover"),
        ("together", {}, "", ("-&v0", " &v0"), "nothing moves"),
        ("away", {}, "", None, "do not meet"),
        ("heavy", {}, load, None, "*LOAD_BODY_X"),
        ("held", {}, held, None, "*BOUNDARY_SPC_SET"),
        ("late", {}, "", late, "not there all the time"),
        ("tied", {}, "", ("0.0\n*ELEMENT", "0.0       1\n*ELEMENT"), "is held"),
    ):
        path = os.path.join(TMP, name + ".k")
        make_bars.write(path, **dict(dict(nx=20, courant=1.0), **options))
        with open(path) as file:
            text = file.read().replace("*END", cards + "*END")
        if name == "late":
            before, after = text.split(change[0])
            lines = after.split("\n")
            lines[3] = change[1].strip("\n")  # the card after that of the surfaces
            text = before + change[0] + "\n".join(lines)
        elif name == "away":
            text = text.replace("-&v0", "bar2").replace(" &v0", "-&v0").replace("bar2", " &v0")
        elif change:
            text = text.replace(*change)
        folder, code, errors = run_text(name, text, "--quiet")
        check(code == 0, "%s: %s" % (name, errors))
        found, why = exact_scene.scene_of(folder)
        check(found is None and reason in why, "%s: %s" % (name, why))


def labels(axes):
    return [line.get_label() for line in axes.get_lines()]


def exact_curves():
    """Drawn where the deck has the solution, not by a name or a default; a description of
    another scene is refused."""
    step = ["glstat", "nodout", "rcforc=step"]
    exact, meta = run_bars("theta", gap=0.05, tables=step)
    shear, shear_meta = run_bars("like_theta", poisson=0.3, tables=step)
    for kind in ("displacement", "energy", "force"):
        for folder, there in ((exact, True), (shear, False)):
            with contextlib.redirect_stdout(None), contextlib.redirect_stderr(io.StringIO()):
                code = plot_history.main([folder, "--kind", kind, "-o", "x.png"])
            if kind == "displacement" and not there:
                check(code == 1, "displacement: the contact end is not known")
                continue
            check(code == 0, "%s of %s" % (kind, folder))
            found = any("exact" in text for text in labels(figures[-1].axes[0]))
            check(found == there, "%s of %s: exact curve %s" % (kind, folder, found))
    run = plot_history.open_run(exact)
    check(np.isclose(run.exact.touch, 0.025), "the curve is that of the deck's gap")
    run = plot_history.open_run(shear, shear_meta)
    plot_history.displacement(run, "x.png", "described")
    texts = [text.get_text() for text in figures[-1].texts]
    check(labels(figures[-1].axes[0]) == ["computed"], "described, but not its solution")
    check(any("Poisson" in text for text in texts), "the picture says why: %s" % texts)
    try:
        plot_history.open_run(exact, make_bars.describe(nx=20, courant=1.0, gap=0.02))
        check(False, "a description of another scene is taken")
    except plot_history.TableError as problem:
        check("gap" in str(problem), str(problem))
    force_ends()


def force_ends():
    """The panels of the steps around touch and release: the mean is half of the first force in
    its step, and half of the last one step later."""
    folder, _ = run_bars("pulse", mass="DISPERSION", tables=["glstat", "nodout", "rcforc=step"])
    run = plot_history.open_run(folder)
    plot_history.forces_and_ends({"a": run, "b": run}, "x.png", "words")
    for axes, at in zip(figures[-1].axes[2:4], (1.0, 1.0)):
        line = axes.get_lines()[-1]
        steps, mean = line.get_data()
        value = mean[np.isclose(steps, at)]
        check(len(value) == 1 and abs(value[0] - 0.5) < 1e-9, "half a force: %s" % value)


def lines_by_id():
    """One line for each id, with its own rows."""
    folder, meta = run_bars("ids", ny=2, tables=["glstat", "matsum", "nodout", "rcforc"])
    for name, columns, ids, texts in (
        ("nodout", ["ux"], {}, None),
        ("nodout", ["ux", "vmx"], {"node": meta["face1"]}, None),
        ("matsum", ["kinetic"], {}, ["kinetic [F L], part 1", "kinetic [F L], part 2"]),
        ("rcforc", ["fx"], {}, ["fx [F], side 1", "fx [F], side 2"]),
        ("rcforc", ["fx"], {"side": 2}, ["fx [F]"]),
        ("glstat", ["total", "contact"], {}, ["total [F L]", "contact [F L]"]),
    ):
        plot_history.columns(folder, name, columns, "x.png", ids=ids)
        lines = figures[-1].axes[0].get_lines()
        if texts:
            check(
                labels(figures[-1].axes[0]) == texts, "%s: %s" % (name, labels(lines[0].axes))
            )
        if name == "nodout":
            nodes = ids.get("node", sorted(set(table(folder, name)["node"])))
            check(len(lines) == len(nodes) * len(columns), "%s: %d lines" % (name, len(lines)))
            for line in lines:
                node = int(line.get_label().split()[-1])
                column = line.get_label().split()[0]
                rows = table(folder, name, node=node)
                right = np.array_equal(line.get_ydata(), rows[column])
                check(right, "%s: the rows of node %d" % (column, node))
        looks = {(line.get_color(), line.get_linewidth()) for line in lines}
        check(len(looks) == len(lines), "%s: lines that look alike" % name)


def panels():
    """Long bodies below each other, others side by side; axes named; both bodies outlined."""
    long, _ = run_bars("long", FIELDS, ny=2)
    square = os.path.join(scenes.ROOT, "input", "lessons", "inner_corner.k")
    with open(square) as file:
        text = file.read().replace("*END", FIELDS.replace("1.e-4", "0.01") + "*END")
    square, code, errors = run_text("square", text, "--quiet")
    check(code == 0, errors)
    for folder, below in ((long, True), (square, False)):
        picture = plot_fields.Picture(folder, "STRESS:xx")
        plot_fields.snapshots(picture, os.path.join(TMP, "x.png"), 1.0)
        places = np.array([axes.get_position().bounds[:2] for axes in figures[-1].axes[:-1]])
        stacked = np.ptp(places[:, 0]) < 1e-3 and np.ptp(places[:, 1]) > 0.3
        check(stacked == below, "%s: panels %s" % (folder, places.tolist()))
        words = {axes.get_xlabel() for axes in figures[-1].axes}
        words |= {axes.get_ylabel() for axes in figures[-1].axes}
        wanted = {"x [L]", "y [L]", "stress xx [F/L^2]"}
        check(wanted <= words, "%s: the axes are named: %s" % (folder, words))
    run = fields.Fields(long)
    picture = plot_fields.Picture(long, "V:x")
    bodies = plot_fields.bodies_of(run)
    check(len(set(bodies)) == 2, "two bodies")
    around = 2 * (2 * 20 + 2 * 2)
    check(len(picture.edges) == around, "outlines of %d edges" % len(picture.edges))
    check(picture.label == "velocity x [L/T]", picture.label)


def glued_parts():
    """The border of two parts that share nodes is drawn, with the field PART or without."""
    text = make_glued()
    for names in ("         U      PART", "         U"):
        card = "*BIPACT_FIELD\n      0.01\n%s\n*END" % names
        folder, code, errors = run_text("glued", text.replace("*END", card), "--quiet")
        check(code == 0, errors)
        picture = plot_fields.Picture(folder, "U:x")
        check(len(picture.edges) == 7, "glued parts: %d edges, not 7" % len(picture.edges))


def make_glued():
    """Two squares side by side that share two nodes, each a part."""
    nodes = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)]
    lines = ["%8d%16.1f%16.1f" % (k + 1, x, y) for k, (x, y) in enumerate(nodes)]
    return (
        "*KEYWORD\n*CONTROL_TERMINATION\n      0.05\n*CONTROL_IMPLICIT_GENERAL\n"
        "         1      0.01\n*CONTROL_IMPLICIT_DYNAMICS\n         1\n*BIPACT_TIME\n"
        "     THETA       0.5\n*NODE\n%s\n*ELEMENT_SHELL\n"
        "       1       1       1       2       5       4\n"
        "       2       2       2       3       6       5\n"
        "*PART\none\n         1         1         1\n"
        "*PART\ntwo\n         2         1         1\n"
        "*SECTION_SHELL\n         1        13                   4\n       1.0\n"
        "*MAT_ELASTIC\n         1       1.0    1000.0       0.0\n"
        "*INITIAL_VELOCITY\n\n       1.0\n*END\n"
    ) % "\n".join(lines)


def coincident_nodes():
    """Bars whose faces are in the same place at the start: each keeps its own column there."""
    folder, _ = run_bars("touching", FIELDS, gap=0.0, tend=0.01)
    run = fields.Fields(folder)
    found = plot_fields.strips(plot_fields.Picture(folder, "V:x"), 0)
    check(len(found) == 2, "two bodies, two strips")
    ends = found[0][0].max(), found[1][0].min()
    check(ends == (0.0, 0.0), "both have a column at the face: %s" % (ends,))
    first = found[0][1][0, -1], found[1][1][0, 0]
    check(first == (1.0, -1.0), "with their own velocities: %s" % (first,))
    path = os.path.join(TMP, "x.png")
    plot_fields.over_place_and_time(plot_fields.Picture(folder, "V:x"), path)
    meshes = [c for c in figures[-1].axes[0].collections if hasattr(c, "get_coordinates")]
    check(len(meshes) == 2, "two meshes of colours")
    right = meshes[0].get_coordinates()[..., 0].max(), meshes[1].get_coordinates()[..., 0].min()
    check(right == (0.0, 0.0), "they end where the bodies end: %s" % (right,))
    check(len(run.times) > 10 and figures[-1].axes[0].get_ylabel() == "t [T]", "time is named")


def keep_figures():
    """Figures are kept for the checks and not closed."""
    import matplotlib.pyplot as plt

    def kept(figure, path):
        figure.canvas.draw()
        figures.append(figure)
        return path

    plot_history.finish = kept
    plt.close = figures.append
    plot_fields.plt.close = figures.append


if __name__ == "__main__":
    if not os.path.exists(BIPACT.replace("bin/bipact", "bin/bipact-hdf5")):
        print("bipact-hdf5 is not built: pictures NOT tested")
        sys.exit(77)
    keep_figures()
    scenes_with_exact_solution()
    scenes_without()
    exact_curves()
    lines_by_id()
    panels()
    glued_parts()
    coincident_nodes()
    finish()
