#!/usr/bin/env python3
"""The two-bar impact, 100 elements a bar: error, energy, processor time, memory, split of a
step.

Processor time is user + system of the whole process, the median of several runs (machines are
noisy: the smallest and largest are printed too); memory is the peak of the process. Phases are
those of bipact.log, in microseconds a step.
"""

import argparse
import os
import statistics
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import compare
import make_bars

TOUCHES = (0.0, 0.25, 0.5, 0.75)
ROWS = [
    ("THETA consistent", dict(), (0.0,)),
    ("THETA dispersion, Courant 1", dict(mass="DISPERSION", courant=1.0), (0.0,)),
    ("THETA dispersion, Courant 1/2", dict(mass="DISPERSION", dt=5.0e-5), (0.0,)),
    (
        "THETA dispersion, massless, 1e-5",
        dict(mass="DISPERSION", redist=1),
        TOUCHES,
    ),
    (
        "THETA dispersion, massless, 5e-5",
        dict(mass="DISPERSION", redist=1, dt=5.0e-5),
        TOUCHES,
    ),
    (
        "the same, a row every step",
        dict(mass="DISPERSION", redist=1, dt=5.0e-5, output="step"),
        TOUCHES,
    ),
    ("NEWMARK consistent", dict(scheme="NEWMARK"), (0.0,)),
]
# The other schemes at Courant number 1/2, mean over touches within a step.
ROWS += [
    ("%s %s, 5e-5" % (name, mass.lower()), dict(setting, mass=mass, dt=5.0e-5), TOUCHES)
    for name, mass, setting in (
        ("HHT -0.3", "CONSISTENT", dict(scheme="HHT", alpha=-0.3)),
        ("GENALPHA 0.8", "CONSISTENT", dict(scheme="GENALPHA", rho=0.8)),
        ("MOREAU", "CONSISTENT", dict(scheme="MOREAU")),
        ("PAOLI", "DISPERSION", dict(scheme="PAOLI")),
        ("CDLAGRANGE", "LUMPED", dict(scheme="CDLAGRANGE")),
        ("THETAPV", "CONSISTENT", dict(scheme="THETAPV")),
        ("NSGENALPHA 0.8", "CONSISTENT", dict(scheme="NSGENALPHA", setting={"rhoinf": 0.8})),
        ("CSNEWMARK", "CONSISTENT", dict(scheme="CSNEWMARK")),
    )
]


def run(deck, folder):
    """One run as a child process: its processor seconds."""
    child = os.fork()
    if child == 0:
        os.execv(os.path.join(ROOT, "bin", "bipact"), ["bipact", deck, "-o", folder, "--quiet"])
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        raise SystemExit("the run of %s failed" % deck)
    return usage.ru_utime + usage.ru_stime


def peak_mebibytes(folder):
    """Peak resident memory, which the program writes to its log."""
    for line in open(os.path.join(folder, "bipact.log")):
        if line.startswith("peak memory"):
            return int(line.split()[2]) / 1024.0
    return float("nan")


def phases(folder, steps):
    """{phase: microseconds a step} from bipact.log."""
    found, on = {}, False
    for line in open(os.path.join(folder, "bipact.log")):
        if on:
            found[line[:30].strip()] = 1.0e6 * float(line[30:42]) / steps
        on = on or line.startswith("phase ")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=7, help="runs of each row (7)")
    a = parser.parse_args()
    print(
        "%-34s %9s %10s %9s  %-22s %s"
        % ("run", "err", "E_end/E0-1", "osc", "CPU s (min..max)", "MiB")
    )
    with tempfile.TemporaryDirectory() as scratch:
        for name, scene, touches in ROWS:
            found = []
            for touch in touches:
                deck, folder = os.path.join(scratch, "bars.k"), os.path.join(scratch, "out")
                meta = make_bars.write(deck, touch=touch, **scene)
                times = sorted(run(deck, folder) for _ in range(a.runs))
                found.append((compare.measure(folder, meta), times))
            err = statistics.mean(f["err"] for f, _ in found)
            energy = min(f["dE_end"] for f, _ in found)
            times = found[-1][1]
            print(
                "%-34s %9.2e %10.1e %9.1e  %.3f (%.3f..%.3f)   %.1f"
                % (
                    name,
                    err,
                    energy,
                    found[0][0]["osc"],
                    statistics.median(times),
                    times[0],
                    times[-1],
                    peak_mebibytes(folder),
                )
            )
            if name.startswith(("THETA consistent", "NEWMARK")):
                split = phases(folder, meta["steps"])
                print("    us a step: " + ", ".join("%s %.2f" % x for x in split.items()))


if __name__ == "__main__":
    main()
