"""Histories of a run as quantities, distances between them, and what a set of runs says of the
truth: a reference with a bar, observed orders, and which sequences converge to it.

A quantity is a history of numbers, of one of two kinds:

    state   values at common times; distance = rms over times and ids, over the range
    force   an impulse; distance = sum |mean force over a window - that of the other| dt over
            the other's sum of |force| dt. A window is two steps; where a mesh has runs with
            several, two of the largest, so that no reference is asked for more than it resolves

No exact solution is used here. A sequence is one scheme, mass, ratio of step to mesh on finer
and finer meshes (or one scheme and mass with smaller and smaller steps on one mesh). With d the
distance of its last two runs and p the order, its last run is wrong by about d/(r^p - 1)
(Richardson 1911; Roache 1994), r = ratio of refinement. The reference is the mean of the last
runs of the better half of the methods, different schemes and masses; its bar is SAFETY times
the larger of the median of their expected errors and of the largest distance from it. A method
does not converge in a quantity where half of its sequences or more do not."""

import math
from dataclasses import dataclass, field, replace

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from tables import read_run

SAFETY = 1.25  # factor of a bar of three grids (Roache 1994, grid convergence index)
LEAST_ORDER = 0.2  # below it the error halves in five refinements at best: no convergence
CLEAR = 3.0  # times the bar: an error that is known to a third
ORDERS = (0.5, 1.0)  # across an impact: what an order may be taken for
ENERGIES = "kinetic internal total external motion friction damping".split()


# ---------------------------------------------------------------- quantities


@dataclass
class Quantity:
    """times (n) [T]; values (n, ids, components): the state, or the impulse of a force.

    group: quantities of one group share their range, as energies of one table do.
    window: of a force, over which it is averaged [T]."""

    kind: str
    times: np.ndarray
    values: np.ndarray
    group: str = ""
    window: float = 0.0


def by_ids(table, columns, first_of=None):
    """(times, values (n, ids, components)) of a table; None where rows are missing."""
    keep = table if first_of is None else table.select(**first_of)
    ids = [keep[name] for name in keep.id_columns]
    times = np.unique(keep["time"])
    count = len(keep) // max(1, len(times))
    if not len(keep) or count * len(times) != len(keep):
        return None
    if ids and not all(np.array_equal(i, np.tile(i[:count], len(times))) for i in ids):
        return None
    return times, keep.vectors(*columns).reshape(len(times), count, len(columns))


def velocity_of(times, place):
    """Mean velocity between rows; at the first row that of the first interval."""
    speed = np.diff(place, axis=0) / np.diff(times)[:, None, None]
    return np.concatenate([speed[:1], speed])


def quantities(folder, window, same_mesh=True):
    """{name: Quantity} of the tables of a run, forces over a window. What belongs to elements
    is taken only where all runs have the same ones."""
    found = {}

    def add(name, kind, table, columns, group="", first_of=None, change=None):
        pair = by_ids(table, columns, first_of)
        if pair is not None and len(pair[0]) > 2 and np.isfinite(pair[1]).all():
            times, values = pair
            values = change(times, values) if change else values
            found[name] = Quantity(kind, times, values, group, window)

    table = read_run(folder, "glstat")
    if table is not None:
        for name in ENERGIES:
            add("glstat " + name, "state", table, [name], "energy")
    table = read_run(folder, "matsum")
    if table is not None:
        for name in ("kinetic", "internal"):
            add("matsum " + name, "state", table, [name], "part energy")
        add("matsum velocity", "state", table, ["vx", "vy"])
    table = read_run(folder, "nodout")
    if table is not None:
        add("nodout displacement", "state", table, ["ux", "uy"])
        add("nodout velocity", "state", table, ["ux", "uy"], change=velocity_of)
    for name, one in (("rcforc", {"side": 1}), ("rwforc", None)):
        table = read_run(folder, name)
        if table is not None:
            add(name + " force", "force", table, ["ix", "iy"], first_of=one)
            add(name + " impulse", "state", table, ["ix", "iy"], first_of=one)
    table = read_run(folder, "spcforc")
    if table is not None:
        add("spcforc force", "force", table, ["fx", "fy"], change=impulse_of_sum)
    table = read_run(folder, "sleout")
    if table is not None:
        for name in ("frictionwork",):
            add("sleout " + name, "state", table, [name], "energy")
    table = read_run(folder, "elout")
    if same_mesh and table is not None:
        add("elout stress", "state", table, ["sxx", "syy", "sxy"])
    return found


