"""PyDyna reads every deck of input/ and its echo deck, and finds equal values in both: numbers
that stand in the deck are those that bipact understood. Only own keywords (and two short names
of sets, which PyDyna keeps as text) may stay unread. Every name of a keyword that PyDyna knows
is used, skipped or refused by bipact: "unknown keyword" means a slip of the pen."""

import glob
import logging
import math
import os
import subprocess
import sys
import warnings

warnings.simplefilter("ignore")
logging.disable(logging.CRITICAL)
from ansys.dyna.core import Deck
from ansys.dyna.core.keywords.keyword_classes.type_mapping import TypeMapping

ROOT, BIPACT, TMP = (os.environ[name] for name in ("ROOT", "BIPACT", "TMP"))
UNREAD = ("*BIPACT_", "*SET_PART\n", "*SET_SHELL\n")
SKIPPED = {"Parameter", "Keyword"}
# Spellings of that package which are no keywords of the format.
NO_KEYWORDS = {
    "CONTROL_IMPLICIT_DYNAMIC",
    "CONTROL_TIME_STEP",
    "KEYWORD_KEYWORD_ID",
    "KEYWORD_KEYWORD_JOBID",
    "NODE_NODES",
}
passed = failed = 0


def check(ok, text):
    global passed, failed
    passed, failed = passed + bool(ok), failed + (not ok)
    if not ok:
        print("FAIL", text)


def read(path):
    """Keywords of a deck with its includes, those of the frame left out."""
    deck = Deck()
    with open(path) as file:
        deck.loads(file.read())
    deck = deck.expand(cwd=os.path.dirname(path))
    for text in deck.string_keywords:
        check(
            text.startswith(UNREAD), "%s: PyDyna leaves %s unread" % (path, text.split("\n")[0])
        )
    return [k for k in deck.keywords if type(k).__name__ not in SKIPPED]


def missing(value):
    return value is None or str(value) in ("<NA>", "nan", "")


def values(keyword):
    """{field: value} of the cards, tables (sets, nodes, curves) row by row."""
    found = {}
    for name in dir(type(keyword)):
        if name.startswith("_") or not isinstance(getattr(type(keyword), name, None), property):
            continue
        value = getattr(keyword, name)
        if isinstance(value, (int, float, str)):
            found[name] = value
        elif hasattr(value, "columns"):
            for column in value.columns:
                for row, x in enumerate(value[column]):
                    found["%s.%s.%d" % (name, column, row)] = x
        elif isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
            for row, x in enumerate(value):
                if isinstance(x, (int, float)):
                    found["%s.%d" % (name, row)] = x
    return {
        n: v for n, v in found.items() if n not in ("user_comment", "format", "included_from")
    }


def equal(a, b):
    """A blank field is 0 to PyDyna where the whole card is blank, and nothing where it is
    not."""
    if a == 0 and missing(b):
        return True
    if isinstance(a, (int, float)) and isinstance(b, (int, float)):
        return a == b or math.isclose(a, b, rel_tol=0.0)
    return str(a).strip() == str(b).strip()


def names_known():
    """Looks up all names, ten a deck."""
    names = sorted({n.lstrip("*") for n in TypeMapping} - NO_KEYWORDS - {"END"})
    with open(os.path.join(ROOT, "tests", "bad_decks", "base.k")) as file:
        base = file.read()
    path = os.path.join(TMP, "names.k")
    for first in range(0, len(names), 10):
        part = names[first : first + 10]
        with open(path, "w") as out:
            out.write(base.replace("*END", "\n".join("*" + n for n in part) + "\n*END"))
        done = subprocess.run([BIPACT, path, "--check"], stderr=subprocess.PIPE, text=True)
        for name in part:
            unknown = "unknown keyword *%s\n" % name in done.stderr
            check(not unknown, "*%s is called unknown" % name)
    check(len(names) > 3000, "only %d names" % len(names))


def main():
    compared = 0
    names_known()
    for path in sorted(glob.glob(os.path.join(ROOT, "input", "*", "*.k"))):
        name = os.path.relpath(path, ROOT)
        if "*CONTROL_TERMINATION" not in open(path).read():
            continue  # a mesh that others include
        out = os.path.join(TMP, name.replace("/", "_"))
        done = subprocess.run(
            [BIPACT, path, "-o", out, "--quiet"], stderr=subprocess.PIPE, text=True
        )
        check(done.returncode == 0, name + ": " + done.stderr)
        ours, echo = read(path), read(os.path.join(out, "deck.echo.k"))
        check(
            [type(k).__name__ for k in ours] == [type(k).__name__ for k in echo],
            name + ": the same keywords in the same order",
        )
        for a, b in zip(ours, echo):
            left, right = values(a), values(b)
            for field, value in left.items():
                if missing(value) or field in ("soa", "sob") or (field == "nz" and value == 0):
                    continue  # its own defaults of blank fields: tuning; the axis z, 0 means 1
                compared += 1
                check(
                    equal(value, right.get(field)),
                    "%s: %s.%s is %s in the deck, %s in the echo"
                    % (name, type(a).__name__, field, value, right.get(field)),
                )
    check(compared > 3000, "only %d values were compared" % compared)
    print("%d passed, %d failed" % (passed, failed))
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
