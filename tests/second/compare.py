#!/usr/bin/env python3
"""Runs scenes with bipact and with the second implementation and compares them.

compare.py [--rule old|new] [--self] [SCENE...]; the environment variable BIPACT names the program.
Displacements of all nodes, impulses of every card and energies must agree to 1e-8 of the largest
value until a twin of the second implementation, one offset changed by 1e-14, is 1e-10 away;
later the scene is chaotic. --self runs the second implementation alone and tells its figures."""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import scenes
import second_contact
from second_run import Failure, Run

TOLERANCE = 1e-8
NUDGE, APART = 1e-14, 1e-10
# What the old rule does at re-entrant corners, and where nodes pass corners that nobody watches,
# is not imitated; it has no card of all bodies, no SIDE BOTH and no FRAME REF.
OLD_RULE_DIFFERS = (23, 25, 41, *range(52, 65), *range(66, 70))


def table(path, first):
    """Returns the rows of a table by its columns, those named `first` leading."""
    with open(path, encoding="utf-8") as lines:
        head = [line for line in lines if line.startswith("#")]
    names = next(line for line in reversed(head) if " time " in line.replace("#", " ") + " ")
    names = names.strip("# \n").split()
    rows = np.loadtxt(path, ndmin=2)
    return rows[:, [names.index(name) for name in first]]


def run_bipact(program, deck, folder):
    """Returns displacements, impulses and energies by bipact, or the reason why not."""
    done = subprocess.run(
        [program, deck, "-o", folder, "--quiet"], capture_output=True, text=True, check=False
    )
    if done.returncode:
        return None, done.stderr.strip().splitlines()[0] if done.stderr.strip() else "failed"
    u = table(folder / "nodout.tab", ["time", "node", "ux", "uy"])
    steps = len(np.unique(u[:, 0]))
    u = u[:, 2:].reshape(steps, -1, 2)
    parts = []
    if (folder / "rcforc.tab").exists():
        rows = table(folder / "rcforc.tab", ["contact", "side", "ix", "iy"])
        rows = rows[rows[:, 1] == 1]
        parts.append(rows[:, 2:].reshape(steps, -1, 2))
    if (folder / "rwforc.tab").exists():
        parts.append(table(folder / "rwforc.tab", ["ix", "iy"]).reshape(steps, -1, 2))
    names = ["kinetic", "internal", "total", "external", "friction", "contact"]
    energy = table(folder / "glstat.tab", [*names, "unsolved", "algorithmic"])
    return (u, np.concatenate(parts, axis=1), energy), ""


def distance(one, two, scale):
    """Returns the largest difference at every step, over the scale."""
    n = min(len(one), len(two))
    return np.max(np.abs(one[:n] - two[:n]).reshape(n, -1), axis=1) / scale


def horizon(mine, twin):
    """Returns the number of steps until the twin is away."""
    away = np.nonzero(distance(mine.u, twin.u, np.max(np.abs(mine.u))) > APART)[0]
    return int(away[0]) if len(away) else len(mine.u)


def figures(mine):
    """Returns growth of energy, residual, overlap and counts as text."""
    e = mine.energy
    first = e[0, 2] if e[0, 2] > 0 else np.max(np.abs(e[:, :4]))
    growth = np.max(e[:, 2] - e[:, 3] - e[0, 2]) / first
    counts = " ".join(f"{name} {n}" for name, n in mine.counts.items() if n)
    if not np.any(mine.impulse):
        counts += " NO CONTACT"
    return (f"E-1 {growth:8.1e} overlap {np.max(mine.overlap):7.1e} "
            f"residual {np.max(np.abs(e[:, 8])):7.1e} {counts}")


def judge(number, rule, program, folder):
    """Returns (passed, chaotic, text) of a scene."""
    deck = Path(folder) / f"scene{number:02d}.k"
    scenes.make(number).write(deck)
    start = time.perf_counter()
    try:
        mine = Run(deck, rule=rule).run()
        twin = Run(deck, rule=rule, nudge=NUDGE).run()
    except Failure as problem:
        return False, False, str(problem)
    end = horizon(mine, twin)
    chaotic = end < len(mine.u)
    text = f"{time.perf_counter() - start:5.1f} s "
    if program:
        theirs, problem = run_bipact(program, deck, Path(folder) / f"scene{number:02d}")
        if theirs is None:
            return False, chaotic, problem
        if len(theirs[0]) != len(mine.u):
            return False, chaotic, f"{len(theirs[0])} rows, not {len(mine.u)}"
        worst = []
        if "SINGLE_SURFACE" in deck.read_text():
            theirs[1][:] = mine.impulse[:] = 0.0  # what its sides are is not defined
        for one, two in zip(theirs, (mine.u, mine.impulse, mine.energy[:, :8])):
            scale = np.max(np.abs(two)) or 1.0
            if one.shape != two.shape:
                return False, chaotic, f"{one.shape} numbers, not {two.shape}"
            worst.append(np.max(distance(one, two, scale)[:end]))
        passed = max(worst) <= TOLERANCE
        text += "u {:7.1e} impulse {:7.1e} energy {:7.1e} ".format(*worst)
        first = np.nonzero(distance(theirs[0], mine.u, np.max(np.abs(mine.u)))[:end] > TOLERANCE)[0]
        text += f"from step {first[0]} " if len(first) else ""
    else:
        passed = True
    text += f"chaotic after {end} of {len(mine.u) - 1} " if chaotic else ""
    return passed, chaotic, text + figures(mine)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rule", choices=("old", "new"), default="new")
    parser.add_argument("--beside", type=float, help="limit of rows beside a corner, such as 0.1")
    parser.add_argument("--self", action="store_true", help="without bipact")
    parser.add_argument("scenes", nargs="*", type=int)
    asked = parser.parse_args()
    if asked.beside is not None:
        second_contact.BESIDE = asked.beside
    program = None if asked.self else os.environ.get("BIPACT", "bin/bipact")
    counts = [0, 0, 0]
    with tempfile.TemporaryDirectory() as folder:
        for number in asked.scenes or range(1, scenes.COUNT + 1):
            if asked.rule == "old" and number in OLD_RULE_DIFFERS:
                print(f"skip {number:3d} {scenes.make(number).title}")
                continue
            passed, chaotic, text = judge(number, asked.rule, program, folder)
            counts[0 if passed else 1] += 1
            counts[2] += chaotic
            title = scenes.make(number).title
            print(f"{'ok  ' if passed else 'FAIL'} {number:3d} {title}: {text}", flush=True)
    print(f"{counts[2]} chaotic")
    print(f"{counts[0]} passed, {counts[1]} failed")
    return 1 if counts[1] else 0


if __name__ == "__main__":
    sys.exit(main())
