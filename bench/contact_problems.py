#!/usr/bin/env python3
"""All solvers of bipact-fclib over a folder of contact problems: table, CSV, and profiles of
performance (Dolan & More 2002) at three tolerances.

    contact_problems.py FOLDER [--solvers AUTO,GS-EXACT,...] [--siconos PYTHON]
                        [--max-time 20] [--out FOLDER]

GS-EXACT is the solver GS with the local solver EXACT. --siconos adds the solvers of Siconos to
the same table, run by a Python that has the package siconos.

Errors are evaluated again from r alone by scripts/fclib.py; a run counts as solved when that
error meets the tolerance. Times are processor seconds of the solve, the least of three; below
4 ms they count as equal."""

import argparse
import csv
import glob
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import fclib as reader
import siconos_solvers

TOLERANCES = (1.0e-4, 1.0e-8, 1.0e-12)
SOLVERS = "AUTO,GS,GS-EXACT,GS-NEWTON,ANDERSON,NESTEROV,PRODUCTS,NEWTON,PROX"
EQUAL = 4.0e-3
PROGRAM = os.path.join(common.ROOT, "bin", "bipact-fclib")


def run(path, problem, solver, tolerance, seconds):
    """One line of results."""
    with tempfile.TemporaryDirectory() as folder:
        answer = os.path.join(folder, "answer.hdf5")
        times, words = [], []
        for k in range(3):
            command = [PROGRAM, path, "--tol", repr(tolerance)]
            command += ["--solver", solver.split("-")[0]]
            command += ["--local", solver.split("-")[1]] if "-" in solver else []
            command += ["--max-time", repr(seconds), "-o", answer]
            done = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
            )
            if not done.stdout:
                break
            words = done.stdout.split("\n")[-2].split()
            times.append(float(words[6]))
            if times[-1] > 0.2:
                break
        if not words:
            return {"solved": False, "seconds": None, "error": None, "eta": None}
        error, error2018, eta = reader.errors(problem, reader.solution(answer, problem))
        return {
            "sweeps": int(words[4]),
            "newton": int(words[5]),
            "seconds": min(times),
            "error": error,
            "error2018": error2018,
            "eta": eta,
            "solved": bool(error <= 1.01 * tolerance and eta <= 1.01 * tolerance),
        }


def run_siconos(python, problem, solver, tolerance, seconds):
    """The same by Siconos; an empty line where the solver is not for problems of that kind."""
    nothing = {"solved": False, "seconds": None, "error": None, "eta": None}
    if solver not in siconos_solvers.SOLVERS[problem.d]:
        return nothing
    with tempfile.TemporaryDirectory() as folder:
        path, answer = os.path.join(folder, "problem.dat"), os.path.join(folder, "r.txt")
        siconos_solvers.write(path, problem)
        command = [python, siconos_solvers.__file__, path, solver, repr(tolerance), answer]
        times = []
        for k in range(3):
            try:
                done = subprocess.run(
                    command, capture_output=True, text=True, timeout=2.0 + 2.0 * seconds
                )
            except subprocess.TimeoutExpired:
                return nothing
            words = [line.split() for line in done.stdout.split("\n") if "answer" in line]
            if not words:
                return nothing
            times.append(float(words[-1][2]))
            if times[-1] > 0.2:
                break
        r = np.loadtxt(answer).reshape(problem.q.shape) / problem.m
        error, error2018, eta = reader.errors(problem, r)
        return {
            "sweeps": int(words[-1][1]),
            "seconds": min(times),
            "error": error,
            "error2018": error2018,
            "eta": eta,
            "solved": bool(error <= 1.01 * tolerance and eta <= 1.01 * tolerance),
        }


