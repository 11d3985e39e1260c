"""Scenes of the stability atlas: each writes its deck and says by what a run of it is judged:
data for the comparison, whether it has an exact solution, the bound of its error, friction,
the way of a step."""

import math

import make_bars
import make_scenes
from analytic import SlidingBlock


def bars(path, scheme, o):
    """Two bars of 20 elements, touch in mid-step unless the gap is what varies."""
    n, courant = o.pop("n", 20), o.pop("courant", 0.5)
    width = 10.0 / n
    options = dict(scheme, nx=n, nx2=n, courant=courant, gap=0.02, touch=0.5)
    if "gap" in o:
        options.update(gap=o.pop("gap"), touch=None)
    # Waves are small where the speed is well below that of sound in both bars.
    sound = math.sqrt(min(1.0, o.get("youngs", 1.0) / o.get("densities", 1.0)))
    options["v0"] = min(1.0, 10.0 * sound)
    options["gap"] *= options["v0"]
    if "densities" in o:
        options["density2"] = 1.0e-3 * o.pop("densities")
    if "youngs" in o:
        options["young2"] = 1.0e3 * o.pop("youngs")
    if "slip" in o:
        options.update(mu=o.pop("slip"), slide=0.25, poisson=0.3, ny=2)
    if "poisson" in o:
        options.update(poisson=o.pop("poisson"), ny=4)
    if "aspect" in o:
        options["height"] = width / o.pop("aspect")
    if "unit" in o:
        name, factor = o.pop("unit")
        options["scale_" + name] = factor
    nu = options.get("poisson", 0.0)
    dt = courant * width / 1.0e3 / math.sqrt((1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)))
    if nu:  # whole steps of the P wave, which the mass DISPERSION asks for
        options.update(courant=None, dt=dt)
        options["tend"] = math.ceil(max(0.05, 30.0 * dt) / dt - 1.0e-9) * dt
    else:
        options["tend"] = max(0.05, 30.0 * dt)
    options = {k: v for k, v in options.items() if v is not None}
    meta = make_bars.write(path, output="step", **options)
    # The waves of a bar 1e12 times stiffer return a million times: it is compared with one of the
    # same mass, 1e8 times stiffer, from which it differs by the ratio of impedances, 1e-4.
    for bar, other in zip(meta["bars"], meta["bars"][::-1]):
        if bar["speed"] > 1.0e4 * other["speed"]:
            excess = bar["speed"] / (1.0e4 * other["speed"])
            bar.update(speed=bar["speed"] / excess, impedance=bar["impedance"] / excess)
    return {
        "meta": meta,
        "exact": options.get("poisson", 0.0) == 0.0,
        "bound": (1.0 + courant) / n,
        "mu": options.get("mu", 0.0),
        "way": 2.0 * options["v0"] * meta["dt"],
        "edge": width,
    }


def wall(path, scheme, o):
    """A bar of 20 elements on a rigid wall."""
    courant, poisson = o.get("courant", 0.5), o.get("poisson", 0.0)
    dt = courant * 0.5 / 1.0e3
    touch = 0.5 if courant <= 10.0 else None
    meta = make_scenes.write(
        path,
        "wall",
        n=20,
        ny=4 if poisson else 1,
        courant=courant,
        poisson=poisson,
        touch=touch,
        tend=max(0.05, 30.0 * dt),
        **scheme
    )
    return {
        "meta": meta,
        "exact": not poisson,
        "bound": (1.0 + courant) / 20,
        "mu": 0.0,
        "way": meta["dt"],
    }


def block(path, scheme, o):
    """A block that slides to rest; exact for a rigid one, up to mu = 1, where it may tip. On a
    wall up to mu = 1 (there FRIC 1 means no sliding), on a fixed body from there."""
    mu, courant = o.get("mu", 0.2), o.get("courant", 0.5)
    dt = courant * 0.25 / math.sqrt(1.0e5)
    base = 1 if mu >= 1.0 else 0
    tend = max(0.7, 30.0 * dt)
    meta = make_scenes.write(
        path, "sliding", mu=mu, courant=courant, tend=tend, base=base, **scheme
    )
    exact = SlidingBlock(meta["v"], mu, meta["g"], meta["mass"]) if 0.0 < mu < 1.0 else None
    bound = meta["v"] * (meta["bounce"] + dt)
    return {
        "meta": meta,
        "block": exact,
        "exact": False,
        "bound": bound,
        "mu": mu,
        "base": base,
        "way": meta["g"] * meta["tend"] * dt,
    }


def oblique(path, scheme, o):
    """The wide block that meets a held body obliquely; exact until the sides are heard of, which
    an implicit step beyond Courant number 1 brings about at once."""
    mu, courant = o.get("mu", 0.3), o.get("courant", 0.5)
    tend = 30.0 * courant * 2.0e-3 if courant > 1.0 else None
    meta = make_scenes.write(
        path, "oblique", n=6, wide=20, touch=0.25, mu=mu, courant=courant, tend=tend, **scheme
    )
    return {
        "meta": meta,
        "exact": False,
        "oblique": courant <= 1.0,
        "bound": (1.0 + courant) / 10,
        "mu": mu,
        "way": meta["dt"],
    }


def drift(path, scheme, o):
    """A body that glides along a plane at a gap of nothing: no force may appear."""
    meta = make_scenes.write(path, "drift", gap=o["gap"], v=1.0, **scheme)
    way = 100.0 * meta["dt"]
    return {"meta": meta, "exact": False, "bound": 0.0, "mu": 0.5, "way": way}


def bouncing(path, scheme, o):
    """The bouncing bar for 1e5 steps."""
    one = make_scenes.write(path, "bouncing", n=20, periods=1.0, courant=o["courant"], **scheme)
    meta = make_scenes.write(
        path,
        "bouncing",
        n=20,
        periods=1.0e5 * one["dt"] / one["tend"],
        courant=o["courant"],
        output=100.0 * one["dt"],
        **scheme
    )
    way = 2.0 * meta["exact"].gravity * meta["exact"].fall * meta["dt"]
    return {"meta": meta, "exact": False, "bound": 0.0, "mu": 0.0, "way": way}


def mortar(path, scheme, o):
    """The two bars, 3 elements against 5 across, paired by a mortar: its nodes have an allowance
    of 5e-3 of the shorter edge, 1/5, and get a row at 1.5 times that."""
    data = bars(path, dict(scheme, pairing="MORTAR", ny=3, ny2=5), o)
    return dict(data, sink=1.5 * 5.0e-3 / 5.0)


SCENES = {f.__name__: f for f in (bars, wall, block, oblique, drift, bouncing, mortar)}
