#!/usr/bin/env python3
"""Contact of whole faces: two wide blocks ten elements deep, all face nodes closed and sliding
(mu 0.3, Courant 1/2). For each number of contacts: what the plan chooses, instructions of a step
(callgrind: a run of 15 steps less one of 5) closed and apart and their ratio, of the start,
memory; with --dense the same with WSTORE DENSE, with --before PROGRAM another build beside it.
Counts alone: processor times of a busy machine say little. Needs valgrind; --times instead
prints processor seconds of start and of 5 steps, for sizes that valgrind takes too long for."""

import argparse
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import features
import make_bars

H = 0.1  # edge of an element


def deck(path, contacts, steps, closed, storage=None):
    """The blocks with faces of so many nodes."""
    given = dict(nx=10, ny=contacts - 1, length=10 * H, height=(contacts - 1) * H)
    given.update(gap=1.0e-9 if closed else 5.0, courant=0.5, poisson=0.3, mu=0.3, slide=0.02)
    given.update(tables=["glstat=1"])
    meta = make_bars.write(path, **given)
    make_bars.write(path, **dict(given, tend=steps * meta["dt"]))
    if storage:
        with open(path) as file:
            text = file.read()
        with open(path, "w") as file:
            file.write(text.replace("*END", "*BIPACT_CONTACT\n\n%s\n*END" % storage))
    return path


def counted(program, folder, contacts, closed, storage=None):
    """Instructions of a step and of the start."""
    run = [
        features.instructions_of(
            program, deck(os.path.join(folder, "b.k"), contacts, steps, closed, storage), folder
        )
        for steps in (5, 15)
    ]
    step = (run[1] - run[0]) / 10
    return step, run[0] - 5 * step


def timed(program, folder, contacts, closed, storage=None):
    """Processor seconds of the start and of a step, from the phases of the log; kB; log."""
    out = os.path.join(folder, "out")
    done = common.run(
        deck(os.path.join(folder, "b.k"), contacts, 5, closed, storage), out, program
    )
    if done["code"] != 0:
        raise SystemExit(done["errors"])
    with open(os.path.join(out, "bipact.log")) as file:
        log = file.read()
    phase = dict(re.findall(r"(?m)^([a-z -]+?)  +([0-9.]+E[+-]\d+) +\d+$", log))
    steps = sum(float(phase[n]) for n in ("matrix-vector products", "solves", "contact"))
    memory = int(re.search(r"peak memory (\d+)", log)[1])
    return done["cpu"] - steps, steps / 5, memory, log


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("contacts", type=int, nargs="*", default=[101, 301, 1001])
    parser.add_argument("--dense", action="store_true", help="WSTORE DENSE beside it")
    parser.add_argument("--before", metavar="PROGRAM", help="another bipact beside it")
    parser.add_argument("--times", action="store_true", help="processor seconds, no valgrind")
    a = parser.parse_args()
    program = os.path.join(common.ROOT, "bin", "bipact")
    cases = [("", program, None)]
    if a.dense:
        cases.append(("DENSE", program, "DENSE"))
    if a.before:
        cases.append(("before", a.before, None))
    unit = "s" if a.times else "M instructions"
    print("contacts  case     step apart  step closed  ratio  start closed  kB  (%s)" % unit)
    with tempfile.TemporaryDirectory() as folder:
        for n in a.contacts:
            for name, path, storage in cases:
                start, step, memory, log = timed(path, folder, n, True, storage)
                if a.times:
                    apart = timed(path, folder, n, False)[1]
                    form = "%8d  %-7s %11.4f %12.4f %6.1f %13.2f %7d"
                else:
                    step, start = (x / 1e6 for x in counted(path, folder, n, True, storage))
                    apart = counted(path, folder, n, False)[0] / 1e6
                    form = "%8d  %-7s %11.2f %12.2f %6.2f %13.1f %7d"
                print(form % (n, name, apart, step, step / apart, start, memory), flush=True)
                choice = re.search(r"contact W +\w+ +(.*)", log)
                if choice and not storage:
                    print("          %s" % choice[1])


if __name__ == "__main__":
    main()
