"""Field files against the tables, and what the card says against what is in them."""

import os
import sys
import xml.etree.ElementTree as tree

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from scenes import BIPACT, TMP, at_most, bipact, check, finish, make_bars, run_text, table

import fields
import make_scenes

# xx, xy, xz, yy, yz, zz, as XDMF has a Tensor6, among our xx, yy, zz, xy, yz, xz.
TENSOR6 = [0, 3, 5, 1, 4, 2]
NAMES = "U V FORCE PRESSURE GAP STATUS STRESS ENERGY PRINCIPAL PART".split()


def field_card(dt, names="ALL", part_set="", compression="", bits="", begin="", end=""):
    first = "*BIPACT_FIELD\n%10.3e%10s%10s%10s%10s%10s\n"
    text = first % (dt, part_set, compression, bits, begin, end)
    words = names.split()
    for k in range(0, len(words), 8):
        text += "".join("%10s" % w for w in words[k : k + 8]) + "\n"
    return text


def deck_text(name, card, **options):
    path = os.path.join(TMP, name + ".k")
    write = make_scenes.write if "scene" in options else make_bars.write
    meta = write(path, **options)
    with open(path) as file:
        return file.read().replace("*END", card + "*END"), meta


def histories(nodes, elements):
    """Cards of tables for all nodes and elements."""
    text = "*DATABASE_HISTORY_NODE\n"
    for k in range(0, len(nodes), 8):
        text += "".join("%10d" % n for n in nodes[k : k + 8]) + "\n"
    text += "*DATABASE_HISTORY_SHELL\n"
    for k in range(0, len(elements), 8):
        text += "".join("%10d" % e for e in elements[k : k + 8]) + "\n"
    return text


def ids_of(text):
    """Ids of nodes and elements of a deck, in its order, which is that of the fields."""
    found = {"*NODE": [], "*ELEMENT_SHELL": []}
    keyword = None
    for line in text.splitlines():
        if line.startswith("*"):
            keyword = line.strip()
        elif keyword in found and not line.startswith("$"):
            field = line.split(",")[0] if "," in line else line[:8]
            found[keyword].append(int(field))
    return found["*NODE"], found["*ELEMENT_SHELL"]


def tables():
    """Every field at every frame is what the tables say at that time: the same numbers where
    both are copies (U, V, FORCE, PRESSURE, GAP, STATUS, PART), to round-off where they are
    computed in another order (STRESS, ENERGY: 1e-12 of the largest)."""
    common = dict(nx=12, ny=2, courant=0.5, touch=0.5, mu=0.3, slide=0.3, poisson=0.3)
    text, meta = deck_text("tables", "", **common)
    nodes, elements = ids_of(text)
    dt = meta["dt"]
    cards = field_card(3.0 * dt)
    for name in ("NODOUT", "ELOUT", "NCFORC"):
        text = without(text, "DATABASE_" + name)
        cards += "*DATABASE_%s\n%10.3e\n" % (name, 3.0 * dt)
    text = without(without(text, "DATABASE_HISTORY_NODE"), "DATABASE_HISTORY_SHELL")
    text = text.replace("*END", cards + histories(nodes, elements) + "*END")
    folder, code, errors = run_text("tables", text)
    check(code == 0, errors)
    run = fields.Fields(folder)
    check(sorted(run.names) == sorted(NAMES), "ALL: %s" % sorted(run.names))
    nodout, elout, ncforc = (table(folder, n) for n in ("nodout", "elout", "ncforc"))
    times = nodout["time"].reshape(-1, len(nodes))[:, 0]
    check(np.array_equal(times, run.times), "the times of frames are those of rows")
    shape = (len(times), len(nodes))
    for name, columns in (("U", "ux uy uz"), ("V", "vmx vmy vmz")):
        rows = np.stack([nodout[c].reshape(shape) for c in columns.split()], axis=2)
        check(np.array_equal(rows, run.history(name)), name)
    shape = (len(times), len(elements))
    columns = "sxx syy szz sxy syz szx".split()
    rows = np.stack([elout[c].reshape(shape) for c in columns], axis=2)
    stress = run.history("STRESS")
    at_most(np.abs(rows - stress).max(), 1e-12 * np.abs(rows).max(), "STRESS")
    energy = elout["energy"].reshape(shape)
    at_most(np.abs(energy - run.history("ENERGY")).max(), 1e-12 * energy.max(), "ENERGY")
    check(np.array_equal(elout["part"].reshape(shape)[0], run.frame(0, "PART")), "PART")
    tensor = np.zeros(stress.shape[:2] + (3, 3))
    for k, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))):
        tensor[..., i, j] = tensor[..., j, i] = stress[..., k]
    principal = np.linalg.eigvalsh(tensor)[..., ::-1]
    off = np.abs(principal - run.history("PRINCIPAL")).max()
    at_most(off, 1e-12 * np.abs(principal).max(), "PRINCIPAL: eigenvalues, the largest first")
    contact_fields(run, ncforc, nodes)


