#!/usr/bin/env python3
"""The factor of SUPERNODAL beside tuned libraries, in one run, one thread each: the rate of dpotrf
of OpenBLAS for a dense matrix of 2000, and CHOLMOD (analyse, factorize) on a cube of n nodes an
edge whose neighbours are all coupled, three unknowns a node, the matrix of linear_solvers.
`factor_peers.py [n ...]` (20 30), after `make bench-programs`; the best of --rounds (3). Needs
NumPy and the packages libopenblas0-serial and libcholmod3 (Debian names); without one of them its
column is empty. Ratios: SUPERNODAL over CHOLMOD in seconds, over dpotrf in Gflop/s."""

import argparse
import ctypes
import glob
import os
import re
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import numpy as np

PROGRAM = os.path.join(common.ROOT, "build", "release", "bench", "linear_solvers")
OPENBLAS = glob.glob("/usr/lib/*/openblas-serial/libblas.so.3")


def load(name):
    """A library that may be missing."""
    try:
        return ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)
    except OSError:
        return None


def dpotrf_rate(n=2000):
    """Gflop/s, multiplications and additions; None without OpenBLAS."""
    lapack = load(OPENBLAS[0].replace("libblas", "liblapack")) if OPENBLAS else None
    if lapack is None:
        return None
    a = np.asfortranarray(np.eye(n) * n + 0.5)
    size, info = ctypes.c_int(n), ctypes.c_int()
    start = time.process_time()
    lapack.dpotrf_(
        b"L", ctypes.byref(size), a.ctypes.data_as(ctypes.c_void_p), ctypes.byref(size),
        ctypes.byref(info),
    )
    seconds = time.process_time() - start
    assert info.value == 0
    return n**3 / 3 / seconds * 1.0e-9


class Sparse(ctypes.Structure):
    """cholmod_sparse, by columns."""

    _fields_ = (
        [(name, ctypes.c_size_t) for name in ("nrow", "ncol", "nzmax")]
        + [(name, ctypes.c_void_p) for name in ("p", "i", "nz", "x", "z")]
        + [(n, ctypes.c_int) for n in ("stype", "itype", "xtype", "dtype", "sorted", "packed")]
    )


def cube_columns(n, d=3):
    """Pointers and rows of the lower triangle by columns, and which entries are diagonal."""
    place = np.arange(n**3).reshape(n, n, n)
    steps = [
        (i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)
    ]
    cut = [(slice(max(0, -s), n - max(0, s)), slice(max(0, s), n - max(0, -s))) for s in (-1, 0, 1)]
    pairs = [
        (
            place[tuple(cut[s + 1][0] for s in step)].ravel(),
            place[tuple(cut[s + 1][1] for s in step)].ravel(),
        )
        for step in steps
    ]
    a = np.concatenate([p[0] for p in pairs])
    b = np.concatenate([p[1] for p in pairs])
    row = (d * a[:, None, None] + np.arange(d)[None, :, None] + 0 * np.arange(d)).ravel()
    column = (d * b[:, None, None] + np.arange(d)[None, None, :] + 0 * np.arange(d)[:, None]).ravel()
    lower = row >= column
    row, column = row[lower], column[lower]
    order = np.lexsort((row, column))
    row, column = row[order], column[order]
    start = np.searchsorted(column, np.arange(d * n**3 + 1))
    return start.astype(np.int32), row.astype(np.int32), row == column


def cholmod_seconds(n):
    """Processor seconds of analysis and factor; None without CHOLMOD."""
    library = load("libcholmod.so.3") or load("libcholmod.so.5")
    if library is None or not OPENBLAS:
        return None
    start, row, diagonal = cube_columns(n)
    value = np.where(diagonal, 100.0, -1.0)
    size = len(start) - 1
    matrix = Sparse(
        size, size, len(row), start.ctypes.data, row.ctypes.data, None, value.ctypes.data, None,
        -1, 0, 1, 0, 1, 1,
    )
    settings = ctypes.create_string_buffer(1 << 15)  # more than a cholmod_common
    library.cholmod_start(settings)
    library.cholmod_analyze.restype = ctypes.c_void_p
    clock = [time.process_time()]
    factor = ctypes.c_void_p(library.cholmod_analyze(ctypes.byref(matrix), settings))
    clock.append(time.process_time())
    assert library.cholmod_factorize(ctypes.byref(matrix), factor, settings)
    clock.append(time.process_time())
    library.cholmod_free_factor(ctypes.byref(factor), settings)
    library.cholmod_finish(settings)
    return clock[1] - clock[0], clock[2] - clock[1]


def own(n):
    """Seconds of analysis and factor, Gflop/s."""
    text = subprocess.run(
        [PROGRAM, "SUPERNODAL", str(n), "3"], capture_output=True, text=True, check=True
    ).stdout
    return [float(v) for v in re.search(r"analysis (\S+) s, factor (\S+) s \((\S+) G", text).groups()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("sizes", nargs="*", type=int, default=[20, 30])
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    if OPENBLAS:
        load(OPENBLAS[0])  # before CHOLMOD, which takes the BLAS that is there
    print(" n   dofs  SUPERNODAL s (analysis)  Gflop/s | CHOLMOD s (analysis)  ratio | dpotrf  ratio")
    for n in args.sizes:
        rounds = [(own(n), cholmod_seconds(n), dpotrf_rate()) for _ in range(args.rounds)]
        best = min((r[0] for r in rounds), key=lambda r: r[1])
        line = "%2d %6d  %10.3f (%.3f)  %13.1f |" % (n, 3 * n**3, best[1], best[0], best[2])
        if rounds[0][1]:
            peer = min((r[1] for r in rounds), key=lambda r: r[1])
            line += "%10.3f (%.3f)  %8.2f |" % (peer[1], peer[0], best[1] / peer[1])
        else:
            line += "         -                    |"
        if rounds[0][2]:
            rate = max(r[2] for r in rounds)
            line += "%7.1f  %5.2f" % (rate, best[2] / rate)
        print(line, flush=True)


if __name__ == "__main__":
    main()