def impulse_of_sum(times, forces):
    """Impulse of the sum over all nodes of forces that are means of steps."""
    total = forces.sum(axis=1, keepdims=True)
    steps = np.diff(times, prepend=times[0])[:, None, None]
    return np.cumsum(total * steps, axis=0)


def at_times(quantity, times):
    """Values at other times, between rows by a straight line."""
    t, values = quantity.times, quantity.values
    if np.array_equal(t, times):
        return values
    flat = values.reshape(len(t), -1)
    found = np.column_stack([np.interp(times, t, column) for column in flat.T])
    return found.reshape(len(times), *values.shape[1:])


# ---------------------------------------------------------------- distances


def size(values):
    """Length over ids and components, for each time."""
    return np.sqrt(np.sum(values**2, axis=(1, 2)))


def spread_of(quantity):
    """What distances are divided by: range of a state (the largest of its ids), or the sum of
    |force| dt."""
    if quantity.kind == "force":
        return float(np.sum(size(np.diff(quantity.values, axis=0))))
    extent = np.ptp(quantity.values, axis=0)
    return float(np.max(np.sqrt(np.sum(extent**2, axis=1)), initial=0.0))


def distance(one, other, unit):
    """Distance of a run's quantity from another's, or from a reference or the truth."""
    if one.values.shape[1:] != other.values.shape[1:]:
        return math.nan
    if one.kind == "force":
        t = one.times
        start = np.maximum(t[1:] - one.window, 0.0)
        span = (t[1:] - start)[:, None, None]
        off = (one.values[1:] - at_times(other, t[1:])) / span
        off -= (at_times(one, start) - at_times(other, start)) / span
        return float(np.sum(size(off) * np.diff(t)) / unit)
    times = one.times if len(one.times) <= len(other.times) else other.times
    off = size(at_times(one, times) - at_times(other, times))
    return float(np.sqrt(np.mean(off**2) / one.values.shape[1]) / unit)


def mean_of(histories):
    """Mean history, at the times of the finest."""
    finest = max(histories, key=lambda q: len(q.times))
    values = sum(at_times(q, finest.times) for q in histories) / len(histories)
    return replace(finest, values=values)


# ---------------------------------------------------------------- sequences


@dataclass
class Sequence:
    """Runs of one scheme and mass, coarse to fine. `widths`: mesh or step of each."""

    method: tuple  # (scheme, mass, ratio)
    runs: list
    widths: list
    trusted: bool = True  # no run of it gained energy
    steps: list = field(default_factory=list)  # distance of each run from the next
    order: float = math.nan  # of the distances
    expected: float = math.inf  # error of the last run, from them
    errors: list = field(default_factory=list)  # distance from the reference
    slope: float = math.nan  # order of the errors
    verdict: str = ""


@dataclass
class Estimate:
    """What the study says of one quantity."""

    name: str
    unit: float
    sequences: list
    reference: Quantity = None
    bar: float = math.inf
    members: list = field(default_factory=list)
    order: float = math.nan
    errors: dict = field(default_factory=dict)  # {run: error}
    bars: dict = field(default_factory=dict)  # {run: bar}
    stuck: set = field(default_factory=set)  # (scheme, mass) that do not converge


def slope(widths, errors):
    """Order: slope of log error over log width."""
    good = [(w, e) for w, e in zip(widths, errors) if e > 0.0 and math.isfinite(e)]
    if len(good) < 2:
        return math.nan
    x, y = np.log(np.array(good)).T
    return float(np.polyfit(x, y, 1)[0])


def measure_steps(sequence, histories, unit):
    """Distances of neighbours and their order."""
    q = [histories[run] for run in sequence.runs]
    sequence.steps = [distance(a, b, unit) for a, b in zip(q, q[1:])]
    sequence.order = slope(sequence.widths[:-1], sequence.steps)


def expect(sequence, order):
    """Error of the last run: each distance tells of it, at the order; the largest counts, for
    one alone may be small by chance."""
    widths = sequence.widths
    sequence.expected = max(
        d / ((a / widths[-1]) ** order - (b / widths[-1]) ** order)
        for d, a, b in zip(sequence.steps, widths, widths[1:])
    )


def is_steady(sequence):
    """May a sequence tell of the truth: do its distances fall, without a gain of energy?"""
    return len(sequence.runs) > 2 and sequence.trusted and sequence.order >= LEAST_ORDER


def best_of_methods(sequences):
    """One sequence for each scheme and mass: that of the least expected error."""
    best = {}
    for s in sorted(sequences, key=lambda s: s.expected):
        best.setdefault(s.method[:2], s)
    return list(best.values())


