"""Other programs on scenes of the report (make report PEERS=1): decks written here, run as their
users run them, their points beside those of the study. What is not installed is left out, with a
message.

CalculiX (ccx): the plane is one layer of C3D8 held across it; *DYNAMIC of Hilber, Hughes and Taylor
with its default alpha -0.05, increments of at most the step of the study (it cuts them at impacts); contact of surfaces by a linear penalty of 10 E/h.
With that alpha the block with friction finds no increment at its touch ("too many cutbacks"): it
takes -0.3 there, and friction sticks by a tenth of the penalty.
"""

import json
import math
import os
import re
import shutil
import subprocess
import tempfile

import common
import numpy as np
import report_scenes
from analytic import impact_of

CCX = ("ccx", "ccx_2.20", "ccx_2.21", "ccx_2.22")
RUNS = [("unaligned", n, 0.5) for n in (25, 50, 100)] + [("block", n, 0.5) for n in (8, 16, 32)]
ALPHA = {"unaligned": -0.05, "block": -0.3}
PENALTY = 10.0  # x E/h
STICK = 0.1  # of the penalty


def installed():
    """(path of ccx or None, its version)."""
    path = next((p for p in map(shutil.which, CCX) if p), None)
    if path is None:
        return None, ""
    said = subprocess.run([path, "-v"], capture_output=True, text=True)
    match = re.search(r"[Vv]ersion\s+(\S+)", said.stdout + said.stderr)
    return path, match.group(1) if match else "?"


class Mesh:
    """Rectangles of one layer of C3D8: nodes {id: (x, y, z)}, elements, sets."""

    def __init__(self):
        self.nodes, self.elements = {}, []

    def rectangle(self, x0, y0, width, height, nx, ny):
        """Adds one; returns ids[i, j, layer] and element ids[i, j]."""
        ids = len(self.nodes) + 1 + np.arange(2 * (nx + 1) * (ny + 1)).reshape(nx + 1, ny + 1, 2)
        for i in range(nx + 1):
            for j in range(ny + 1):
                for k in range(2):
                    place = x0 + width * i / nx, y0 + height * j / ny, float(k)
                    self.nodes[int(ids[i, j, k])] = place
        cells = np.zeros((nx, ny), int)
        for i in range(nx):
            for j in range(ny):
                flat = [ids[i, j], ids[i + 1, j], ids[i + 1, j + 1], ids[i, j + 1]]
                self.elements.append([int(c[0]) for c in flat] + [int(c[1]) for c in flat])
                cells[i, j] = len(self.elements)
        return ids, cells


def listed(ids):
    ids = [str(int(i)) for i in np.ravel(ids)]
    return [", ".join(ids[k : k + 12]) + "," for k in range(0, len(ids), 12)]


# Faces of C3D8 as written above: S3 y low, S4 x high, S5 y high, S6 x low.
def surface(name, cells, face):
    return ["*SURFACE, NAME=%s" % name] + ["%d, %s" % (c, face) for c in np.ravel(cells)]


