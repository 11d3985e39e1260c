"""Contact law of a few rows: u = W r + q, Signorini and Coulomb, solved for the set of rows that
are open, stick or slip. The set comes from projections, then from sweeps, then from Lemke."""

import numpy as np

OPEN, STICK, SLIP_UP, SLIP_DOWN = 0, 1, 2, 3
TOLERANCE = 1e-13


class NoSolution(Exception):
    """No set of states fulfils the law."""


def project(tau_n, tau_t, mu):
    """Returns the nearest points of Coulomb's cones."""
    size = np.abs(tau_t)
    opened = mu * size <= -tau_n
    stuck = size <= mu * tau_n
    n = np.where(stuck, tau_n, (tau_n + mu * size) / (1 + mu * mu))
    t = np.where(stuck, tau_t, mu * n * np.sign(tau_t))
    return np.where(opened, 0.0, n), np.where(opened, 0.0, t)


def misfit(w, q, mu, r):
    """Returns the relative distance of r from the projection that the law asks for.

    Motions of the size of round-off count as none: mu may be a million."""
    u = w @ r + q
    u[np.abs(u) <= 4e-15 * np.max(np.abs(q))] = 0.0
    scale = np.mean(np.diag(w))
    n, t = project(r[0::2] - (u[0::2] + mu * np.abs(u[1::2])) / scale, r[1::2] - u[1::2] / scale, mu)
    miss = np.hypot(np.linalg.norm(n - r[0::2]), np.linalg.norm(t - r[1::2]))
    size = max(np.linalg.norm(r), np.linalg.norm(q) / scale, np.linalg.norm(u) / scale)
    return miss / size if size > 1e-300 else 0.0


def by_states(w, q, mu, states):
    """Returns the reactions of given states: a linear problem."""
    m = len(mu)
    columns, rows = [], []
    for a in range(m):
        if states[a] == OPEN:
            continue
        column = np.zeros(2 * m)
        column[2 * a] = 1.0
        if states[a] == SLIP_UP:
            column[2 * a + 1] = mu[a]
        elif states[a] == SLIP_DOWN:
            column[2 * a + 1] = -mu[a]
        columns.append(column)
        rows.append(2 * a)
        if states[a] == STICK and mu[a] > 0:
            column = np.zeros(2 * m)
            column[2 * a + 1] = 1.0
            columns.append(column)
            rows.append(2 * a + 1)
    if not columns:
        return np.zeros(2 * m)
    c = np.array(columns).T
    matrix, right = (w @ c)[rows], -q[rows]
    try:
        z = np.linalg.solve(matrix, right)
        z += np.linalg.solve(matrix, right - matrix @ z)
        good = np.all(np.isfinite(z))
        good = good and np.max(np.abs(matrix @ z - right)) <= 1e-12 * np.max(np.abs(q))
    except np.linalg.LinAlgError:
        good = False
    if not good:
        z = np.linalg.lstsq(matrix, right, rcond=1e-13)[0]
    return c @ z


def states_of(w, q, mu, r, scale):
    """Returns the states that a projection from r finds, row by row."""
    u = w @ r + q
    tau_n = r[0::2] - (u[0::2] + mu * np.abs(u[1::2])) / scale
    tau_t = r[1::2] - u[1::2] / scale
    slip = np.where(tau_t > 0, SLIP_UP, SLIP_DOWN)
    states = np.where(np.abs(tau_t) <= mu * tau_n, STICK, slip)
    states = np.where((mu == 0) & (tau_n > 0), STICK, states)
    return np.where(mu * np.abs(tau_t) <= -tau_n, OPEN, states)


def sweep(w, q, mu, r, count):
    """Gauss-Seidel sweeps with a few projections for each row."""
    m = len(mu)
    u = w @ r + q
    for _ in range(count):
        for a in range(m):
            n, t = 2 * a, 2 * a + 1
            local = w[n : t + 1, n : t + 1]
            top = 0.5 * (local[0, 0] + local[1, 1])
            top += np.hypot(0.5 * (local[0, 0] - local[1, 1]), local[0, 1])
            old_n, old_t = r[n], r[t]
            for _ in range(20):
                tau_n = r[n] - (u[n] + mu[a] * abs(u[t])) / top
                tau_t = r[t] - u[t] / top
                if mu[a] * abs(tau_t) <= -tau_n:
                    new_n = new_t = 0.0
                elif abs(tau_t) <= mu[a] * tau_n:
                    new_n, new_t = tau_n, tau_t
                else:
                    new_n = (tau_n + mu[a] * abs(tau_t)) / (1 + mu[a] ** 2)
                    new_t = np.copysign(mu[a] * new_n, tau_t)
                dn, dt = new_n - r[n], new_t - r[t]
                u[n] += local[0, 0] * dn + local[0, 1] * dt
                u[t] += local[1, 0] * dn + local[1, 1] * dt
                r[n], r[t] = new_n, new_t
                if abs(dn) + abs(dt) <= 1e-15 * (abs(new_n) + abs(new_t)):
                    break
            dn, dt = r[n] - old_n, r[t] - old_t
            if dn or dt:
                un, ut = u[n], u[t]
                u += w[:, n] * dn + w[:, t] * dt
                u[n], u[t] = un, ut
        u = w @ r + q
    return r


