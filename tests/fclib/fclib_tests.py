"""bipact-fclib on problems written here in every storage, on damaged files, and on a folder of
published problems where FCLIB names one. Errors are evaluated again from r alone."""

import glob
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import h5py
import numpy as np
import scenes
from scenes import TMP, at_most, check, finish
import fclib
import make_bars

PROGRAM = os.environ["BIPACT"].replace("bin/bipact", "bin/bipact-fclib")


def solve(path, *options):
    """(exit code, line of the table as words, messages)."""
    done = subprocess.run(
        [PROGRAM, path] + list(options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    return (
        done.returncode,
        done.stdout.split("\n")[-2].split() if done.stdout else [],
        done.stderr,
    )


def store(group, name, array, storage, spare=0):
    """Writes a matrix: rows, columns, triplets; `spare` entries too many at the end."""
    group = group.create_group(name)
    row, column = np.nonzero(array)
    if storage == "columns":
        order = np.lexsort((row, column))
        row, column = row[order], column[order]
    value = array[row, column]
    nz = {"rows": -2, "columns": -1}.get(storage, len(value))
    if storage == "triplets":
        p, i = column, row
    else:
        major, i = (row, column) if storage == "rows" else (column, row)
        lines = array.shape[storage == "columns"]
        p = np.concatenate(([0], np.cumsum(np.bincount(major, minlength=lines))))
    pad = lambda x: np.concatenate([x, np.full(spare, 7, x.dtype)])
    for key, number in (
        ("m", array.shape[0]),
        ("n", array.shape[1]),
        ("nzmax", len(value) + spare),
        ("nz", nz),
    ):
        group.create_dataset(key, data=np.array([number], np.int32))
    group.create_dataset("p", data=p.astype(np.int32))
    group.create_dataset("i", data=pad(i.astype(np.int32)))
    group.create_dataset("x", data=pad(value))


def random_problem(rng, d, contacts, bodies=4):
    """Mass, H, f, w, mu of a problem with a solution: H v + w strictly open for some v."""
    n = 6 * bodies
    mass = np.zeros((n, n))
    for b in range(bodies):
        part = rng.normal(size=(6, 6))
        mass[6 * b : 6 * b + 6, 6 * b : 6 * b + 6] = part @ part.T + 6.0 * np.eye(6)
    h = np.zeros((n, d * contacts))
    for a in range(contacts):
        for b in rng.choice(bodies, 2, replace=False):
            h[6 * b : 6 * b + 6, d * a : d * a + d] = rng.normal(size=(6, d))
    mu = np.full(contacts, 0.4)
    inside = np.tile([1.0] + (d - 1) * [0.1], contacts)
    v = rng.normal(size=n)
    f = rng.normal(size=n)
    return mass, h, f, inside - h.T @ v, mu


def write(path, form, storage, d, mass, h, f, w, mu, half=False, spare=0):
    """Writes a problem in one form and storage."""
    with h5py.File(path, "w") as file:
        group = file.create_group("fclib_" + form)
        group.create_dataset("spacedim", data=np.array([d], np.int32))
        vectors = group.create_group("vectors")
        vectors.create_dataset("mu", data=mu)
        if form == "local":
            solved = np.linalg.solve(mass, np.column_stack([h, f]))
            store(group, "W", h.T @ solved[:, :-1], storage, spare)
            vectors.create_dataset("q", data=h.T @ solved[:, -1] + w)
        else:
            store(group, "M", np.triu(mass) if half else mass, storage, spare)
            store(group, "H", h, storage, spare)
            vectors.create_dataset("f", data=f)
            vectors.create_dataset("w", data=w)


def problems():
    """Every form and storage gives the same reactions of a problem with one solution; the table
    line says the errors that the other code finds (to the digits it prints: round-off of W in
    the condensed form leaves 1e-13 of an error of 1e-12)."""
    rng = np.random.default_rng(5)
    for d, contacts in ((2, 7), (3, 5)):
        data = random_problem(rng, d, contacts)
        first = None
        for form, storage, half, spare in (
            ("local", "rows", False, 0),
            ("local", "columns", False, 3),
            ("local", "triplets", False, 0),
            ("global", "rows", False, 2),
            ("global", "columns", True, 0),
            ("global", "triplets", True, 4),
        ):
            name = os.path.join(TMP, "%s_%s_%d.hdf5" % (form, storage, d))
            write(name, form, storage, d, *data, half=half, spare=spare)
            answer = name[:-5] + "_solution.hdf5"
            code, line, errors = solve(name, "--tol", "1e-12", "-o", answer)
            check(code == 0, "%s: exit %d %s" % (name, code, errors))
            given = fclib.Problem(name)
            r = fclib.solution(answer, given)
            for value, printed, word in zip(
                fclib.errors(given, r), line[7:10], ("error", "error2018", "eta")
            ):
                at_most(abs(value - float(printed)), 1e-13 + 1e-3 * value, name + ": " + word)
            at_most(fclib.errors(given, r)[0], 1.1e-12, name + ": error by the other code")
            if first is None:
                first = r
            # W is well conditioned: r is known to some hundred times the tolerance.
            at_most(np.abs(r - first).max() / np.abs(first).max(), 1e-9, name + ": same r")
            with h5py.File(answer, "r") as file:
                u = np.ravel(file["solution/u"]).reshape(r.shape)
                at_most(np.abs(u - given.motions(r)).max(), 1e-11, name + ": u")
                check(("v" in file["solution"]) == (form == "global"), name + ": v")
                if form == "global":
                    v = np.ravel(file["solution/v"])
                    off = data[0] @ v - data[1] @ r.ravel() - data[2]
                    at_most(np.abs(off).max(), 1e-10, name + ": M v = H r + f")


def wedging():
    """One contact with mu |W_nt| > W_nn has several answers: it is solved, and named."""
    for mu, warned in ((2.0, True), (0.5, False)):
        name = os.path.join(TMP, "wedge.hdf5")
        mass = np.linalg.inv(np.array([[1.0, 0.9], [0.9, 1.0]]))
        q = np.array([-1.0, -0.5])
        write(name, "local", "rows", 2, mass, np.eye(2), np.zeros(2), q, np.array([mu]))
        code, _, errors = solve(name)
        check(code == 0, errors)
        found = "1 contacts wedge" in errors and "the first is contact 1" in errors
        check(found == warned, "mu %g: %s" % (mu, errors))


def law_misses(problem, r, share):
    """Contacts that miss the law by more than a share of the largest force or displacement, asked
    without a product with mu, so that it can be of any size."""
    u = problem.motions(r)
    size_r, size_q, size_u = (np.linalg.norm(x) for x in (r, problem.q, u))
    length = share * max(size_q, size_u, problem.m * size_r)
    pushed, slip = np.linalg.norm(r[:, 1:], axis=1), np.linalg.norm(u[:, 1:], axis=1)
    loaded = np.linalg.norm(r, axis=1) > length / problem.m
    limit = (1.0 + share) * r[:, 0]
    return np.sum(
        (u[:, 0] < -length)
        | (r[:, 0] < 0.0)
        | (pushed / problem.mu > limit)
        | (loaded & (u[:, 0] > length))
        | (loaded & (slip > length) & (pushed / problem.mu < 0.999 * r[:, 0]))
    )


def large_friction():
    """mu up to the largest number there is, one contact and two: the answer obeys the law, or the
    program ends with exit 1. r = 0 with u_n = -1 and slip is what the natural map alone takes."""
    rng = np.random.default_rng(8)
    solved = 0
    for d in (2, 3):
        for contacts in (1, 2):
            n = d * contacts
            coupled = 0.5 * rng.normal(size=(n, n))
            mass = np.linalg.inv(np.eye(n) + coupled @ coupled.T)
            q = np.tile([-1.0] + (d - 1) * [2.0], contacts)
            for mu in (1e8, 1e12, 1e16, 1e100, 1e300, np.finfo(float).max):
                name = os.path.join(TMP, "large.hdf5")
                answer = os.path.join(TMP, "large_solution.hdf5")
                data = np.eye(n), np.zeros(n), q, np.full(contacts, mu)
                write(name, "local", "rows", d, mass, *data)
                code, line, errors = solve(name, "-o", answer)
                word = "d = %d, %d contacts, mu = %g: " % (d, contacts, mu)
                check(code in (0, 1), word + errors)
                check(np.isfinite([float(x) for x in line[7:10]]).all(), word + "errors")
                if code == 1:
                    continue
                solved += 1
                given = fclib.Problem(name)
                misses = law_misses(given, fclib.solution(answer, given), 1e-7)
                check(misses == 0, word + "%d contacts miss the law" % misses)
    check(solved >= 20, "solved are %d of 24" % solved)


def units():
    """W and q of 1e-200 to 1e200: the errors printed are finite, and the problem is solved where
    its reactions can be held."""
    rng = np.random.default_rng(9)
    data = random_problem(rng, 3, 3)
    solved = np.linalg.solve(data[0], np.column_stack([data[1], data[2]]))
    w, q = data[1].T @ solved[:, :-1], data[1].T @ solved[:, -1] + data[3]
    q[::3] = -np.abs(q[::3])
    for i in (-200, 0, 200):
        for j in (-200, 0, 200):
            name = os.path.join(TMP, "units.hdf5")
            with h5py.File(name, "w") as file:
                group = file.create_group("fclib_local")
                group.create_dataset("spacedim", data=np.array([3], np.int32))
                vectors = group.create_group("vectors")
                vectors.create_dataset("mu", data=data[4])
                vectors.create_dataset("q", data=q * 10.0**j)
                store(group, "W", w * 10.0**i, "rows")
            code, line, errors = solve(name)
            word = "W 1e%d, q 1e%d: " % (i, j)
            check(code == (0 if abs(i - j) < 300 else 1), word + "exit %d %s" % (code, errors))
            check(np.isfinite([float(x) for x in line[7:10]]).all(), word + " ".join(line))


def damaged():
    """Missing parts, wrong sizes, NaN, a cut file, no HDF5: a message, exit 2 or 3, no file."""
    rng = np.random.default_rng(6)
    data = random_problem(rng, 3, 4)

    def case(word, code, message, change, form="local"):
        name = os.path.join(TMP, "damaged.hdf5")
        answer = os.path.join(TMP, "answer.hdf5")
        write(name, form, "rows", 3, *data)
        change(name)
        found, line, errors = solve(name, "-o", answer)
        check(found == code, "%s: exit %s, expected %d: %s" % (word, found, code, errors))
        check(message in errors, "%s: %s" % (word, errors))
        check(not line and not os.path.exists(answer), word + ": nothing is written")

    def edit(change):
        def inside(name):
            with h5py.File(name, "r+") as file:
                change(file)

        return inside

    def replace(file, path, value):
        del file[path]
        file.create_dataset(path, data=value)

    def cut(name):
        with open(name, "r+b") as file:
            file.truncate(os.path.getsize(name) // 2)

    def text(name):
        with open(name, "w") as file:
            file.write("*KEYWORD\n")

    def nan(file):
        file["fclib_local/W/x"][3] = np.nan

    case(
        "no q",
        2,
        "vectors/q is missing",
        edit(lambda f: f.__delitem__("fclib_local/vectors/q")),
    )
    case("no W", 2, "/W/m is missing", edit(lambda f: f.__delitem__("fclib_local/W")))
    case(
        "short q",
        2,
        "holds 5 values",
        edit(lambda f: replace(f, "fclib_local/vectors/q", np.ones(5))),
    )
    case(
        "short p",
        2,
        "are needed",
        edit(lambda f: replace(f, "fclib_local/W/p", np.zeros(2, np.int32))),
    )
    case("NaN", 2, "NaN", edit(nan))
    case("mu", 2, "mu holds", edit(lambda f: replace(f, "fclib_local/vectors/mu", -np.ones(4))))
    case(
        "spacedim", 2, "spacedim is 5", edit(lambda f: replace(f, "fclib_local/spacedim", [5]))
    )
    case(
        "index",
        2,
        "out of range",
        edit(lambda f: replace(f, "fclib_local/W/i", np.full(144, 99, np.int32))),
    )
    case("no form", 2, "neither", edit(lambda f: f.__delitem__("fclib_local")))
    case(
        "H",
        2,
        "H/x holds",
        edit(lambda f: replace(f, "fclib_global/H/x", np.ones(2))),
        "global",
    )
    case("cut file", 3, "cannot read", cut)
    case("no HDF5", 3, "cannot read", text)
    for words, code, message in (
        (["nothing.hdf5"], 3, "no such file"),
        (["a.hdf5", "--tol", "x"], 2, "expected a positive number"),
        (["a.hdf5", "--solver", "MAGIC"], 2, "unknown solver"),
        (["a.hdf5", "--fast"], 2, "unknown argument"),
    ):
        found, _, errors = solve(*words)
        check(found == code and message in errors, "%s: %s %s" % (words, found, errors))


def dumps():
    """Problems of steps of the two bars (no friction) and of a scene with friction, written by
    the run, converted, solved again: the reactions of the run, to its tolerance of 1e-10 times
    the condition of W, below 1e3 here. A step without contact leaves no file."""
    for name, data in (("smooth", dict(ny=2)), ("friction", dict(ny=3, mu=0.3, slide=0.3))):
        deck, folder = os.path.join(TMP, name + ".k"), os.path.join(TMP, name)
        make_bars.write(deck, nx=20, courant=0.5, touch=0.5, **data)
        with open(deck) as file:
            text = file.read()
        with open(deck, "w") as file:
            file.write(text.replace("*END", "*BIPACT_CONTACT\nAUTO,\n,,,,10,170,40\n*END"))
        code, errors, _ = scenes.bipact(deck, folder, "--quiet")
        check(code == 0, errors)
        found = sorted(glob.glob(os.path.join(folder, "contact_*.txt")))
        check(
            [int(x[-13:-4]) for x in found] == [50, 90],
            "%s: step 10 is before the touch at 41, 130 after the release at 121: %s"
            % (name, found),
        )
        for path in found:
            converted, answer = path[:-4] + ".hdf5", path[:-4] + "_solution.hdf5"
            done = subprocess.run([PROGRAM, path, "--convert", converted])
            check(done.returncode == 0, "convert")
            with open(path) as file:
                contacts = int(file.readlines()[1].split()[1])
            r = np.loadtxt(path, skiprows=2, max_rows=contacts, ndmin=2)[:, 3:5]
            given = fclib.Problem(converted)
            at_most(fclib.errors(given, r)[0], 1.1e-10, name + ": error of the run's answer")
            for problem in (converted, path):
                code, _, errors = solve(problem, "--tol", "1e-10", "-o", answer)
                check(code == 0, errors)
                off = np.abs(fclib.solution(answer, given) - r).max() / np.abs(r).max()
                at_most(off, 1e-7, name + ": reactions of the run")


def shared():
    """Published problems: AUTO certifies all of them to 1e-8, and the other code agrees."""
    folder = os.environ.get("FCLIB", "")
    files = sorted(glob.glob(os.path.join(folder, "*.hdf5"))) if folder else []
    if not files:
        print("set FCLIB to a folder of FCLIB problems to run them here")
        sys.exit(77)
    for name in files:
        answer = os.path.join(TMP, "answer.hdf5")
        code, line, errors = solve(name, "--tol", "1e-8", "--max-time", "60", "-o", answer)
        check(code == 0, "%s: exit %d %s" % (name, code, errors))
        given = fclib.Problem(name)
        error, _, eta = fclib.errors(given, fclib.solution(answer, given))
        # The other code condenses with another solver: round-off of an ill-conditioned M.
        at_most(error, 1.01e-8, os.path.basename(name) + ": error by the other code")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
