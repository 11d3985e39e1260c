#!/usr/bin/env python3
"""Runs scenes with the contact rows of version 0.1.0 and with those of today, side by side.

crowds.py [N [SEED]]: N random crowds of soft bodies that spin and meet at large steps (15), then
the reference scenes of edges, corners, notches and stacks. By the second implementation alone,
so that rows, normals and closing are the only difference. E: largest total less external work,
over the initial energy (over the largest total where that is zero); overlap: deepest true
overlap over the shorter edge."""

import random
import sys
import tempfile
from pathlib import Path

import numpy as np
import scenes
from second_deck import DeckError
from second_run import Failure, Run

SCENES = (4, 12, 16, 20, 23, 25, 31, 39, 43, 72)
ROW = "%-34s %9s %9s %9s %9s"


def figures(deck, rule):
    """Returns (E, deepest overlap) as far as the run came, and whether it came to its end."""
    made = Run(deck, rule=rule)
    ended = True
    with np.errstate(all="ignore"):
        for number in range(1, made.steps + 1):
            try:
                made.step(number)
            except Exception:  # a solver that gives up, numbers that are none any more
                ended = False
                break
            if not np.all(np.abs(made.u) < 1e6):
                ended = False
                break
    energy = np.array(made.result.energy)
    total = energy[:, 2] - energy[:, 3]
    return np.max(total) / (made.initial or np.max(energy[:, 2])), max(made.result.overlap), ended


def compare(name, scene):
    """Prints a line; returns the four figures."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "deck.k"
        scene.write(deck)
        found, texts = [], []
        for rule in ("old", "new"):
            try:
                energy, overlap, ended = figures(deck, rule)
            except (DeckError, Failure):
                found += [np.nan, np.nan]
                texts += ["-", "-"]
                continue
            found += [energy, overlap]
            mark = "" if ended else "!"
            texts += [f"{energy:.7g}"[:9] + mark, f"{overlap:.1e}" + mark]
    print(ROW % (name[:34], *texts), flush=True)
    return found


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    print(ROW % ("scene", "old: E", "overlap", "new: E", "overlap"))
    found = []
    for k in range(1, count + 1):
        made = scenes.crowd(k, random.Random(f"{seed} {k}"))
        found.append(compare(f"crowd {k}", made))
    if found:
        worst = np.nanmax(np.array(found), axis=0)
        median = np.nanmedian(np.array(found), axis=0)
        for name, row in (("crowds, largest", worst), ("crowds, median", median)):
            print(ROW % (name, f"{row[0]:.7g}"[:9], f"{row[1]:.1e}", f"{row[2]:.7g}"[:9],
                         f"{row[3]:.1e}"))
    for number in SCENES:
        made = scenes.make(number)
        compare(f"{number} {made.title}", made)
    return 0


if __name__ == "__main__":
    sys.exit(main())