def deck(mesh, law, sets, surfaces, held, velocities, mu, h, increments, watched):
    """The whole input."""
    young, poisson, density = law
    stiff = PENALTY * young / h
    out = ["*NODE, NSET=NALL"]
    out += ["%d, %r, %r, %r" % ((i,) + p) for i, p in mesh.nodes.items()]
    out += ["*ELEMENT, TYPE=C3D8, ELSET=EALL"]
    out += ["%d, %s" % (k, ", ".join(map(str, e))) for k, e in enumerate(mesh.elements, 1)]
    for name, ids in sets.items():
        out += ["*NSET, NSET=" + name] + listed(ids)
    out += surfaces
    out += ["*MATERIAL, NAME=M", "*ELASTIC", "%r, %r" % (young, poisson)]
    out += ["*DENSITY", "%r," % density, "*SOLID SECTION, ELSET=EALL, MATERIAL=M"]
    out += ["*SURFACE INTERACTION, NAME=I", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"]
    out += ["%r, %r" % (stiff, 1.0e-3 * young)]
    out += ["*FRICTION", "%r, %r" % (mu, STICK * stiff)] if mu else []
    out += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER"]
    out += ["*BOUNDARY", "NALL, 3, 3"] + (["%s, 1, 2" % held] if held else [])
    out += ["*INITIAL CONDITIONS, TYPE=VELOCITY"]
    out += ["%s, %d, %r" % item for item in velocities]
    out += ["*STEP, INC=1000000", "*DYNAMIC, ALPHA=%r" % increments[0]]
    dt, tend = increments[1:]
    out += ["%r, %r, %r, %r" % (dt, tend, 1.0e-6 * dt, dt)]
    out += ["*NODE PRINT, NSET=%s, FREQUENCY=1" % watched, "U, V"]
    out += ["*EL PRINT, ELSET=EALL, TOTALS=ONLY, FREQUENCY=1", "ELSE, ELKE", "*END STEP", ""]
    return "\n".join(out)


def bars(meta, n):
    """Two bars as make_bars.py describes them."""
    mesh, gap = Mesh(), meta["gap"]
    left, cells1 = mesh.rectangle(-10.0 - 0.5 * gap, 0.0, 10.0, 1.0, n, 1)
    right, cells2 = mesh.rectangle(0.5 * gap, 0.0, 10.0, 1.0, n, 1)
    surfaces = surface("SLAVE", cells1[-1], "S4") + surface("MASTER", cells2[0], "S6")
    sets = {"LEFT": left, "RIGHT": right, "TIP": left[-1]}
    moves = [("LEFT", 1, 1.0), ("RIGHT", 1, -1.0)]
    law = 1000.0, 0.0, 1.0e-3
    increments = ALPHA["unaligned"], meta["dt"], meta["tend"]
    return deck(mesh, law, sets, surfaces, None, moves, 0.0, 10.0 / n, increments, "TIP"), mesh


def block(meta, n):
    """The thrown block of make_scenes.py on a held body."""
    mesh = Mesh()
    ids, cells = mesh.rectangle(0.0, 0.01, 1.0, 1.0, n, n)
    low, ground = mesh.rectangle(-1.0, -1.0, 3.0, 1.0, 3, 1)
    surfaces = surface("SLAVE", cells[:, 0], "S3") + surface("MASTER", ground, "S5")
    moves = [("BLOCK", 1, 0.3), ("BLOCK", 2, -1.0)]
    young = 1.0e4 * 1.3 * 0.4 / 0.7
    sets = {"BLOCK": ids, "GROUND": low}
    law = young, 0.3, 1.0
    increments = ALPHA["block"], meta["dt"], meta["tend"]
    text = deck(mesh, law, sets, surfaces, "GROUND", moves, 0.3, 1.0 / n, increments, "BLOCK")
    mesh.shares = np.ones((n + 1, n + 1, 2)) / (2.0 * n * n)
    mesh.shares[[0, -1]] *= 0.5
    mesh.shares[:, [0, -1]] *= 0.5
    mesh.middle = int(ids[n // 2, 0, 0])
    return text, mesh


def read_blocks(path):
    """{what: {time: rows}} of a .dat file; rows of totals are single numbers."""
    found, rows = {}, None
    with open(path) as file:
        for line in file:
            match = re.match(r"\s*(.+?) (?:\(.*\) )?for set \S+ and time\s+(\S+)", line)
            if match:
                rows = []
                found.setdefault(match.group(1).strip(), {})[float(match.group(2))] = rows
            elif line.strip() and rows is not None:
                rows.append([float(x) for x in line.split()])
    return found


def series(blocks):
    """(times, array of rows) by increasing time."""
    times = sorted(blocks)
    return np.array(times), np.array([blocks[t] for t in times])


def errors_of(scene, meta, mesh, path):
    """Errors as report_scenes.py defines them, of what CalculiX prints."""
    found = read_blocks(path)
    t, u = series(found["displacements"])
    v = series(found["velocities"])[1]
    energy = sum(series(found[k])[1][:, 0, 0] for k in found if k.startswith("total"))
    if scene == "unaligned":
        exact = impact_of(meta, meta["tend"])
        # Increments are short at impacts: compared at the steps of the study.
        even = meta["dt"] * np.arange(1, int(t[-1] / meta["dt"]) + 1)
        tip = np.interp(even, t, u[:, :, 1].mean(axis=1))
        wanted = exact.tip(t)
        speed = (wanted - exact.tip(t - 0.01 * meta["dt"])) / (0.01 * meta["dt"])
        return {
            "err": report_scenes.relative(tip, exact.tip(even)),
            "e_v": np.sum(np.abs(v[:, :, 1].mean(axis=1) - speed) * np.diff(t, prepend=0.0))
            / (meta["v0"] * t[-1]),
            "energy": abs(energy[-1] / exact.energy - 1.0),
        }
    kept = report_scenes.kept_reference(scene)
    times = np.array(kept["time"])
    ids = np.argsort([int(k) for k in u[0, :, 0]])
    at = int(np.flatnonzero(u[0, :, 0] == mesh.middle)[0])
    centre = np.einsum("tni,n->ti", v[:, ids, 1:3], np.ravel(mesh.shares))
    start, first = np.concatenate(([0.0], t)), np.array([[0.3, -1.0]])
    centre = np.concatenate((first, centre))
    place = np.concatenate((np.zeros((1, 2)), u[:, at, 1:3]))
    whole = np.concatenate(([1.0], energy / (0.5 * (0.3**2 + 1.0))))
    history = {"ux": place[:, 0], "uy": place[:, 1], "vx": centre[:, 0], "vy": centre[:, 1]}
    # Impulse: mass 1 times the change of the centre's velocity.
    history.update(ix=centre[:, 0] - 0.3, iy=centre[:, 1] + 1.0, energy=whole)
    history = {k: np.interp(times, start, x).tolist() for k, x in history.items()}
    history["friction"] = kept["history"]["friction"]
    off = report_scenes.distance(history, kept["history"], meta["v"])
    return dict(off, work=None)


def one(path, version, scene, n, courant):
    """One run: its line of results."""
    like = dict(scene=scene, method="THETA", mass="CONSISTENT", redist=0, n=n, courant=courant)
    result = dict(program="CalculiX " + version, scene=scene, n=n, courant=courant)
    result["command"] = "%s -i run" % os.path.basename(path)
    with tempfile.TemporaryDirectory() as folder:
        meta = report_scenes.write_scene(os.path.join(folder, "like.k"), like)
        text, mesh = {"unaligned": bars, "block": block}[scene](meta, n)
        with open(os.path.join(folder, "run.inp"), "w") as file:
            file.write(text)
        usage = resource_of([path, "-i", "run"], folder)
        if usage["code"] != 0:
            return dict(result, failed="exit %s: %s" % (usage["code"], usage["said"]))
        dat = os.path.join(folder, "run.dat")
        try:
            found = errors_of(scene, meta, mesh, dat)
        except (KeyError, IndexError, OSError, ValueError) as problem:
            return dict(result, failed="its output is not read: %r" % problem)
        found = {k: None if v is None else float(v) for k, v in found.items()}
        return dict(result, cpu=usage["cpu"], dt=meta["dt"], **found)


def resource_of(command, folder):
    """Runs a program on one thread: exit code, processor seconds, user seconds, its last line."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", CCX_NPROC_EQUATION_SOLVER="1")
    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen(command, cwd=folder, stdout=said, stderr=said, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -1
        said.seek(0)
        lines = said.read().decode(errors="replace").split("\n")
    last = next((x.strip() for x in reversed(lines) if x.strip()), "")
    cpu = usage.ru_utime + usage.ru_stime
    return {"code": child.returncode, "cpu": cpu, "user": usage.ru_utime, "said": last}


def study(store, size):
    """Lines of results of the other programs; kept like those of the study."""
    path, version = installed()
    if path is None:
        print("PEERS: no ccx (CalculiX) is installed; its points are left out")
        return []
    kept, done = os.path.join(store, "peers.jsonl"), {}
    if os.path.exists(kept):
        with open(kept) as file:
            done = {tuple(k): r for k, r in map(json.loads, file)}
    found = []
    for scene, n, courant in RUNS if size == "full" else RUNS[::3]:
        name = (version, scene, n, courant)
        if name not in done:
            done[name] = one(path, version, scene, n, courant)
            with open(kept, "a") as file:
                file.write(json.dumps([name, done[name]]) + "\n")
        found.append(done[name])
    return found
