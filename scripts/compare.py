#!/usr/bin/env python3
"""Compare a run of two bars (or of a bar on a rigid wall) with the exact solution.

Measures, dimensionless but gapmin [L]; sums over table rows:
    err        sqrt(sum (u - u_ex)^2 / sum u_ex^2), u = displacement of the left bar's contact
               end along the axis, mean over its face nodes; over the nodout rows
    e_u        max |u - u_ex| / (v0 2L/c)
    e_R, e_R2  sum |R - R_ex| dt / impulse over every step; R = contact force of the step (f)
               and mean of the last two steps (fm), R_ex = exact mean over the same time
    impulse    computed impulse at the end over the exact one
    osc        rms of vm/v0, vm = step-mean velocity of the contact end, over the steps wholly
               inside (t1, t2) without the first and last; for unequal bars vm minus its exact
               value, inside the time with force
    E_end, E_max      last and greatest total energy / E0;  dE_end, dE_max the same minus 1
    residual   max |residual| of the energy ledger
    momentum, angular   greatest change of the momentum / sum m|v| (angular: times L)
    force_sum  max |f_1 + f_2| of the two contact sides / max |f|
    gapmin     smallest gap of a contact node, negative = penetration [L]
E0 = initial energy; where it is 0, the largest term of the balance.  L, c, v0 of bar 1, v0 =
half of the closing speed (wall: the speed).  A measure that the tables do not hold is n/a.

Exit code: 0 all bounds of --check are met, 1 a bound is missed or the run did not end with
'done', 2 the tables or the options cannot be used.
"""

import argparse
import json
import os
import re
import sys

import startup  # noqa: F401  before what is no part of Python
import numpy as np

from analytic import impact_of
from tables import TableError, read_run

ORDER = (
    "err",
    "e_u",
    "e_R",
    "e_R2",
    "impulse",
    "osc",
    "E_end",
    "dE_end",
    "E_max",
    "dE_max",
    "residual",
    "momentum",
    "angular",
    "force_sum",
    "gapmin",
)
ONE_SIDED = re.compile(r"^(\w+)\s*(<=|>=|<|>)\s*(\S+)$")
RANGE = re.compile(r"^(\w+)\s+in\s+(\S+?)\.\.(\S+)$")
RELATIONS = {"<=": np.less_equal, ">=": np.greater_equal, "<": np.less, ">": np.greater}


# ---------------------------------------------------------------- the scene


def load_meta(path):
    """Data of the scene that make_bars.py --meta wrote."""
    with open(path, encoding="ascii") as stream:
        return json.load(stream)


def bar_data(length, speed, density, area, velocity):
    """One bar as in the json of make_bars.py."""
    return {
        "length": length,
        "speed": speed,
        "impedance": density * speed * area,
        "velocity": velocity,
    }


def meta_of(case, length, speed, v0, gap, area, density, second=None, **more):
    """Scene from plain numbers; `second` overrides length, speed, density, velocity of bar 2.
    more: axis, face1 (node ids), sides."""
    two = dict(length=length, speed=speed, density=density, velocity=-v0)
    two.update({k: v for k, v in (second or {}).items() if v is not None})
    bars = [bar_data(length, speed, density, area, v0), bar_data(area=area, **two)]
    half_closing = v0 if case == "wall" else 0.5 * (v0 - two["velocity"])
    meta = {
        "case": case,
        "bars": bars,
        "gap": gap,
        "v0": half_closing,
        "L": length,
        "c": speed,
        "axis": [1.0, 0.0],
        "sides": [1, 2],
        "face1": None,
    }
    meta.update({k: v for k, v in more.items() if v is not None})
    return meta


def contact_face(nodout, meta):
    """Node ids of the left bar's contact face: as given, or found at t = 0 as the nodes on the
    left of the distance that equals the gap (wall: the foremost nodes)."""
    if meta.get("face1"):
        return [n for n in meta["face1"] if n in nodout["node"]]
    first = nodout.rows(nodout["time"] == nodout["time"].min())
    along = first.vectors("x", "y") @ np.array(meta["axis"])
    places = np.unique(np.round(along, 9 - int(np.floor(np.log10(meta["L"])))))
    if meta["case"] == "wall" or len(places) < 2:
        face = places[-1]
    else:
        face = places[np.argmin(np.abs(np.diff(places) - meta["gap"]))]
    near = 1e-6 * meta["L"]
    return [int(n) for n in first["node"][np.abs(along - face) < near]]


