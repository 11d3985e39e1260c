"""The closing table of collide.py."""

import numpy as np

CLASSES = ("fine", "coarse", "beyond", "extreme", "moreau")
HEAD = "%-8s%6s%8s%8s%8s%8s%10s%10s%10s%10s%10s%10s%6s"
ROW = "%-8s%6d%8d%8d%8d%8d%10.1e%10.1e%10.1e%10.1e%10.1e%10.1e%6d"
NAMES = (
    "class",
    "runs",
    "touch",
    "warned",
    "stopped",
    "failed",
    "median",
    "99 %",
    "deepest",
    "silent",
    "energy",
    "momentum",
    "twins",
)
MOST_WARNED, MOST_MEDIAN, MOST_99 = 0.02, 1.0e-3, 3.0e-3
# Nodes of a mortar have an allowance of 5e-3 edge, and get a row at 1.5 times that.
MOST_99_MORTAR = 7.5e-3
# At finite deformation what a node has sunk in is not pushed out beyond what contact has taken,
# which would give energy: .3 % of the radius of two discs, 2.4e-2 of an edge.
MOST_99_SOFT, MOST_WARNED_SOFT = 3.0e-2, 0.1
ENOUGH = 50  # fine runs, below which shares say nothing


def largest(values):
    return max(values, default=0.0)


def summary(results):
    """Figures of a class."""
    told = [r for r in results if "overlap" in r]
    depths = [r["overlap"] for r in told] or [0.0]
    return {
        "runs": len(results),
        "touch": sum(r["touched"] for r in told),
        "warned": sum(not r["silent"] and r["code"] == 0 for r in told),
        "stopped": sum(r["code"] != 0 for r in results),
        "failed": sum(bool(r["faults"]) for r in results),
        "median": float(np.median(depths)),
        "99 %": float(np.quantile(depths, 0.99)),
        "deepest": largest(depths),
        "silent": largest(r["overlap"] for r in told if r["silent"]),
        "energy": largest(r["energy"] for r in told),
        "momentum": largest(r["momentum"] for r in told),
        "twins": sum(bool(r.get("names")) for r in told),
    }


def shares(fine, mortar, soft=False):
    """Rules on all fine runs: [(text, whether it holds)]; none for a few runs."""
    if fine["runs"] < ENOUGH:
        return []
    share = (fine["warned"] + fine["stopped"]) / fine["runs"]
    deep = MOST_99_SOFT if soft else MOST_99_MORTAR if mortar else MOST_99
    rules = (
        ("fine runs warned or stopped", share, MOST_WARNED_SOFT if soft else MOST_WARNED),
        ("fine runs, median overlap", fine["median"], MOST_MEDIAN),
        ("fine runs, overlap of 99 %", fine["99 %"], deep),
    )
    return [("%s: %.2g, at most %g" % rule, rule[1] <= rule[2]) for rule in rules]


def close(results, folder, mortar=False, soft=False):
    """Prints failures, the table and the last line; returns the exit code."""
    failed = [r for r in results if r["faults"]]
    for r in failed[:30]:
        words = (r["seed"], r["number"], r["class"], r["kind"], "; ".join(r["faults"]))
        print("FAIL seed %d run %d, %s, %s: %s" % words)
    if len(failed) > 30:
        print("... and %d more" % (len(failed) - 30))
    print(HEAD % NAMES)
    for name in CLASSES:
        found = summary([r for r in results if r["class"] == name])
        if found["runs"]:
            print(ROW % ((name,) + tuple(found[n] for n in NAMES[1:])))
    seconds = [r["seconds"] for r in results] or [0.0]
    program = [r["bipact"] for r in results] or [0.0]
    print("seconds a run: %.2f, bipact %.2f" % (np.mean(seconds), np.mean(program)))
    rules = shares(summary([r for r in results if r["class"] == "fine"]), mortar, soft)
    for text, holds in rules:
        print("%s %s" % ("ok  " if holds else "FAIL", text))
    wrong = len(failed) + sum(not holds for _, holds in rules)
    if failed:
        print("decks of the failed runs: " + folder)
    print("%d passed, %d failed" % (len(results) + len(rules) - wrong, wrong))
    return 1 if wrong else 0
