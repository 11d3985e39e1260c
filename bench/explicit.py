#!/usr/bin/env python3
"""What an explicit step costs beside an implicit one, without contact: instructions of a step
(callgrind; the run less one of half as many steps, so that set-up does not count) and processor
microseconds by phase, runs interleaved, medians. Instructions of the largest scene are left out:
its factor alone would take minutes there. Needs valgrind; without it only times are printed.

    explicit.py [RUNS [PYTHON]]

PYTHON: one that has akantu (pip install akantu): its explicit step of the same mesh, step length
and number of steps beside ours, in the same rounds, on one thread; left out where it has none."""

import os
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import features
import make_bars

# elements along and across each of the two bars, steps; unknowns = 4 (nx + 1) (ny + 1)
SIZES = [(100, 1, 4000), (100, 2, 4000), (262, 18, 400), (664, 75, 60)]
SCHEMES = [
    ("THETA consistent", dict(scheme="THETA")),
    ("THETA lumped", dict(scheme="THETA", mass="LUMPED")),
    ("PAOLI 1/4 lumped", dict(scheme="PAOLI", mass="LUMPED")),
    ("PAOLI 0 lumped", dict(scheme="PAOLI", mass="LUMPED", pbeta=0.0)),
    # grid lines shifted: no two elements are equal
    ("PAOLI 0 disturbed", dict(scheme="PAOLI", mass="LUMPED", pbeta=0.0, random=(0.2, 3))),
]
PHASES = ("matrix-vector products", "solves", "contact search", "update", "start and end")


def deck_of(folder, nx, ny, steps, options):
    """A deck without tables; bars far apart. Returns its path."""
    path = os.path.join(folder, "bars.k")
    scene = dict(nx=nx, ny=ny, courant=0.5, gap=5.0, **options)
    dt = make_bars.write(path, tend=None, **scene)["dt"]
    make_bars.write(path, tend=steps * dt, **scene)
    return common.without_tables(path)


def instructions(folder, nx, ny, options):
    """Of a step."""
    counts = []
    for steps in (200, 400):
        deck = deck_of(folder, nx, ny, steps, options)
        counts.append(features.instructions_of(common.PROGRAM, deck, folder))
    return (counts[1] - counts[0]) / 200.0


def phases(folder, nx, ny, steps, options):
    """Microseconds of a step by phase, and of the set-up in milliseconds."""
    out = os.path.join(folder, "out")
    done = common.run(deck_of(folder, nx, ny, steps, options), out)
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    log = common.read_log(out)
    found = [1.0e6 * log["phase " + name] / steps for name in PHASES]
    return found, [1.0e3 * log["phase " + p] for p in ("input", "assembly", "factorisation")]


def akantu_step(python, nx, ny, steps, folder):
    """Microseconds of a step of akantu; None where it is not installed."""
    scene = dict(nx=nx, ny=ny, courant=0.5, gap=5.0, **dict(SCHEMES)["PAOLI 0 lumped"])
    dt = make_bars.write(os.path.join(folder, "bars.k"), tend=None, **scene)["dt"]
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "akantu_bars.py")
    done = subprocess.run(
        [python, program, str(nx), str(ny), repr(dt), str(steps)],
        capture_output=True,
        text=True,
        env=dict(os.environ, OMP_NUM_THREADS="1"),
    )
    if done.returncode == 77:
        return None
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return float(done.stdout)


def main():
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    python = sys.argv[2] if len(sys.argv) > 2 else sys.executable
    print(
        "%7s %-17s" % ("dofs", "scheme")
        + " ".join("%10s" % p.split()[-1][:10] for p in PHASES)
        + " %10s %6s %12s %6s | %s"
        % ("us a step", "ratio", "instructions", "ratio", "ms: input, assembly, factor")
    )
    with tempfile.TemporaryDirectory() as folder:
        for nx, ny, steps in SIZES:
            times = {name: [] for name, _ in SCHEMES}
            peer = []
            for _ in range(runs):
                peer.append(akantu_step(python, nx, ny, steps, folder))
                for name, options in SCHEMES:
                    times[name].append(phases(folder, nx, ny, steps, options))
            base = None
            for name, options in SCHEMES:
                split = [statistics.median(x) for x in zip(*(t[0] for t in times[name]))]
                set_up = [statistics.median(x) for x in zip(*(t[1] for t in times[name]))]
                count = float("nan")
                if shutil.which("valgrind") and nx * ny < 300:
                    count = instructions(folder, nx, ny, options)
                base = base or (sum(split), count)
                print(
                    "%7d %-17s" % (4 * (nx + 1) * (ny + 1), name)
                    + " ".join("%10.2f" % x for x in split)
                    + " %10.2f %6.3f %12.0f %6.3f | "
                    % (sum(split), sum(split) / base[0], count, count / base[1])
                    + " ".join("%.1f" % x for x in set_up),
                    flush=True,
                )
            if None in peer:
                print("%7s akantu is not installed: left out" % "")
            else:
                used = statistics.median(peer)
                print(
                    "%7s %-17s %65.2f %6.3f"
                    % ("", "akantu explicit", used, used / base[0]),
                    flush=True,
                )


if __name__ == "__main__":
    main()