class Run:
    """Tables of a run directory next to the exact solution of its scene.

    All vectors are taken along the axis (from bar 1 to bar 2); tables not written are None."""

    why = ""  # why the exact solution is not that of the run; none is drawn then

    def __init__(self, directory, meta):
        self.directory, self.meta = directory, meta
        self.axis = np.array(meta["axis"], dtype=float)
        self.glstat = read_run(directory, "glstat")
        self.nodout = read_run(directory, "nodout")
        forces = "rwforc" if meta["case"] == "wall" else "rcforc"
        self.rcforc = read_run(directory, forces)
        found = [t for t in (self.glstat, self.nodout, self.rcforc) if t is not None]
        if not any(len(t) for t in found):
            raise TableError("%s: no tables glstat, nodout, %s" % (directory, forces))
        self.status = found[0].status or "incomplete"
        ends = [t["time"][-1] for t in found if len(t)]
        self.exact = impact_of(meta, max(ends + [meta.get("tend", 0.0), meta["L"] / meta["c"]]))

    @property
    def dt(self):
        """Time step [T]; the widest of the glstat rows (a cut last step is shorter)."""
        if self.glstat is not None and len(self.glstat) > 1:
            return self.glstat["dt"].max()
        return self.meta.get("dt")

    def tip(self, prefix="u"):
        """Times [T] and displacement u [L], velocity v or vm [L T-1] of the contact end."""
        if self.nodout is None:
            return None
        face = contact_face(self.nodout, self.meta)
        if not face:
            raise TableError("%s: no row of the contact face" % self.nodout.path)
        tables = [self.nodout.select(node=n) for n in face]
        values = [t.vectors(prefix + "x", prefix + "y") @ self.axis for t in tables]
        return tables[0]["time"], np.mean(values, axis=0)

    def sides(self):
        """Rows of the forces on bar 1 and on bar 2 of the first contact; None for the wall."""
        if self.rcforc is None or self.meta["case"] == "wall":
            return None
        contact = self.rcforc.select(contact=self.rcforc["contact"].min())
        return [contact.select(side=s) for s in self.meta["sides"]]

    def force(self, prefix="f"):
        """Times [T] and contact force [F], compression positive; prefix f, fm or i."""
        if self.rcforc is None:
            return None
        names = (prefix + "x", prefix + "y")
        if self.meta["case"] == "wall":
            rows = self.rcforc.select(wall=self.rcforc["wall"].min())
            return rows["time"], -(rows.vectors(*names) @ self.axis)
        one, two = self.sides()
        return one["time"], 0.5 * ((two.vectors(*names) - one.vectors(*names)) @ self.axis)

    def every_step(self, times):
        """True if these are the times of all steps."""
        cycles = self.rcforc.cycle if self.rcforc.cycle is not None else self.meta.get("steps")
        if self.glstat is not None and len(self.glstat):
            cycles = self.glstat["cycle"][-1]
        return cycles is not None and len(times) == cycles + 1


# ---------------------------------------------------------------- measures


def displacement_errors(run):
    """err and e_u, see the head of this file."""
    if run.nodout is None:
        return {}
    t, u = run.tip()
    exact = run.exact.tip(t)
    if not exact.any():
        return {}
    unit = run.meta["v0"] * 2.0 * run.meta["L"] / run.meta["c"]
    return {
        "err": np.sqrt(np.sum((u - exact) ** 2) / np.sum(exact**2)),
        "e_u": np.max(np.abs(u - exact)) / unit,
    }


def force_errors(run):
    """e_R, e_R2 (only if the table has every step) and the impulse."""
    if run.rcforc is None:
        return {}
    t, impulse = run.force("i")
    total = run.exact.impulse(t[-1])
    if total == 0.0:
        return {}
    result = {"impulse": impulse[-1] / total}
    if run.every_step(t):
        spans = np.diff(t)
        for name, prefix, back in (("e_R", "f", 1), ("e_R2", "fm", 2)):
            start = t[np.maximum(np.arange(1, len(t)) - back, 0)]
            off = run.force(prefix)[1][1:] - run.exact.mean_force(start, t[1:])
            result[name] = np.sum(np.abs(off) * spans) / total
    return result


