"""Scenes of the report: their decks, and the errors of a finished run."""

import json
import math
import os

import common
import compare
import make_bars
import make_scenes
import numpy as np
import tables
from analytic import SlidingBlock
from combinations import bar_options, options

SCENES = {
    "aligned": "two equal bars, touch at the end of a step",
    "unaligned": "two equal bars, touch in mid-step",
    "random": "two equal bars, mesh spacing 5 % random, touch in mid-step",
    "poisson": "two bars with Poisson ratio 0.3, against a fine mesh",
    "unequal": "bar of 5 hits a bar of 10 at rest, touch in mid-step",
    "bouncing": "bar falls on a wall and bounces, one period",
    "sliding": "block slides to rest on a plane",
    "slip": "wide block meets a held body obliquely and slips: P and S waves",
    "stick": "wide block meets a held body obliquely and sticks",
    "block": "block thrown obliquely at a plane, friction, against a fine mesh",
    "disc": "disc thrown obliquely at a plane, friction, against a fine mesh",
}
BY_BARS = ("aligned", "unaligned", "random", "poisson", "unequal")  # of make_bars.py
FINE = ("block", "disc")  # against numbers that are kept, see references.py
TABLES = ["glstat", "nodout", "rcforc=step"]
REFERENCES = os.path.join(common.ROOT, "bench", "references")