def without(text, keyword):
    """A deck without a keyword and its cards."""
    out, inside = [], False
    for line in text.splitlines(True):
        if line.startswith("*"):
            inside = line.strip() == "*" + keyword
        if not inside:
            out.append(line)
    return "".join(out)


def contact_fields(run, ncforc, nodes):
    """FORCE, PRESSURE, GAP and STATUS by the rows of NCFORC: nodes without a row are free."""
    place = {n: k for k, n in enumerate(nodes)}
    force = np.zeros((len(run.times), len(nodes), 3))
    pressure = np.zeros(force.shape[:2])
    gap = np.full(force.shape[:2], np.nan)
    status = np.full(force.shape[:2], -1)
    frame_of = {t: k for k, t in enumerate(run.times)}
    surface = run.history("STATUS") >= 0
    for r in range(len(ncforc["time"])):
        k, n = frame_of[ncforc["time"][r]], place[ncforc["node"][r]]
        force[k, n] += [ncforc[c][r] for c in ("fx", "fy", "fz")]
        pressure[k, n] += ncforc["pressure"][r]
        if ncforc["gap"][r] < 1e99:
            gap[k, n] = ncforc["gap"][r]
        status[k, n] = max(status[k, n], ncforc["status"][r])
    check(np.abs(force).max() > 0 and (status == 2).any(), "the bodies touch and slip")
    check(np.array_equal(force, run.history("FORCE")), "FORCE")
    check(np.array_equal(pressure, run.history("PRESSURE")), "PRESSURE")
    check(np.array_equal(gap, run.history("GAP"), equal_nan=True), "GAP")
    check(
        np.array_equal(np.maximum(status, np.where(surface, 0, -1)), run.history("STATUS")),
        "STATUS",
    )
    check((surface == surface[0]).all() and not surface.all(), "surfaces stay the same")
    total = run.history("FORCE").sum(axis=1)
    at_most(np.abs(total).max(), 1e-12 * np.abs(force).max(), "forces of both sides cancel")


def options():
    """DT, TBEG, TEND, PSID, COMPR, PREC, names, the default, D3PLOT, walls; no card, no file."""
    common = dict(nx=12, ny=2, courant=0.5, touch=0.5)
    text, meta = deck_text("plain", "", **common)
    dt, end = meta["dt"], meta["dt"] * meta["steps"]
    folder, code, errors = run_text("all", text.replace("*END", field_card(4.0 * dt) + "*END"))
    check(code == 0, errors)
    whole = fields.Fields(folder)
    expected = due_times(float("%10.3e" % (4.0 * dt)), dt, meta["steps"])
    check(len(expected) == len(whole.times), "DT: %d frames" % len(whole.times))
    at_most(np.abs(whole.times - expected).max(), 1e-12 * end, "DT: the times")
    card = field_card(4.0 * dt, "U PART", compression=6, begin="%10.3e" % (0.3 * end))
    folder, code, errors = run_text("few", text.replace("*END", card + "*END"))
    run = fields.Fields(folder)
    check(code == 0 and sorted(run.names) == ["PART", "U"], "names: %s" % sorted(run.names))
    check(run.times[0] >= 0.3 * end - dt * 1e-6, "TBEG")
    at = len(whole.times) - len(run.times)
    check(
        np.array_equal(run.history("U"), whole.history("U")[at:]),
        "compressed: the same numbers",
    )
    with h5py.File(run.paths[0], "r") as file:
        check(file["VTKHDF/PointData/U"].compression == "gzip", "COMPR 6 compresses")
    card = field_card(4.0 * dt, bits=32, end="%10.3e" % (0.5 * end))
    folder, code, errors = run_text("single", text.replace("*END", card + "*END"))
    run = fields.Fields(folder)
    check(code == 0 and run.times[-1] <= 0.5 * end * (1 + 1e-9), "TEND: %s" % errors)
    one, other = run.history("STRESS"), whole.history("STRESS")[: len(run.times)]
    check(one.dtype == np.float32, "PREC 32")
    check(np.array_equal(one, other.astype(np.float32)), "PREC 32: rounded")
    sets = "*SET_PART_LIST\n%10d\n%10d\n" % (977, 2)
    card = sets + field_card(4.0 * dt, "U STRESS PART", part_set=977)
    folder, code, errors = run_text("part", text.replace("*END", card + "*END"))
    check(code == 0, errors)
    run = fields.Fields(folder)
    cells = whole.frame(0, "PART") == 2
    used = np.unique(np.concatenate([c for c, k in zip(whole.cells, cells) if k]))
    check(np.array_equal(run.points, whole.points[used]), "PSID: the nodes of the part")
    check(np.array_equal(run.history("U"), whole.history("U")[:, used]), "PSID: U")
    check(
        np.array_equal(run.history("STRESS"), whole.history("STRESS")[:, cells]), "PSID: STRESS"
    )
    check(
        all(
            np.array_equal(used[a], b)
            for a, b in zip(run.cells, [c for c, k in zip(whole.cells, cells) if k])
        ),
        "PSID: cells",
    )
    card = "*DATABASE_BINARY_D3PLOT\n%10.3e\n" % (4.0 * dt)
    folder, code, errors = run_text("d3plot", text.replace("*END", card + "*END"))
    run = fields.Fields(folder)
    check(code == 0 and sorted(run.names) == ["STRESS", "U", "V"], "D3PLOT: %s" % errors)
    check(np.array_equal(run.history("V"), whole.history("V")), "D3PLOT: V")
    both = card + field_card(8.0 * dt, "U")
    folder, code, errors = run_text("both", text.replace("*END", both + "*END"))
    run = fields.Fields(folder)
    check(code == 0 and sorted(run.names) == ["U"], "the own card wins")
    log(folder, "NOTE", "has no effect beside *BIPACT_FIELD")
    folder, code, errors = run_text("both", text)
    check(
        not [n for n in os.listdir(folder) if n.startswith("fields")],
        "no card: the old files go",
    )
    xdmf(whole, os.path.join(TMP, "all"))
    wall()


