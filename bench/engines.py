#!/usr/bin/env python3
"""The linear solver that AUTO takes beside each of the others, over decks of 1e2 to 3e5 dofs.
`engines.py [--rounds R] [WORD ...]` runs those whose name has a word, all engines in turn, R times
(2): processor seconds without reading and assembly (least of the rounds) of AUTO, LDLT,
SUPERNODAL and, where the matrix changes in each step, CG; and AUTO's over the least of them."""

import argparse
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import forecast

ENGINES = ("AUTO", "LDLT", "SUPERNODAL", "CG")
#: Not in the comparison: many solves of a matrix that factors in no time, one thing twice, or
#: explicit.
LEFT_OUT = ("bars 100 x 1 NEWMARK", "bars 1000 x 250", "bars 400 x 60 explicit")


def with_engine(text, engine):
    return text.replace("*END", "*BIPACT_SOLVER\n%s,\n*END" % engine)


def seconds(text, folder):
    """Processor seconds after assembly, or None where the engine does not take the scene; what
    bipact.log calls the engine."""
    path = os.path.join(folder, "engine.k")
    out = os.path.join(folder, "out")
    with open(path, "w") as file:
        file.write(text)
    done = common.run(path, out)
    if done["code"] != 0:
        return None, ""
    log = common.read_log(out)
    phases = {k[6:]: v for k, v in log.items() if k.startswith("phase ")}
    with open(os.path.join(out, "bipact.log")) as file:
        engine = [line.split()[1].rstrip(",") for line in file if line.startswith("solver ")]
    before = phases["input"] + phases["assembly"]
    return done["cpu"] * (1.0 - before / sum(phases.values())), engine[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("words", nargs="*")
    parser.add_argument("--rounds", type=int, default=2)
    args = parser.parse_args()
    print("scene                  AUTO takes " + "".join("%12s" % e for e in ENGINES) + "  AUTO/least")
    with tempfile.TemporaryDirectory() as folder:
        for name, make in forecast.DECKS.items():
            if name in LEFT_OUT or args.words and not any(w in name for w in args.words):
                continue
            text = make()
            engines = ENGINES if name.startswith(("disc", "foam")) else ENGINES[:3]
            least, taken = {}, ""
            for _ in range(args.rounds):
                for engine in engines:
                    cpu, used = seconds(with_engine(text, engine), folder)
                    taken = used if engine == "AUTO" else taken
                    if cpu is not None:
                        least[engine] = min(cpu, least.get(engine, cpu))
            best = min(least[e] for e in least if e != "AUTO")
            row = "".join("%12.3f" % least[e] if e in least else "%12s" % "-" for e in ENGINES)
            print("%-22s %-11s%s  %6.2f" % (name, taken, row, least["AUTO"] / best), flush=True)


if __name__ == "__main__":
    main()