def steps_in_contact(run, times):
    """Mask of the rows whose step lies wholly inside (t1, t2), without the first and last such
    step; t1, t2 = start and end of the contact force."""
    dt, tiny = run.dt, 1e-6
    first = np.ceil(run.exact.touch / dt - tiny) + 1
    last = np.floor(run.exact.release / dt + tiny)
    step = np.rint(times / dt)
    return (step > first) & (step < last)


def oscillation(run):
    """osc: rms of the contact end's step-mean velocity in contact over v0."""
    if run.nodout is None or not np.isfinite(run.exact.release) or not run.dt:
        return {}
    t, vm = run.tip("vm")
    inside = steps_in_contact(run, t)
    if not inside.any():
        return {}
    exact = (run.exact.tip(t) - run.exact.tip(t - run.dt)) / run.dt
    if run.meta["case"] != "unequal":
        exact = 0.0 * exact  # held end: free of the round-off of the difference
    off = (vm - exact)[inside] / run.meta["v0"]
    return {"osc": np.sqrt(np.mean(off**2))}


def energy_measures(run):
    """E_end, E_max, dE_end, dE_max, residual."""
    table = run.glstat
    if table is None or not len(table):
        return {}
    total, initial = table["total"], table["initial"][0]
    terms = ("external", "motion", "friction", "contact", "algorithmic", "damping", "total")
    unit = initial or max(np.max(np.abs(table[name])) for name in terms) or 1.0
    change = (total - initial) / unit
    return {
        "E_end": total[-1] / unit,
        "E_max": total.max() / unit,
        "dE_end": change[-1],
        "dE_max": change.max(),
        "residual": np.max(np.abs(table["residual"])),
    }


def momentum_measures(run):
    """Greatest change of momentum and angular momentum; not for the wall."""
    table = run.glstat
    if table is None or not len(table) or run.meta["case"] == "wall":
        return {}
    scale = run.exact.momentum_scale

    def drift(*names):  # greatest change of a vector
        vectors = table.vectors(*names)
        return np.max(np.linalg.norm(vectors - vectors[0], axis=1))

    return {
        "momentum": drift("momx", "momy", "momz") / scale,
        "angular": drift("angx", "angy", "angz") / (scale * run.meta["L"]),
    }


def contact_measures(run):
    """force_sum and gapmin."""
    if run.rcforc is None or not len(run.rcforc):
        return {}
    result = {"gapmin": np.min(run.rcforc["gapmin"])}
    if run.sides() is not None:
        one, two = (side.vectors("fx", "fy", "fz") for side in run.sides())
        greatest = np.max(np.linalg.norm(one, axis=1))
        result["force_sum"] = np.max(np.linalg.norm(one + two, axis=1)) / (greatest or 1.0)
    return result


def measure(directory, meta):
    """All measures of a run: {name: number}, None where the tables do not hold it, and
    'status' = done, failed, stopped or incomplete."""
    run = Run(directory, meta)
    result = dict.fromkeys(ORDER)
    for part in (
        displacement_errors,
        force_errors,
        oscillation,
        energy_measures,
        momentum_measures,
        contact_measures,
    ):
        result.update({name: float(value) for name, value in part(run).items()})
    result["status"] = run.status
    return result


# ---------------------------------------------------------------- bounds


def parse_check(text):
    """(name, test, words) of 'NAME<=VALUE' or 'NAME in LO..HI'."""
    match = ONE_SIDED.match(text.strip())
    if match:
        name, relation, bound = match.groups()
        return name, lambda v, b=float(bound): RELATIONS[relation](v, b), relation + " " + bound
    match = RANGE.match(text.strip())
    if match:
        name, low, high = match.groups()
        return name, lambda v: float(low) <= v <= float(high), "in %s..%s" % (low, high)
    raise ValueError("cannot read the bound '%s': write NAME<=VALUE or 'NAME in LO..HI'" % text)