def due_times(interval, dt, steps):
    """The first step end at or after each multiple of the interval, and the last."""
    times, next_due = [], 0
    for k in range(steps + 1):
        if k * dt >= next_due * interval - 1e-9 * dt or k == steps:
            times.append(k * dt)
            next_due = int((k * dt + 1e-9 * dt) / interval) + 1
    return np.array(times)


def log(folder, word, text):
    with open(os.path.join(folder, "bipact.log")) as file:
        found = [l for l in file if l.startswith(word) and text in l]
    check(len(found) == 1, "%s %s in the log" % (word, text))


def xdmf(run, folder):
    """The sidecar points to the frames: each hyperslab of each attribute, read by hand."""
    root = tree.parse(os.path.join(folder, "fields.xdmf")).getroot()
    grids = root.findall("./Domain/Grid/Grid")
    times = [float(g.find("Time").get("Value")) for g in grids]
    check(np.array_equal(times, run.times), "XDMF: the times, to the last digit")
    wrong = 0
    for k, grid in enumerate(grids):
        for attribute in grid.findall("Attribute"):
            slab, data = attribute.find("DataItem").findall("DataItem")
            numbers = np.array(slab.text.split(), int).reshape(3, -1)
            name, path = data.text.split(":")
            with h5py.File(os.path.join(folder, name), "r") as file:
                first, count = int(numbers[0, 0]), int(numbers[2, 0])
                values = file[path][first : first + count]
            values_of_run = run.frame(k, attribute.get("Name"))
            if values_of_run.shape[1:] == (6,):
                check(attribute.get("AttributeType") == "Tensor6", "XDMF: STRESS is a Tensor6")
                values_of_run = values_of_run[:, TENSOR6]
            wrong += values.tobytes() != values_of_run.tobytes()
    check(len(grids) > 10 and not wrong, "XDMF: %d attributes point elsewhere" % wrong)
    # In the plane xz and yz are 0: where they come from shows in the definition of the view.
    with h5py.File(run.paths[0], "r") as file:
        parts = file["XDMF/STRESS"].virtual_sources()
    columns = {first_column(p.vspace): first_column(p.src_space) for p in parts}
    check([columns.get(k) for k in range(6)] == TENSOR6, "XDMF: the order of a Tensor6")


def first_column(space):
    """The second index at which a regular selection begins."""
    return space.get_regular_hyperslab()[0][1]


def wall():
    """Forces at a rigid wall are the negative of nothing: their sum is the row of RWFORC."""
    path = os.path.join(TMP, "wall.k")
    meta = make_scenes.write(path, "wall", n=20)
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(text.replace("*END", field_card(1.0e-9, "FORCE STATUS") + "*END"))
    folder = os.path.join(TMP, "wall")
    code, errors, _ = bipact(path, folder, "--quiet")
    check(code == 0, errors)
    run, rows = fields.Fields(folder), table(folder, "rwforc")
    total = run.history("FORCE").sum(axis=1)
    picked = {t: k for k, t in enumerate(run.times)}
    found = np.array([total[picked[t], 0] for t in rows["time"]])
    largest = np.abs(rows["fx"]).max()
    check(largest > 0, "the bar hits the wall")
    at_most(np.abs(found - rows["fx"]).max(), 1e-12 * largest, "wall: FORCE is RWFORC")


if __name__ == "__main__":
    hdf5 = BIPACT.replace("bin/bipact", "bin/bipact-hdf5")
    if not os.path.exists(hdf5):
        print("%s is not built: field files NOT tested" % hdf5)
        sys.exit(77)
    globals()[sys.argv[1]]()
    finish()
