"""Every time scheme with every mass that the program takes with it, for the studies."""

import json
import os
import tempfile

import common
import make_bars

# Name: (scheme, fields of its two cards).
METHODS = {
    "THETA": ("THETA", {"theta": 0.5}),
    "THETA 0.55": ("THETA", {"theta": 0.55}),
    "THETA 1": ("THETA", {"theta": 1.0}),
    "NEWMARK": ("NEWMARK", {"gamma": 0.5, "beta": 0.25}),
    "NEWMARK 0.6": ("NEWMARK", {"gamma": 0.6, "beta": 0.3026}),
    "HHT -0.1": ("HHT", {"alpha": -0.1}),
    "HHT -0.3": ("HHT", {"alpha": -0.3}),
    "GENALPHA 0.5": ("GENALPHA", {"rhoinf": 0.5}),
    "GENALPHA 0.8": ("GENALPHA", {"rhoinf": 0.8}),
    "MOREAU": ("MOREAU", {"theta": 0.5}),
    "PAOLI": ("PAOLI", {}),
    "PAOLI 0": ("PAOLI", {"pbeta": 0.0}),
    "CDLAGRANGE": ("CDLAGRANGE", {}),
    "THETAPV": ("THETAPV", {}),
    "NSGENALPHA 0.8": ("NSGENALPHA", {"rhoinf": 0.8}),
    "CSNEWMARK": ("CSNEWMARK", {}),
}
EXPLICIT = ("PAOLI 0", "CDLAGRANGE")
MASSES = [(m, r) for m in ("CONSISTENT", "LUMPED", "DISPERSION") for r in (0, 1)]
# Variants with much numerical damping, or that differ little from a neighbour: one mass is enough.
ONE_MASS = ("THETA 0.55", "NEWMARK 0.6", "HHT -0.1", "GENALPHA 0.5")


def options(run):
    """Keyword arguments of make_scenes.write for the scheme and mass of a run."""
    scheme, setting = METHODS[run["method"]]
    return dict(setting, scheme=scheme, mass=run["mass"], redist=run["redist"])


def bar_options(run):
    """The same for make_bars.write."""
    scheme, setting = METHODS[run["method"]]
    found = {"scheme": scheme, "mass": run["mass"], "redist": run["redist"]}
    if "theta" in setting:
        found["theta"] = setting["theta"]
    return dict(found, setting=setting)


def all_pairs(one_mass=()):
    """[(method, mass, redist)]: every mass with every method, but for those of one mass."""
    for method in METHODS:
        for mass, redist in MASSES[:1] if method in one_mass else MASSES:
            yield method, mass, redist


def ask_program(pair):
    """'' if the program takes a combination, else its words."""
    run = dict(zip(("method", "mass", "redist"), pair))
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "ask.k")
        # Courant 1/2 and elements not longer than high: no explicit scheme has a limit below it.
        make_bars.write(deck, nx=40, courant=0.5, tables=["glstat"], **bar_options(run))
        done = common.run(deck, os.path.join(folder, "out"), limit=60)
        said = done["errors"].replace(folder + "/", "").splitlines() or ["no word"]
        if done["code"] != 2:
            return ""
        return next((x for x in said if "ask.k" in x), said[0]).partition(": ")[2] or said[0]


def taken(store, one_mass=()):
    """([combinations that the program takes], {the others: why not}); asked anew if it has changed."""
    path = os.path.join(store, "combinations.json")
    pairs, known = list(all_pairs(one_mass)), {}
    if os.path.exists(path) and os.path.getmtime(path) > os.path.getmtime(common.PROGRAM):
        with open(path) as file:
            known = json.load(file)
    answers = {p: known.get("|".join(map(str, p))) for p in pairs}
    answers = {p: ask_program(p) if a is None else a for p, a in answers.items()}
    with open(path, "w") as file:
        json.dump(dict(known, **{"|".join(map(str, p)): a for p, a in answers.items()}), file)
    return [p for p in pairs if not answers[p]], {p: a for p, a in answers.items() if a}


def refusal_table(refused):
    """Lines of a table of combinations that the program does not take."""
    groups = {}
    for pair, why in refused.items():
        groups.setdefault(why.replace("|", "/"), []).append(common.label(pair))
    lines = ["| combination | words |", "|---|---|"]
    return lines + ["| %s | %s |" % (", ".join(who), why) for why, who in groups.items()]