def choose_members(sequences, one_mesh):
    """Sequences whose last runs make the reference. On finer meshes: the better half of the
    methods, three at least, for the best one may only look so; on one mesh the best of each
    mass, whose differences are all that tells of the error of the mesh."""
    best = best_of_methods(sequences)
    if one_mesh:
        masses = {}
        for s in best:
            masses.setdefault(s.method[1], s)
        return list(masses.values())
    return best[: max(3, (len(best) + 1) // 2)]


def estimate(name, sequences, histories, one_mesh=False, unit=None):
    """Reference, bar, orders, errors of one quantity; histories {run: Quantity}."""
    runs = list(histories)
    finest = max((histories[r] for r in runs), key=lambda q: len(q.times))
    found = Estimate(name, unit or spread_of(finest), sequences)
    for s in sequences:
        measure_steps(s, histories, found.unit)
    steady = [s for s in sequences if is_steady(s)]
    if not steady:
        return found
    found.order = float(np.clip(np.median([s.order for s in steady]), *ORDERS))
    for s in steady:
        expect(s, found.order)
    found.members = choose_members(steady, one_mesh)
    last = [histories[s.runs[-1]] for s in found.members]
    found.reference = mean_of(last)
    apart = [distance(q, found.reference, found.unit) for q in last]
    found.bar = SAFETY * max(
        max(apart), float(np.median([s.expected for s in found.members]))
    )
    judge(found, histories)
    return found


def judge(found, histories):
    """Errors against the reference, with their bars; which sequences converge to it."""
    for run, history in histories.items():
        error = distance(history, found.reference, found.unit)
        found.errors[run] = error
        found.bars[run] = found.bar * (1.0 + error)  # the unit is known to the bar, too
    for s in found.sequences:
        s.errors = [found.errors[run] for run in s.runs]
        s.slope = slope(s.widths, s.errors)
        s.verdict = verdict(s, found.bar)
    verdicts = {}
    for s in found.sequences:
        verdicts.setdefault(s.method[:2], []).append(s.verdict == "does not converge")
    found.stuck = {method for method, stays in verdicts.items() if 2 * sum(stays) >= len(stays)}


def verdict(sequence, bar):
    """What the errors of a sequence say, which the reference knows to the bar: they fall;
    they are too near the bar to tell; they stay."""
    first, last = sequence.errors[0], sequence.errors[-1]
    if last <= CLEAR * bar:
        return "below the bar" if last <= bar else "near the bar"
    if sequence.slope >= LEAST_ORDER and last < first:
        return "converges"
    return "does not converge"


def rescale(found, unit):
    """The same estimate in another unit."""
    ratio, found.unit = found.unit / unit, unit
    found.bar *= ratio
    for s in found.sequences:
        s.steps = [d * ratio for d in s.steps]
        s.errors = [e * ratio for e in s.errors]
        s.expected *= ratio
    for run, error in found.errors.items():
        found.errors[run] = error * ratio
        found.bars[run] = found.bar * (1.0 + error * ratio)


def estimate_all(sequences, histories, one_mesh=False):
    """{name: Estimate}. sequences: () -> fresh list of Sequence; histories {run: {name:
    Quantity}}. Units come from the references, those of a group from its largest one."""
    last = {s.runs[-1] for s in sequences()}
    names = list(dict.fromkeys(n for found in histories.values() for n in found))
    units, found = {}, {}
    for name in names:
        spreads = [spread_of(histories[r][name]) for r in last if name in histories[r]]
        group = group_of(histories, name)
        units[group] = max(units.get(group, 0.0), float(np.median(spreads or [0.0])))
    for name in names:
        having = {r: q[name] for r, q in histories.items() if name in q}
        unit = units[group_of(histories, name)]
        if unit == 0.0 or all(np.ptp(q.values) <= 1.0e-9 * unit for q in having.values()):
            if not is_conserved(name) or unit == 0.0:
                continue
        usable = [s for s in sequences() if all(r in having for r in s.runs)]
        found[name] = estimate(name, usable, having, one_mesh, unit)
    units = {}
    for name, e in found.items():
        if e.reference is not None:
            group = group_of(histories, name)
            units[group] = max(units.get(group, 0.0), spread_of(e.reference))
    for name, e in found.items():
        if units.get(group_of(histories, name)):
            rescale(e, units[group_of(histories, name)])
    return found


def is_conserved(name):
    """Is a quantity of interest where it does not change?"""
    return name == "glstat total"


def group_of(histories, name):
    return next(q[name].group or name for q in histories.values() if name in q)
