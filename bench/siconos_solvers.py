#!/usr/bin/env python3
"""One contact problem by a solver of Siconos, where its Python package is installed (Debian:
python3-siconos). Run by contact_problems.py --siconos, with the Python that has the package.

    siconos_solvers.py PROBLEM.dat SOLVER TOLERANCE REACTIONS     prints iterations and seconds

PROBLEM.dat is what write() below makes: W by blocks, scaled to a mean diagonal of 1, so that
the error that Siconos itself looks at is the unit-free error of bipact."""

import sys
import time

import numpy as np

# Name in the tables: kind of problem, solver, local solver, most iterations.
SOLVERS = {
    3: {
        "NSGS": ("SICONOS_FRICTION_3D_NSGS", None, 20000),
        "NSGS-PLI": (
            "SICONOS_FRICTION_3D_NSGS",
            "SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnConeWithLocalIteration",
            20000,
        ),
        "NSGS-quartic": (
            "SICONOS_FRICTION_3D_NSGS",
            "SICONOS_FRICTION_3D_ONECONTACT_QUARTIC",
            20000,
        ),
        "NSN_AC": ("SICONOS_FRICTION_3D_NSN_AC", None, 500),
        "PROX": ("SICONOS_FRICTION_3D_PROX", None, 500),
        "ADMM": ("SICONOS_FRICTION_3D_ADMM", None, 10000),
        "VI_FPP": ("SICONOS_FRICTION_3D_VI_FPP", None, 20000),
    },
    2: {
        "NSGS": ("SICONOS_FRICTION_2D_NSGS", None, 20000),
        "LEMKE": ("SICONOS_FRICTION_2D_LEMKE", None, 20000),
        "CPG": ("SICONOS_FRICTION_2D_CPG", None, 20000),
    },
}


def write(path, problem):
    """The problem in the text form of Siconos, scaled; from scripts/fclib.py."""
    d, contacts = problem.d, len(problem.mu)
    blocks = {(a, a): np.zeros((d, d)) for a in range(contacts)}
    for row, column, value in zip(problem.row, problem.column, problem.value):
        block = blocks.setdefault((row // d, column // d), np.zeros((d, d)))
        block[row % d, column % d] += value / problem.m
    order = sorted(blocks)
    first = np.searchsorted([a for a, _ in order], np.arange(contacts + 1))
    with open(path, "w") as file:
        sizes = " ".join(str(d * k) for k in range(1, contacts + 1))
        heads = [d, contacts, 1, d * contacts, d * contacts, len(order), contacts, contacts]
        heads += [sizes, sizes, contacts + 1, len(order)]
        heads += [" ".join(map(str, first)), " ".join(str(b) for _, b in order)]
        file.write("\n".join(map(str, heads)) + "\n")
        for k, key in enumerate(order):
            file.write("%d\n" % k)
            file.write("\n".join("%.17e" % v for v in blocks[key].T.ravel()) + "\n")
        file.write(" ".join("%.17e" % v for v in problem.q.ravel()) + "\n")
        file.write(" ".join("%.17e" % v for v in problem.mu) + "\n")


def main():
    import siconos.numerics as numerics

    path, name, tolerance, answer = sys.argv[1], sys.argv[2], float(sys.argv[3]), sys.argv[4]
    problem = numerics.frictionContact_new_from_filename(path)
    code, local, most = SOLVERS[problem.dimension][name]
    options = numerics.SolverOptions(getattr(numerics, code))
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = most
    options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
    if local:
        numerics.solver_options_update_internal(options, 0, getattr(numerics, local))
    n = problem.dimension * problem.numberOfContacts
    r, u = np.zeros(n), np.zeros(n)
    drive = numerics.fc3d_driver if problem.dimension == 3 else numerics.fc2d_driver
    start = time.process_time()
    drive(problem, r, u, options)
    seconds = time.process_time() - start
    np.savetxt(answer, r)
    print("answer", options.iparam[numerics.SICONOS_IPARAM_ITER_DONE], seconds)


if __name__ == "__main__":
    main()