def lemke(w, q, mu, scale):
    """Complementary pivoting on (r_n, mu r_n + r_t, slip down); returns reactions or None."""
    m = len(mu)
    wn, wt = w[0::2] / scale, w[1::2] / scale
    size = max(np.max(np.abs(q)), 1e-300)
    big = np.zeros((3 * m, 3 * m))
    friction = np.diag(mu)
    big[:m, :m] = wn[:, 0::2] - wn[:, 1::2] @ friction
    big[:m, m : 2 * m] = wn[:, 1::2]
    big[m : 2 * m, :m] = wt[:, 0::2] - wt[:, 1::2] @ friction
    big[m : 2 * m, m : 2 * m] = wt[:, 1::2]
    big[m : 2 * m, 2 * m :] = np.eye(m)
    big[2 * m :, :m] = 2 * friction
    big[2 * m :, m : 2 * m] = -np.eye(m)
    right = np.concatenate([q[0::2], q[1::2], np.zeros(m)]) / size
    n = 3 * m
    if np.all(right >= 0):
        return np.zeros(2 * m)
    # Columns: w, z, the artificial variable, the right side; a small lexical shift breaks ties.
    shift = 1e-13 * (1 + np.arange(n)) / n
    table = np.hstack([np.eye(n), -big, -np.ones((n, 1)), (right + shift)[:, None]])
    basis = list(range(n))
    row, entering = int(np.argmin(right + shift)), 2 * n
    for _ in range(60 * n):
        table[row] /= table[row, entering]
        for i in range(n):
            if i != row:
                table[i] -= table[i, entering] * table[row]
        leaving, basis[row] = basis[row], entering
        if leaving == 2 * n:
            z = np.zeros(n)
            for i, k in enumerate(basis):
                if n <= k < 2 * n:
                    z[k - n] = table[i, -1]
            r = np.empty(2 * m)
            r[0::2], r[1::2] = z[:m], z[m : 2 * m] - mu * z[:m]
            return r * size / scale
        entering = leaving + n if leaving < n else leaving - n
        column = table[:, entering]
        ratios = np.where(column > 1e-12, table[:, -1] / np.where(column > 1e-12, column, 1), np.inf)
        row = int(np.argmin(ratios))
        if not np.isfinite(ratios[row]):
            return None
    return None


def follow_states(w, q, mu, r, scale, limit=40):
    """Newton on the states: returns reactions that fulfil the law, or None."""
    seen = set()
    for _ in range(limit):
        states = states_of(w, q, mu, r, scale)
        key = states.tobytes()
        if key in seen:
            return None
        seen.add(key)
        r = by_states(w, q, mu, states)
        if misfit(w, q, mu, r) <= TOLERANCE:
            return r
    return None


def solve(w, q, mu, start):
    """Returns the reactions; w (2 m, 2 m), q (2 m) in the order n, t of each row."""
    if len(mu) == 0:
        return np.zeros(0)
    scale = np.mean(np.diag(w))
    if np.all(q[0::2] >= 0):
        return np.zeros(len(q))
    held = by_states(w, q, mu, np.where(q[0::2] < 0, STICK, OPEN))
    for first in (start, np.zeros(len(q)), held):
        r = follow_states(w, q, mu, first, scale)
        if r is not None:
            return r
    best, r = None, start.copy()
    for count in (5, 20, 50, 100, 200, 400, 800):
        r = sweep(w, q, mu, r, count)
        found = follow_states(w, q, mu, r.copy(), scale)
        if found is not None:
            return found
        if misfit(w, q, mu, r) <= TOLERANCE:
            return r
    r = lemke(w, q, mu, scale)
    if r is not None:
        found = follow_states(w, q, mu, r, scale)
        best = r if found is None else found
        if misfit(w, q, mu, best) <= 1e-10:
            return best
    raise NoSolution(f"misfit {misfit(w, q, mu, best if best is not None else r):.1e}")