def profile(results, tolerance, solvers, names, path):
    """Share of the problems that a solver solves within a factor of the best time."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    best = {}
    for name in names:
        times = [
            max(r["seconds"], EQUAL)
            for (n, s, t), r in results.items()
            if n == name and t == tolerance and r["solved"]
        ]
        best[name] = min(times) if times else None
    factors = np.logspace(0.0, 3.0, 200)
    for solver in solvers:
        ratios = []
        for name in names:
            r = results[name, solver, tolerance]
            if r["solved"] and best[name]:
                ratios.append(max(r["seconds"], EQUAL) / best[name])
        share = [np.sum(np.array(ratios) <= f) / len(names) for f in factors]
        axes.semilogx(factors, share, label=solver)
    axes.set_xlabel("time / best time of the problem")
    axes.set_ylabel("share of problems solved")
    axes.set_title("tolerance %.0e" % tolerance)
    axes.set_ylim(0.0, 1.03)
    axes.grid(True, alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=80)
    plt.close(figure)


def cell(r):
    if r["seconds"] is None:
        return "-"
    text = "<4" if r["seconds"] < EQUAL else "%.0f" % (1e3 * r["seconds"])
    return text if r["solved"] else "FAIL %.0e" % r["error"]


def write_tables(results, sizes, solvers, names, out):
    """table.md and runs.csv."""
    lines = [
        "%s, %s. Cell: milliseconds of the solve, or the error where it is not met."
        % (common.today(), common.machine()),
        "",
    ]
    for tolerance in TOLERANCES:
        lines += ["**tolerance %.0e**" % tolerance, ""]
        lines += ["| problem | contacts | " + " | ".join(solvers) + " |"]
        lines += ["|---" * (len(solvers) + 2) + "|"]
        for name in names:
            row = [cell(results[name, s, tolerance]) for s in solvers]
            lines.append("| %s | %d | %s |" % (name, sizes[name], " | ".join(row)))
        solved = [sum(results[n, s, tolerance]["solved"] for n in names) for s in solvers]
        lines += ["| solved of %d | | %s |" % (len(names), " | ".join(map(str, solved))), ""]
    with open(os.path.join(out, "table.md"), "w") as file:
        file.write("\n".join(lines))
    with open(os.path.join(out, "runs.csv"), "w", newline="") as file:
        columns = ["problem", "solver", "tolerance", "solved", "seconds", "sweeps", "newton"]
        columns += ["error", "error2018", "eta"]
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        for (name, solver, tolerance), r in results.items():
            row = dict(r, problem=name, solver=solver, tolerance=tolerance)
            writer.writerow(
                {k: "%.4g" % v if isinstance(v, float) else v for k, v in row.items()}
            )
    print("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder")
    parser.add_argument("--solvers", default=SOLVERS)
    parser.add_argument("--siconos", metavar="PYTHON")
    parser.add_argument("--max-time", type=float, default=20.0)
    parser.add_argument("--out", default=os.path.join(common.ROOT, "build", "fclib"))
    a = parser.parse_args()
    files = sorted(glob.glob(os.path.join(a.folder, "*.hdf5")))
    if not files:
        print("no .hdf5 files in %s" % a.folder)
        return 1
    os.makedirs(a.out, exist_ok=True)
    siconos = []
    if a.siconos:
        siconos = sorted(set(siconos_solvers.SOLVERS[3]) | set(siconos_solvers.SOLVERS[2]))
    solvers, results, sizes = a.solvers.split(","), {}, {}
    for path in files:
        name = os.path.basename(path)[:-5]
        problem = reader.Problem(path)
        sizes[name] = len(problem.mu)
        for solver in solvers:
            for tolerance in TOLERANCES:
                results[name, solver, tolerance] = run(
                    path, problem, solver, tolerance, a.max_time
                )
        for solver in siconos:
            for tolerance in TOLERANCES:
                results[name, "siconos " + solver, tolerance] = run_siconos(
                    a.siconos, problem, solver, tolerance, a.max_time
                )
        print(name, file=sys.stderr)
    names = list(sizes)
    solvers += ["siconos " + solver for solver in siconos]
    write_tables(results, sizes, solvers, names, a.out)
    for tolerance in TOLERANCES:
        name = "profile_%.0e.png" % tolerance
        profile(results, tolerance, solvers, names, os.path.join(a.out, name))
    return 0


if __name__ == "__main__":
    sys.exit(main())