def missed_bounds(result, checks):
    """One line of text for each bound that is missed; a run must be done."""
    lines = []
    if checks and result["status"] != "done":
        lines.append("the run is %s, not done" % result["status"])
    for text in checks:
        name, test, words = parse_check(text)
        if name not in ORDER:
            raise ValueError("unknown measure '%s'; known: %s" % (name, " ".join(ORDER)))
        value = result[name]
        if value is None:
            lines.append("%s is n/a (not in the tables), wanted %s" % (name, words))
        elif not test(value):
            lines.append("%s = %.6g, wanted %s" % (name, value, words))
    return lines


# ---------------------------------------------------------------- command line


def numbers(text):
    """'a,b' as a list of numbers."""
    return [float(part) for part in text.split(",")]


def node_ids(text):
    """'a,b' as a list of ids."""
    return [int(part) for part in text.split(",")]


def make_parser():
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Example: compare.py two_bars.out --meta two_bars.json --check 'err<=8.5e-3' "
        "'E_end in 0.994..1.000001'",
    )
    parser.add_argument("run", metavar="RUN_DIR", help="directory of the tables")
    parser.add_argument("--meta", metavar="FILE", help="scene, written by make_bars.py --meta")
    parser.add_argument(
        "--check",
        nargs="+",
        default=[],
        metavar="BOUND",
        help="NAME<=VALUE, NAME>=VALUE or 'NAME in LO..HI'",
    )
    parser.add_argument("--axis", type=numbers, metavar="UX,UY", help="from bar 1 to bar 2")
    parser.add_argument(
        "--nodes",
        type=node_ids,
        metavar="ID,ID",
        help="contact-face nodes of bar 1 (default: found by the gap)",
    )
    scene = parser.add_argument_group("scene without --meta (defaults: the paper's, gap 0.02)")
    scene.add_argument("--case", choices=("two_bars", "wall", "unequal"), default="two_bars")
    for name, default, text in (
        ("L", 10.0, "length of bar 1 [L]"),
        ("c", 1000.0, "wave speed [L T-1]"),
        ("v0", 1.0, "velocity of bar 1; bar 2: -v0"),
        ("gap", 0.02, "[L]"),
        ("height", 1.0, "[L]"),
        ("thickness", 1.0, "[L]"),
        ("density", 1.0e-3, "[M L-3]"),
        ("L2", None, "bar 2 (as bar 1)"),
        ("c2", None, ""),
        ("density2", None, ""),
        ("v2", None, "velocity of bar 2"),
    ):
        scene.add_argument("--" + name, type=float, default=default, help=text)
    return parser


def meta_of_arguments(a):
    """Scene from the command line."""
    if a.meta:
        meta = load_meta(a.meta)
        meta.update({k: v for k, v in (("axis", a.axis), ("face1", a.nodes)) if v})
    else:
        second = dict(length=a.L2, speed=a.c2, density=a.density2, velocity=a.v2)
        meta = meta_of(
            a.case,
            a.L,
            a.c,
            a.v0,
            a.gap,
            a.height * a.thickness,
            a.density,
            second,
            axis=a.axis,
            face1=a.nodes,
        )
    length = np.hypot(*meta["axis"])
    meta["axis"] = [component / length for component in meta["axis"]]
    return meta


def report(result):
    """Lines of text, one a measure."""
    yield "%-10s %s" % ("status", result["status"])
    for name in ORDER:
        value = result[name]
        yield "%-10s %s" % (name, "n/a" if value is None else "%.10g" % value)


def main(argv=None):
    arguments = make_parser().parse_args(argv)
    try:
        result = measure(arguments.run, meta_of_arguments(arguments))
        missed = missed_bounds(result, arguments.check)
    except (TableError, OSError, ValueError) as problem:
        print("compare.py: %s" % problem, file=sys.stderr)
        return 2
    print("\n".join(report(result)))
    for line in missed:
        print("MISSED %s: %s" % (os.path.basename(os.path.normpath(arguments.run)), line))
    if arguments.check and not missed:
        print("all %d bounds met" % len(arguments.check))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
