#!/usr/bin/env python3
"""What a feature costs when it is absent, present but idle, and active: instructions
(callgrind) and the median of processor seconds. The idle column must stay within 1 % of the
absent one.

Instructions are those of a run less those of the same run of one step, so that reading the
extra cards and setting up does not count: a step pays, or it does not. Needs valgrind; without
it only times are printed.
"""

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import make_bars

STEPS = 400
DT = 1.0e-5
# Bars that fly 0.004 each: in a gap of 5 nothing wakes, in one of 0.02 nodes are watched but do
# not meet, from 2e-6 they meet at once.
APART, NEAR, TOUCHING = 5.0, 0.02, 2.0e-6


def bars(**options):
    """Text of a two-bar deck, no tables."""
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "bars.k")
        make_bars.write(
            deck, **dict(dict(nx=100, dt=DT, tend=STEPS * DT, tables=["glstat=1.0"]), **options)
        )
        with open(common.without_tables(deck)) as file:
            return file.read()


def without(text, keyword):
    """The deck without the blocks of a keyword."""
    return re.sub(r"(?m)^\*%s[^\n]*\n(?:[^*\n][^\n]*\n|\n)*" % re.escape(keyword), "", text)


def plus(text, *cards):
    return text.replace("*END", "\n".join(cards) + "\n*END")


CURVE = ["*DEFINE_CURVE", "1,", "0.0,%s", "1.0,%s"]


def curve(value):
    return [x.replace("%s", value) for x in CURVE]


def scenes():
    """(feature, absent, idle, active): deck texts; None where there is no such state."""
    apart, touching = bars(gap=APART), bars(gap=TOUCHING)
    none = without(apart, "CONTACT_2D")
    friction = bars(gap=TOUCHING, mu=0.3, slide=0.1)
    free = bars(gap=TOUCHING, mu=0.0, slide=0.1)
    # Idle cards: a curve of zero, an interval longer than the run.
    yield "contact card", none, apart, touching
    yield "friction (mu = 0 / 0.3)", free, free, friction
    yield "gravity", none, plus(none, *curve("0.0")), plus(
        none, *curve("9.81"), "*LOAD_BODY_Y", "1,1.0"
    )
    yield "second contact card", touching, plus(
        touching, "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12", "1.0,2.0"
    ), None
    yield "rigid wall, far away", none, plus(
        none, "*RIGIDWALL_PLANAR", "0,", "99.0,,,98.0"
    ), None
    yield "supports", none, None, plus(none, "*BOUNDARY_SPC_NODE", "1,,,1")
    yield "prescribed motion", none, None, plus(
        none, *curve("1.0"), "*BOUNDARY_PRESCRIBED_MOTION_NODE", "1,1,0,1"
    )
    for name in ("GLSTAT", "MATSUM", "RCFORC", "SLEOUT", "NODOUT"):
        history = ["*DATABASE_HISTORY_NODE", "1,"] if name == "NODOUT" else []
        card = "*DATABASE_" + name
        yield "table %s" % name, touching, plus(touching, card, "0.0,", *history), plus(
            touching, card, "%r," % DT, *history
        )
    yield "ledger every step", touching, plus(touching, "*BIPACT_LEDGER", "0,"), plus(
        touching, "*BIPACT_LEDGER", "1,"
    )
    yield "field files", touching, plus(touching, "*BIPACT_FIELD", "99.0,"), plus(
        touching, "*BIPACT_FIELD", "%r," % DT
    )
    yield "restart files", touching, plus(touching, "*BIPACT_RESTART", "0,"), plus(
        touching, "*BIPACT_RESTART", "100,"
    )
    yield "bodies near, not touching", none, None, bars(gap=NEAR)


def instructions(program, text, steps, folder):
    """Instructions of a run of that many steps, by callgrind."""
    deck = os.path.join(folder, "one.k")
    with open(deck, "w") as file:
        file.write(set_end(text, steps))
    return instructions_of(program, deck, folder)


def instructions_of(program, deck, folder):
    """Instructions of a run of a deck."""
    out = os.path.join(folder, "callgrind")
    subprocess.run(
        [
            "valgrind",
            "--tool=callgrind",
            "--callgrind-out-file=" + out,
            program,
            deck,
            "-o",
            os.path.join(folder, "out"),
            "--quiet",
        ],
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    with open(out) as file:
        return int(re.search(r"(?m)^(?:summary|totals): (\d+)", file.read()).group(1))


def set_end(text, steps):
    """The deck with another end time."""
    return re.sub(
        r"Rtend\s+[0-9.eE+-]+(?=R)",
        lambda m: "Rtend".ljust(10) + ("%r" % (steps * DT)).rjust(10),
        text,
    )


def seconds(program, text, folder, runs):
    """Median processor seconds."""
    deck = os.path.join(folder, "timed.k")
    with open(deck, "w") as file:
        file.write(set_end(text, 10 * STEPS))
    found = [common.run(deck, os.path.join(folder, "out"), program) for _ in range(runs)]
    if found[0]["code"] != 0:
        raise SystemExit(found[0]["errors"])
    return statistics.median(f["cpu"] for f in found)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=5, help="timed runs of each (5)")
    parser.add_argument("--only", default="", help="features whose names contain this")
    a = parser.parse_args()
    counts = shutil.which("valgrind") is not None
    if not counts:
        print(
            "valgrind is not installed: times only (apt-get install valgrind for instruction counts)"
        )
    worst = 0.0
    print(
        "%-28s %12s %9s %9s   %8s %8s %8s"
        % ("instructions a step", "absent", "idle", "active", "absent s", "idle s", "active s")
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, *texts in scenes():
            if a.only not in name:
                continue
            # What bipact becomes there: callgrind does not follow it.
            program = common.PROGRAM + ("-hdf5" if " files" in name else "")
            row = []
            for text in texts:
                if text is None or not counts:
                    row.append(None)
                    continue
                long, short = (
                    instructions(program, text, s, folder) for s in (STEPS, STEPS // 4)
                )
                row.append((long - short) / (STEPS - STEPS // 4))
            times = [
                None if text is None else seconds(program, text, folder, a.runs)
                for text in texts
            ]
            base = row[0]
            cells = ["%12s" % ("-" if base is None else "%.0f" % base)]
            cells += [
                "%9s" % ("-" if r is None else "%+.2f %%" % (100.0 * (r / base - 1.0)))
                for r in row[1:]
            ]
            if row[1] is not None:
                worst = max(worst, abs(row[1] / base - 1.0))
            print(
                "%-28s %s   %s"
                % (
                    name,
                    " ".join(cells),
                    " ".join("%8s" % ("-" if t is None else "%.4f" % t) for t in times),
                )
            )
    if counts:
        print("largest difference of idle and absent: %.2f %% (target 1 %%)" % (100.0 * worst))
        return worst > 0.01
    return 0


if __name__ == "__main__":
    sys.exit(main())