def write_scene(path, run):
    """Writes the deck of a run; returns the data for the comparison."""
    scene, n, courant = run["scene"], run["n"], run["courant"]
    if scene in BY_BARS:
        own = {
            "aligned": dict(touch=0.0),
            "unaligned": dict(touch=0.5),
            "random": dict(touch=0.5, random=(0.05, 7)),
            "poisson": dict(touch=0.5, poisson=0.3, ny=max(1, n // 10)),
            "unequal": dict(touch=0.5, length=5.0, length2=10.0, v1=1.0, v2=0.0),
        }[scene]
        chosen = dict(bar_options(run), nx=n, courant=courant, tables=TABLES)
        return make_bars.write(path, **dict(chosen, **own))
    own = {
        "slip": dict(wide=10 * n // 3, touch=0.5),
        "stick": dict(wide=10 * n // 3, touch=0.5, mu=0.6),
    }.get(scene, {})
    name = "oblique" if scene in ("slip", "stick") else scene
    return make_scenes.write(path, name, n=n, courant=courant, **dict(options(run), **own))


def relative(found, wanted):
    """Error in the mean square over time, relative."""
    return math.sqrt(np.sum((found - wanted) ** 2) / np.sum(wanted**2))


def of_bars(run, folder, meta, reference):
    """Two bars: exact, or a fine mesh for Poisson 0.3 (displacement and energy alone)."""
    found = compare.measure(folder, meta)
    if run["scene"] == "poisson":
        t, u = compare.Run(folder, meta).tip()
        shift = meta["touch"] - reference["touch"]
        wanted = np.interp(t - shift, reference["time"], reference["u"]) + shift * meta["v0"]
        inside = t - shift <= reference["time"][-1]
        return {"err": relative(u[inside], wanted[inside]), "energy": abs(found["dE_end"])}
    bars = compare.Run(folder, meta)
    t, v = bars.tip("v")
    dt = meta["dt"]
    # The exact velocity at a row is its mean over a hundredth of a step before it.
    wanted = (bars.exact.tip(t) - bars.exact.tip(t - 0.01 * dt)) / (0.01 * dt)
    return {
        "err": found["err"],
        "e_v": np.abs(v - wanted)[1:].mean() / meta["v0"],
        "e_R": found["e_R"],
        "e_R2": found["e_R2"],
        "energy": abs(found["dE_end"]),
    }


def of_bouncing(run, folder, meta, reference):
    exact, dt = meta["exact"], meta["dt"]
    rows = tables.read_run(folder, "nodout").select(node=meta["face"][0])
    z = exact.bottom(rows["time"])
    force = tables.read_run(folder, "rwforc")
    fine = np.linspace(0.5 / 16, 1.0 - 0.5 / 16, 16)
    steps = np.array([exact.force(t - dt + dt * fine).mean() for t in force["time"][1:]])
    two = 0.5 * (steps[1:] + steps[:-1])
    speed = (z - exact.bottom(rows["time"] - 0.01 * dt)) / (0.01 * dt)
    glstat = tables.read_run(folder, "glstat")
    gain = glstat["total"][-1] - glstat["external"][-1] - glstat["total"][0]
    return {
        "err": relative(rows["ux"], z - exact.height),
        "e_v": np.abs(rows["vx"] - speed)[1:].mean() / (exact.gravity * exact.fall),
        "e_R": np.abs(force["fx"][1:] - steps).sum() / steps.sum(),
        "e_R2": np.abs(force["fmx"][2:] - two).sum() / two.sum(),
        "energy": abs(gain) / exact.energy,
    }


def of_sliding(run, folder, meta, reference):
    exact = SlidingBlock(meta["v"], meta["mu"], meta["g"], meta["mass"])
    parts = tables.read_run(folder, "matsum")
    steps = 0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * np.diff(parts["time"])
    place = np.concatenate(([0.0], np.cumsum(steps)))
    speed = np.maximum(0.0, meta["v"] - meta["mu"] * meta["g"] * parts["time"])
    force = tables.read_run(folder, "rwforc")
    slides = force["time"] < exact.stop
    wanted = meta["mu"] * meta["mass"] * meta["g"]
    glstat = tables.read_run(folder, "glstat")
    work = glstat["friction"][-1] / exact.friction_work(9.0)
    return {
        "err": relative(place, exact.place(parts["time"])),
        "e_v": np.abs(parts["vx"] - speed).mean() / meta["v"],
        "e_R": np.abs(np.abs(force["fx"][1:]) - wanted)[slides[1:]].mean() / wanted,
        "e_R2": np.abs(np.abs(force["fmx"][2:]) - wanted)[slides[2:]].mean() / wanted,
        "work": abs(work - 1.0),
    }


def of_oblique(run, folder, meta, reference):
    """The middle of the foot, from the touch until its sides are heard of."""
    exact, dt = meta["exact"], meta["dt"]
    rows = tables.read_run(folder, "nodout").select(node=meta["middle"])
    force = tables.read_run(folder, "ncforc").select(node=meta["middle"])
    p, tau = exact.traction(0.5 * meta["tend"])
    slip = exact.slip(0.5 * meta["tend"])
    t, touch, layer = rows["time"], meta["touch"], exact.layer
    after = np.maximum(t - touch, 0.0)
    u = np.concatenate((layer.tangential * (t - after) + slip * after, after - t))
    speed = np.where(t > touch, slip, layer.tangential)
    found = np.concatenate((rows["ux"], rows["uy"]))
    in_step = np.clip((force["time"] - touch) / dt, 0.0, 1.0)  # contact's share of a step
    in_two = np.clip((force["time"] - touch) / dt, 0.0, 2.0) / 2.0
    unit = math.hypot(p, tau)

    def off_by(prefix, share):
        fx, fy = (force[prefix + axis] / meta["share"] for axis in "xy")
        return np.hypot(fx + tau * share, fy - p * share)

    # Work of the middle's own force, with its own slip: tau x slip x time.
    lost = -np.sum((force["fx"] * rows["vmx"][-len(force) :])[1:]) * dt
    wanted = tau * slip * meta["share"] * (t[-1] - touch)
    flight = math.hypot(layer.normal, layer.tangential) * t  # a face that sticks does not move
    return {
        "err": math.sqrt(np.sum((found - u) ** 2) / np.sum(flight**2)),
        "e_v": (np.abs(rows["vx"] - speed) + np.abs(rows["vy"]))[t > touch].mean(),
        "e_R": off_by("f", in_step)[1:].mean() / unit,
        "e_R2": off_by("fm", in_two)[2:].mean() / unit,
        "work": abs(lost / wanted - 1.0) if wanted > 1e-12 else None,
    }


# ---------------------------------------------------------------- against a fine mesh


def history_of(folder, meta, times):
    """What is compared with a fine mesh, at given times: lists by name."""
    rows = tables.read_run(folder, "nodout").select(node=meta["lowest"])
    parts = tables.read_run(folder, "matsum")
    force, glstat = tables.read_run(folder, "rwforc"), tables.read_run(folder, "glstat")
    found = {k: np.interp(times, rows["time"], rows[k]) for k in ("ux", "uy")}
    found.update({k: np.interp(times, parts["time"], parts[k]) for k in ("vx", "vy")})
    found.update({k: np.interp(times, force["time"], force[k]) for k in ("ix", "iy")})
    energy = glstat["total"] / glstat["initial"][0]
    found["energy"] = np.interp(times, glstat["time"], energy)
    found["friction"] = np.interp(
        times, glstat["time"], glstat["friction"] / glstat["initial"][0]
    )
    return {name: values.tolist() for name, values in found.items()}


def distance(found, wanted, speed):
    """Errors of a history against another: {measure: value}."""
    a, b = ({k: np.array(v) for k, v in h.items()} for h in (found, wanted))

    def both(h, x, y):
        return np.concatenate((h[x], h[y]))

    windows = [np.concatenate([np.diff(h["ix"]), np.diff(h["iy"])]) for h in (a, b)]
    total = np.hypot(b["ix"][-1], b["iy"][-1])
    speeds = np.hypot(a["vx"] - b["vx"], a["vy"] - b["vy"])
    return {
        "err": relative(both(a, "ux", "uy"), both(b, "ux", "uy")),
        "e_v": speeds.mean() / speed,
        "e_R2": np.abs(windows[0] - windows[1]).sum() / total,
        "energy": abs(a["energy"][-1] - b["energy"][-1]),
        "work": abs(a["friction"][-1] / b["friction"][-1] - 1.0),
    }


def kept_reference(scene):
    """Numbers of references.py: {time, history, bound, made}."""
    with open(os.path.join(REFERENCES, scene + ".json")) as file:
        return json.load(file)


def of_fine(run, folder, meta, reference):
    kept = kept_reference(run["scene"])
    found = history_of(folder, meta, np.array(kept["time"]))
    return distance(found, kept["history"], meta["v"])


MEASURES_OF = dict.fromkeys(BY_BARS, of_bars)
MEASURES_OF.update(bouncing=of_bouncing, sliding=of_sliding, slip=of_oblique, stick=of_oblique)
MEASURES_OF.update(dict.fromkeys(FINE, of_fine))


def errors_of(run, folder, meta, reference):
    """{measure: value or None} of a finished run: err, e_v, e_R, e_R2, energy, work."""
    found = dict.fromkeys(("err", "e_v", "e_R", "e_R2", "energy", "work"))
    found.update(MEASURES_OF[run["scene"]](run, folder, meta, reference))
    return {k: None if v is None else float(v) for k, v in found.items()}
