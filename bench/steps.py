#!/usr/bin/env python3
"""The cost of a step from 404 to 2e5 unknowns: microseconds by phase (bipact.log), tables on
and off; solves against the time to read the factor once forward and once backward, interleaved
in one process (bench/step_cost.f90); exponents of the growth."""

import argparse
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import make_bars

# elements along and across each of the two bars, steps; unknowns = 4 (nx + 1) (ny + 1)
SIZES = [(50, 1, 4000), (100, 1, 4000), (166, 2, 2000), (262, 18, 400), (664, 75, 60)]
PHASES = (
    "matrix-vector products",
    "solves",
    "contact search",
    "contact",
    "update",
    "energies and ledger",
    "tables",
)


def phases(deck, folder, steps):
    """{phase: microseconds a step} of a run."""
    done = common.run(deck, folder)
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    log = common.read_log(folder)
    return {name: 1.0e6 * log["phase " + name] / steps for name in PHASES}, done


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--most", type=float, default=1.0e6, help="leave larger scenes out")
    parser.add_argument("--figure", help="draw the growth into this file")
    a = parser.parse_args()
    program = os.path.join(common.ROOT, "build", "release", "bench", "step_cost")
    print("microseconds a step, bars in contact, tables off | on (a row every 10 steps)")
    print(
        "%8s " % "dofs"
        + " ".join(
            "%12s" % n.replace("matrix-vector ", "").replace("contact search", "search")[:12]
            for n in PHASES
        )
        + " %10s | %10s" % ("sum", "sum on")
    )
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for nx, ny, steps in SIZES:
            dofs = 4 * (nx + 1) * (ny + 1)
            if dofs > a.most:
                continue
            deck, out = os.path.join(folder, "bars.k"), os.path.join(folder, "out")
            meta = make_bars.write(deck, nx=nx, ny=ny, courant=0.1, gap=1.0e-9, tend=None)
            meta = make_bars.write(
                deck,
                nx=nx,
                ny=ny,
                courant=0.1,
                gap=1.0e-9,
                tend=steps * meta["dt"],
                output=10 * meta["dt"],
                tables=["glstat", "matsum", "nodout", "rcforc", "sleout"],
            )
            silent = common.without_tables(deck)
            off, _ = phases(silent, out, steps)
            on, _ = phases(deck, out, steps)
            print(
                "%8d " % dofs
                + " ".join("%12.2f" % off[n] for n in PHASES)
                + " %10.2f | %10.2f" % (sum(off.values()), sum(on.values())),
                flush=True,
            )
            line = subprocess.run(
                [program, silent], stdout=subprocess.PIPE, text=True, check=True
            ).stdout
            rows.append([float(x) for x in line.split()[:6]])
    print("\nin one process, interleaved, medians in microseconds")
    print(
        "%8s %12s %10s %10s %10s %10s %14s %22s"
        % (
            "dofs",
            "factor bytes",
            "step",
            "passes",
            "read 2x",
            "products",
            "passes / read",
            "step / (read+products)",
        )
    )
    for dofs, size, step, passes, read, products in rows:
        print(
            "%8d %12d %10.2f %10.2f %10.2f %10.2f %14.2f %22.2f"
            % (
                dofs,
                size,
                step,
                passes,
                read,
                products,
                passes / read,
                step / (read + products),
            )
        )
    print(
        "growth: step ~ dofs^p between neighbouring sizes: "
        + ", ".join(
            "%.2f" % (math.log(b[2] / c[2]) / math.log(b[0] / c[0]))
            for b, c in zip(rows[1:], rows)
        )
    )

    many_contacts()
    if a.figure:
        draw(rows, a.figure)


def many_contacts():
    """Share of the contact solve in a step with 201 closed contacts, and what the start from the
    last reactions saves."""
    print("\n201 closed contacts: share of the contact solve in the steps, sweeps a solve")
    for mu in (0.0, 0.3):
        for warm in (1, 0):
            with tempfile.TemporaryDirectory() as folder:
                deck = os.path.join(folder, "wide.k")
                make_bars.write(
                    deck,
                    nx=20,
                    ny=200,
                    height=10.0,
                    gap=1.0e-9,
                    courant=0.5,
                    poisson=0.3,
                    mu=mu,
                    slide=0.02,
                    tend=0.02,
                    tables=["glstat=1"],
                )
                with open(deck) as file:
                    text = file.read()
                with open(deck, "w") as file:
                    file.write(text.replace("*END", "*BIPACT_CONTACT\n,,,,,,,%d\n*END" % warm))
                done = common.run(deck, folder)
                if done["code"] != 0:
                    raise SystemExit(done["errors"])
                log = common.read_log(folder)
            whole = sum(log["phase " + name] for name in PHASES)
            print(
                "mu %.1f, start %s: %4.1f %%, %.1f sweeps"
                % (
                    mu,
                    "warm" if warm else "zero",
                    100.0 * log["phase contact"] / whole,
                    log["sweeps"] / log["contact_solves"],
                )
            )


def draw(rows, path):
    """Cost of a step and its parts over the number of unknowns."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = ("whole step", "forward and backward pass", "reading the factor twice", "products")
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for k, name in enumerate(names, 2):
        axes.loglog([r[0] for r in rows], [r[k] for r in rows], "os^v"[k - 2] + "-", label=name)
    axes.set_xlabel("unknowns")
    axes.set_ylabel("microseconds a step")
    axes.grid(True, alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    main()
