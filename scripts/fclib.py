#!/usr/bin/env python3
"""Contact problems and solutions of FCLIB files, and the error of a solution, independent of
bipact's own code.

    fclib.py PROBLEM.hdf5 SOLUTION.hdf5     prints error, error2018, eta of the solution

The law: u = W r + q, r in Coulomb's cone, (u_n + mu |u_t|, u_t) in the dual cone, both
orthogonal. With m = mean of the diagonal of W:

    error      |r - P(r - (u_n + mu |u_t|, u_t)/m)| / max(|r|, |q|/m, |u|/m)
    error2018  |r - P(r - (u_n + mu |u_t|, u_t))| / |q|    (Acary, Bremond & Huber 2018)
    eta        sum |mu r_n |u_t| + r.u| / (|r| max(|u|, |q|))
"""

import argparse

import startup  # noqa: F401  before what is no part of Python
import h5py
import numpy as np


def matrix(group):
    """(rows, columns, row, column, value) of a matrix in any of its three storages."""
    m, n, nz = (int(np.ravel(group[name])[0]) for name in ("m", "n", "nz"))
    p, i, x = (np.ravel(group[name]) for name in ("p", "i", "x"))
    if nz >= 0:
        return m, n, i[:nz], p[:nz], x[:nz]
    lines = m if nz == -2 else n
    count = int(p[lines])
    major = np.repeat(np.arange(lines), np.diff(p[: lines + 1]))
    if nz == -2:
        return m, n, major, i[:count], x[:count]
    return m, n, i[:count], major, x[:count]


def dense(group):
    """The same as an array."""
    m, n, row, column, value = matrix(group)
    out = np.zeros((m, n))
    np.add.at(out, (row, column), value)
    return out


def whole(mass):
    """A symmetric matrix of which the file may hold one half only."""
    lower, upper = np.tril(mass, -1), np.triu(mass, 1)
    if lower.any() != upper.any():
        return mass + (upper.T if upper.any() else lower.T)
    return mass


class Problem:
    """A problem: d, contacts, q (contacts, d), mu, and the product W r."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.form = next(k for k in ("fclib_local", "fclib_global") if k in file)
            group = file[self.form]
            self.d = int(np.ravel(group["spacedim"])[0])
            self.mu = np.ravel(group["vectors/mu"])
            if self.form == "fclib_local":
                m, _, self.row, self.column, self.value = matrix(group["W"])
                q = np.ravel(group["vectors/q"])
            else:
                mass, h = whole(dense(group["M"])), dense(group["H"])
                solved = np.linalg.solve(
                    mass, np.column_stack([h, np.ravel(group["vectors/f"])])
                )
                w = h.T @ solved[:, :-1]
                q = h.T @ solved[:, -1] + np.ravel(group["vectors/w"])
                self.row, self.column = np.nonzero(w)
                self.value = w[self.row, self.column]
        self.q = q.reshape(-1, self.d)
        diagonal = self.row == self.column
        self.m = np.sum(self.value[diagonal]) / self.q.size

    def motions(self, r):
        """u = W r + q."""
        u = np.zeros(self.q.size)
        np.add.at(u, self.row, self.value * r.ravel()[self.column])
        return u.reshape(self.q.shape) + self.q


def projected(mu, tau):
    """Rows of tau projected on Coulomb's cones."""
    length = np.linalg.norm(tau[:, 1:], axis=1)
    out = tau.copy()
    slip = length > mu * tau[:, 0]
    normal = (tau[:, 0] + mu * length) / (1.0 + mu**2)
    safe = np.where(length > 0.0, length, 1.0)
    out[slip, 0] = normal[slip]
    out[slip, 1:] = (mu * normal / safe)[slip, None] * tau[slip, 1:]
    out[mu * length <= -tau[:, 0]] = 0.0
    return out


def errors(problem, r):
    """(error, error2018, eta) of reactions r (contacts, d), u from r alone."""
    u, q, mu, m = problem.motions(r), problem.q, problem.mu, problem.m
    slip = np.linalg.norm(u[:, 1:], axis=1)
    dual = np.column_stack([u[:, 0] + mu * slip, u[:, 1:]])
    size_r, size_q, size_u = (np.linalg.norm(x) for x in (r, q, u))
    if size_r == 0.0 and (q[:, 0] >= 0.0).all():
        return 0.0, 0.0, 0.0
    scaled = np.linalg.norm(r - projected(mu, r - dual / m)) / max(
        size_r, size_q / m, size_u / m
    )
    plain = np.linalg.norm(r - projected(mu, r - dual)) / size_q
    misfit = np.abs(mu * r[:, 0] * slip + np.sum(r * u, axis=1)).sum()
    bottom = size_r * max(size_u, size_q)
    return scaled, plain, misfit / bottom if bottom else 0.0


def solution(path, problem):
    """Reactions of a solution file."""
    with h5py.File(path, "r") as file:
        return np.ravel(file["solution/r"]).reshape(problem.q.shape)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("problem", metavar="PROBLEM.hdf5")
    parser.add_argument("solution", metavar="SOLUTION.hdf5")
    a = parser.parse_args()
    given = Problem(a.problem)
    print("%.3e %.3e %.3e" % errors(given, solution(a.solution, given)))


if __name__ == "__main__":
    main()
