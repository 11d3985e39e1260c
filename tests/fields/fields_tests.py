"""Field files against the tables, and what the card says against what is in them."""

import glob
import os
import shutil
import sys
import xml.etree.ElementTree as tree

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from full_disk import on_small_disk, one_message, starved
from scenes import BIPACT, TMP, at_most, bipact, check, finish, make_bars, run_text, show, table

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
    """The sidecar points to the frames."""
    check_index(run, folder, "XDMF")
    check(len(run.times) > 10, "XDMF: %d frames" % len(run.times))
    # In the plane xz and yz are 0: where they come from shows in the definition of the view.
    with h5py.File(run.paths[0], "r") as file:
        parts = file["XDMF/STRESS"].virtual_sources()
    columns = {first_column(p.vspace): first_column(p.src_space) for p in parts}
    check([columns.get(k) for k in range(6)] == TENSOR6, "XDMF: the order of a Tensor6")


def check_index(run, folder, what):
    """Each hyperslab of each attribute of fields.xdmf, read by hand."""
    root = tree.parse(os.path.join(folder, "fields.xdmf")).getroot()
    grids = root.findall("./Domain/Grid/Grid")
    times = [float(g.find("Time").get("Value")) for g in grids]
    check(np.array_equal(times, run.times), what + ": the times, to the last digit")
    wrong, files = 0, {}
    for k, grid in enumerate(grids):
        for attribute in grid.findall("Attribute"):
            slab, data = attribute.find("DataItem").findall("DataItem")
            numbers = np.array(slab.text.split(), int).reshape(3, -1)
            name, path = data.text.split(":")
            if name not in files:
                files[name] = h5py.File(os.path.join(folder, name), "r")
            first, count = int(numbers[0, 0]), int(numbers[2, 0])
            values = files[name][path][first : first + count]
            values_of_run = run.frame(k, attribute.get("Name"))
            if values_of_run.shape[1:] == (6,):
                check(attribute.get("AttributeType") == "Tensor6", what + ": Tensor6")
                values_of_run = values_of_run[:, TENSOR6]
            wrong += values.tobytes() != values_of_run.tobytes()
    for file in files.values():
        file.close()
    check(len(grids) > 0 and not wrong, "%s: %d attributes point elsewhere" % (what, wrong))


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


def full_disk():
    """A limit on the size of files, a small disk: exit 3, one message, and what is left are whole
    frames of the whole run, as many as there is room for, and an index that names these."""
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"  # of a file whose last write failed
    for name, text, alone in cut_short_scenes():
        deck, folder = os.path.join(TMP, name + ".k"), os.path.join(TMP, name)
        with open(deck, "w") as file:
            file.write(text)
        code, errors, _ = bipact(deck, folder, "--quiet")
        check(code == 0, errors)
        whole = fields.Fields(folder)
        frames = {name: whole.history(name) for name in whole.names}
        size = max(os.path.getsize(p) for p in whole.paths)
        cut = os.path.join(TMP, "cut")
        for share in (0.1, 0.8):
            shutil.rmtree(cut, ignore_errors=True)
            done = starved(deck, cut, bytes_of_file=int(share * size))
            what = "%s, files of %.0f %%" % (name, 100 * share)
            one_message(*done, "cannot write", what)
            least = frames_for(share * size, whole) if alone else share > 0.5
            enough(cut, whole, frames, least, what)
        for kilobytes in (100, 500, int(0.7e-3 * size)):
            what = "%s, disk of %d kB" % (name, kilobytes)
            done = on_small_disk("%dk" % kilobytes, deck, cut)
            if done is None:
                print("note: no small file system can be mounted here: NOT tested on one")
                break
            one_message(*done, "cannot write", what)
            others = sum(os.path.getsize(os.path.join(cut, n)) for n in os.listdir(cut))
            others -= sum(os.path.getsize(p) for p in vtkhdf_files(cut))
            others += 32 * 2000 + 8192  # frames ahead of which the index has room, pages
            room = 1024 * kilobytes - others
            least = frames_for(room, whole) if alone else kilobytes > 500
            enough(cut, whole, frames, least, what)


def cut_short_scenes():
    """(name, deck, is one field file all that grows?): every step, so that memory is full now
    and then; compressed; with tables, which may fail first; with segments at restarts."""
    options = dict(nx=40, ny=3, courant=0.4, touch=0.5, mu=0.3, slide=0.3)
    plain, _ = deck_text("plain", "", tables=["glstat"], **options)
    yield "fields", plain.replace("*END", field_card(1e-9, "U V STRESS PART") + "*END"), True
    small = field_card(1e-9, "ALL", compression=4, bits=32)
    yield "compressed", plain.replace("*END", small + "*END"), False
    tables, _ = deck_text("tables", "", output="step", **options)
    yield "tables", tables.replace("*END", field_card(1e-9, "U STRESS") + "*END"), False
    segments = field_card(1e-9, "U STRESS") + "*BIPACT_RESTART\n       120\n"
    yield "segments", plain.replace("*END", segments + "*END"), False


def vtkhdf_files(folder):
    return sorted(glob.glob(os.path.join(folder, "fields.*.vtkhdf")))


def whole_frames(folder, whole, frames, what):
    """How many frames are in a folder: all of them those of the whole run, all in the index, and
    nothing else."""
    left = [n for n in os.listdir(folder) if n.startswith("fields.")]
    check(not [n for n in left if n.endswith(".tmp")], "%s: %s" % (what, left))
    index = os.path.join(folder, "fields.xdmf")
    if not vtkhdf_files(folder):
        check(not left, "%s: nothing is left without frames: %s" % (what, left))
        return 0
    run = fields.Fields(folder)
    count = len(run.times)
    check(count > 0, what + ": a file has frames or is not there")
    check(np.array_equal(run.times, whole.times[:count]), what + ": the first frames")
    for name in run.names:
        right = run.history(name).tobytes() == frames[name][:count].tobytes()
        check(right, "%s: the numbers of %s" % (what, name))
    check(os.path.exists(index), what + ": the index is there")
    if os.path.exists(index):
        check_index(run, folder, what)
    return count


def frames_for(room, whole):
    """Frames that a field file of a size must hold: all but what its mesh and heads, the list
    entries and two nodes of the tree of each data set (as store_fields reckons), and the rest of
    a chunk of each field (128 KiB at most) may take."""
    one = sum(whole.frame(0, n).nbytes for n in whole.names if n != "PART")
    size, count = os.path.getsize(whole.paths[0]), len(whole.times)
    sets = 2 * len(whole.names) + 6
    around = size - count * one + sets * (8 * 256 + 5400)
    around += (len(whole.names) + 1) * (2**17 + 200)
    return max(0, int((room - around) // one))


def enough(cut, whole, frames, least, what):
    """What is left in a folder is right and not too little."""
    found = whole_frames(cut, whole, frames, what)
    show("%-36s %4d frames of %4d, at least %4d" % (what, found, len(whole.times), least))
    check(found >= least, "%s: %d frames, %d expected" % (what, found, least))


if __name__ == "__main__":
    hdf5 = BIPACT.replace("bin/bipact", "bin/bipact-hdf5")
    if not os.path.exists(hdf5):
        print("%s is not built: field files NOT tested" % hdf5)
        sys.exit(77)
    globals()[sys.argv[1]]()
    finish()
