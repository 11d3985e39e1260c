"""What the deck tests share: run a deck, read its tables, count the checks."""

import os
import re
import subprocess
import sys

ROOT, BIPACT, TMP = (os.environ[name] for name in ("ROOT", "BIPACT", "TMP"))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import compare
import make_bars
import tables

passed = failed = 0


def check(ok, text):
    """Counts a check; a failed one says what it was."""
    global passed, failed
    passed, failed = passed + bool(ok), failed + (not ok)
    if not ok:
        print("FAIL", text)


def at_most(value, bound, text):
    """Checks value <= bound; not a number fails."""
    check(value <= bound, "%s is %.3e, more than %.3e" % (text, value, bound))
    show("%-60s %10.3e  <= %.3e" % (text, value, bound))


def within(value, low, high, text):
    """Checks low <= value <= high."""
    check(low <= value <= high, "%s is %.6e, not in %g .. %g" % (text, value, low, high))
    show("%-60s %10.3e  in %g .. %g" % (text, value, low, high))


def show(text):
    """Prints a measured figure when SHOW is set."""
    if os.environ.get("SHOW"):
        print(text)


def bipact(deck, folder, *options):
    """Runs a deck; returns (exit code, standard error, standard output)."""
    done = subprocess.run(
        [BIPACT, deck, "-o", folder] + list(options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    return done.returncode, done.stderr, done.stdout


def words_of(field):
    """The words that a field of a deck takes, as the program lists them."""
    listed = subprocess.run([BIPACT, "--keywords"], capture_output=True, text=True).stdout
    row = next(x for x in listed.splitlines() if x.startswith("| %s |" % field))
    return row.split(" | ")[5].split(", ")


def every_keyword(scheme):
    """input/cards/every_keyword.k with what a scheme needs or refuses, and its option."""
    with open(os.path.join(ROOT, "input", "cards", "every_keyword.k")) as file:
        text = file.read()
    if scheme == "HHT":    # ALPHA is a field of another card
        lines = text.split("\n")
        lines[lines.index("*CONTROL_IMPLICIT_DYNAMICS") + 2] = "1,,,,,,,-0.3"
        text = "\n".join(lines)
    if scheme == "CDLAGRANGE":    # explicit: its engine is no choice
        text = text.replace("      LDLT      AUTO", "      AUTO      AUTO")
    if scheme == "NSGENALPHA":
        text = re.sub(r"(?m)^\*DAMPING_.*\n(?:[^*].*\n)*", "", text)
    return text, ["-D", "scheme=" + scheme]


def run_text(name, text, *options):
    """Writes a deck from its text and runs it; returns (folder, exit code, standard error)."""
    deck, folder = os.path.join(TMP, name + ".k"), os.path.join(TMP, name)
    with open(deck, "w", newline="", encoding="utf-8") as out:
        out.write(text)
    code, errors, _ = bipact(deck, folder, *options)
    return folder, code, errors


def bars(name, *options, **scene):
    """Runs a two-bar scene of make_bars.py; returns (measures of compare.py, folder)."""
    deck, folder = os.path.join(TMP, name + ".k"), os.path.join(TMP, name)
    meta = make_bars.write(deck, **scene)
    code, errors, _ = bipact(deck, folder, "--quiet", *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return compare.measure(folder, meta), folder


def table(folder, name, **ids):
    """A table of a run, or the rows of one id."""
    whole = tables.read_run(folder, name)
    return whole.select(**ids) if ids else whole


def finish():
    """Prints the counts and ends the program."""
    print("%d passed, %d failed" % (passed, failed))
    sys.exit(failed > 0 or passed == 0)


def two_blocks(
    young=1.0e4,
    density=1.0,
    nx=(4, 4),
    ny=(2, 2),
    size=(1.0, 1.0),
    gap=0.0,
    base=(8.0, 1.0),
    plane=13,
    poisson=0.3,
):
    """Nodes and elements of a block (part 2) on a base (part 1) whose top is y = 0."""
    lines, elements, node, element = ["*NODE"], [], 0, 0
    sets = {}
    for part, (x0, y0, lx, ly, mx, my) in enumerate(
        (
            (-1.0, -base[1], base[0], base[1], nx[0], ny[0]),
            (0.0, gap, size[0], size[1], nx[1], ny[1]),
        ),
        start=1,
    ):
        first = node + 1
        for i in range(mx + 1):
            for j in range(my + 1):
                node += 1
                lines.append("%d,%r,%r" % (node, x0 + lx * i / mx, y0 + ly * j / my))
        for i in range(mx):
            for j in range(my):
                element += 1
                a = first + i * (my + 1) + j
                elements.append(
                    "%d,%d,%d,%d,%d,%d" % (element, part, a, a + my + 1, a + my + 2, a + 1)
                )
        sets[part] = range(first, node + 1)
    lines += ["*ELEMENT_SHELL"] + elements
    lines += [
        "*PART",
        "base",
        "1,1,1",
        "block",
        "2,1,1",
        "*SECTION_SHELL",
        "1,%d" % plane,
        "1.0",
        "*MAT_ELASTIC",
        "1,%r,%r,%r" % (density, young, poisson),
    ]
    lines += ["*SET_PART_LIST", "11,", "1,", "*SET_PART_LIST", "12,", "2,"]
    for part in (1, 2):
        lines += ["*SET_NODE_LIST", "%d," % part]
        nodes = list(sets[part])
        lines += [",".join(map(str, nodes[k : k + 8])) + "," for k in range(0, len(nodes), 8)]
    return lines, sets


def deck(
    lines,
    dt,
    tend,
    scheme="THETA,0.5,0.5",
    mass="CONSISTENT,0",
    mu=None,
    every=None,
    history=(),
    extra=(),
):
    """A whole deck around mesh lines."""
    out = [
        "*KEYWORD",
        "*TITLE",
        "test scene",
        "*CONTROL_TERMINATION",
        "%r," % tend,
        "*CONTROL_IMPLICIT_GENERAL",
        "1,%r" % dt,
        "*CONTROL_IMPLICIT_DYNAMICS",
        "1,",
        "*BIPACT_TIME",
        scheme + ",",
        "*BIPACT_MASS",
        mass + ",",
    ]
    out += list(lines) + list(extra)
    if mu is not None:
        out += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "11,12,,,%r" % mu]
    names = ["GLSTAT", "MATSUM"] + (["RCFORC", "SLEOUT"] if mu is not None else [])
    for name in names + (["NODOUT"] if history else []):
        out += ["*DATABASE_" + name, "%r," % (every or dt)]
    if history:
        out += ["*DATABASE_HISTORY_NODE", ",".join(map(str, history)) + ","]
    return "\n".join(out + ["*END", ""])
