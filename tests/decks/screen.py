"""Warnings are seen: on the screen in the step in which they come, in the log, in the summary."""

import os
import pty
import re
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from contact_geometry import from_behind, log_of
from scenes import BIPACT, ROOT, TMP, bipact, check, deck, finish, make_bars, run_text, two_blocks

import make_scenes

NEWMARK = os.path.join(ROOT, "input", "lessons", "newmark_gains_energy.k")
GAMMA_CARD = re.compile(r"(\*CONTROL_IMPLICIT_DYNAMICS\n(?:\$.*\n)*).*\n")
TIME_CARD = re.compile(r"\*BIPACT_TIME\n(\$.*\n)*[^$*].*\n")


def lesson():
    with open(NEWMARK) as file:
        return file.read()


def blocks(*extra, scheme="THETA,0.5,0.5", mass="CONSISTENT,0", tend=0.01, **material):
    """A block above a held base, with more cards."""
    lines, _ = two_blocks(gap=5.0, **material)
    return deck(lines, 1.0e-3, tend, scheme, mass, mu=0.0, extra=extra)


def thick():
    """The block twice as thick as its base."""
    text = blocks().replace("2,1,1\n*SECTION_SHELL", "2,2,1\n*SECTION_SHELL\n2,13\n2.0\n*SECTION_SHELL")
    assert "2,2,1" in text
    return text


def push(points, end=0.01):
    """A curve with a load on the block."""
    return blocks("*DEFINE_CURVE", "7,", *points, "*LOAD_NODE_SET", "2,2,7,1.0e-6", tend=end)


def stiff():
    """Steps so long that the contact forces meet their law to 1e-10 only."""
    path = os.path.join(TMP, "stiff.k")
    make_bars.write(
        path, nx=10, ny=3, dt=0.1, tend=2.0, young=1.0e9, mu=0.3, slide=0.2, poisson=0.3
    )
    with open(path) as file:
        return file.read()


def wedge():
    path = os.path.join(TMP, "wedge.k")
    make_scenes.write(path, "sliding", mu=10.0, base=1, tend=0.2, courant=10.0)
    with open(path) as file:
        return file.read()


def stiff():
    """Bars of which one is 1e12 times as stiff, for a scheme that takes its forces from it."""
    path = os.path.join(TMP, "stiff.k")
    make_bars.write(path, nx=20, young2=1.0e15, scheme="NSGENALPHA")
    with open(path) as file:
        return file.read()


SPIN = "*INITIAL_VELOCITY_GENERATION", "2,2,2.0,0.0,0.0", "0.5,5.5,0.0,0.0,0.0,1.0"
# kind: deck, what its line says of place, step and remedy
KINDS = {
    "energy-growth": (lesson, r"step \d+, time \S+: take a smaller step, or another scheme"),
    "scheme": (
        lambda: GAMMA_CARD.sub(r"\g<1>1,0.5\n", TIME_CARD.sub("", lesson())),
        r"choose SCHEME THETA",
    ),
    "balance": (stiff, r"step \d+, time \S+: stiff and light.*take less"),
    "overlap": (lambda: from_behind("segments", 60.0).text(), r"node \d+; .*step \d+, time \S+: take"),
    "rotation": (lambda: blocks(*SPIN, tend=0.1), r"element \d+ .*step \d+, time .*end the run"),
    "wedging": (wedge, r"node \d+, step \d+, time \S+: .*try"),
    "poisson": (lambda: blocks(poisson=0.495), r"\.k:\d+: PR > 0.49 of material 1"),
    "thickness": (thick, r"\.k:\d+: bodies of unequal thickness"),
    "both-sides": (lambda: blocks("*BIPACT_PAIR", "1,BOTH"), r"\.k:\d+: SIDE BOTH"),
    "mass": (
        lambda: blocks(scheme="THETA,1.0,1.0", mass="DISPERSION,0"),
        r"theta = xi = 1/2.*take",
    ),
    "curve": (
        lambda: push(("0.0,0.0", "0.005,1.0")),
        r"curve 7 at time 0.005: it stays at 1.0; give it points until ENDTIM",
    ),
}


def lines_of(text, start=""):
    """The kinds of the lines that tell a warning."""
    return re.findall(r"(?m)^%sWARNING ([\w-]+): " % start, text)


def told():
    """Each kind of warning, from a deck that has it: one line on the screen with place or step
    and what to do, the same in the log and, counted, in the summary; --quiet leaves the standard
    output empty and the screen its warnings."""
    for kind, (text, words) in KINDS.items():
        folder = os.path.join(TMP, kind)
        path = folder + ".k"
        with open(path, "w") as out:
            out.write(text())
        code, errors, output = bipact(path, folder)
        check(code in (0, 1), "%s: exit %d %s" % (kind, code, errors))
        shown = lines_of(errors)
        check(shown.count(kind) == 1 and len(set(shown)) == len(shown), kind + ": " + errors)
        check(re.search("(?m)^WARNING %s: .*%s" % (kind, words), errors), kind + ": " + errors)
        check(sorted(shown) == sorted(lines_of(log_of(folder))), kind + ": screen and log")
        for where, summary in (("screen", output), ("log", log_of(folder))):
            found = re.search(r"(?m)^notes \d+, warnings (\d+)\n((?:  .*\n?)*)", summary)
            named = re.findall(r"(?m)^  (\d+) x ([\w-]+): .*\w", found.group(2))
            check(int(found.group(1)) == len(shown), "%s: their number, %s" % (kind, where))
            check([n for _, n in named] == shown, "%s: the summary names them, %s" % (kind, where))
            check(all(int(n) > 0 for n, _ in named), "%s: the summary counts, %s" % (kind, where))
        quiet = bipact(path, folder, "--quiet")
        check(quiet == (code, errors, ""), kind + ": --quiet: %s" % (quiet,))


def sober():
    """What is no warning: a level end of a curve, a deck without fault. --check and --plan show
    the warnings of the deck, with --quiet on the screen alone. Two materials of one kind are one
    line on the screen and two in the log; warnings of hundreds of steps are one line."""
    for text in (blocks(), push(("0.0,1.0", "0.005,1.0")), push(("0.0,0.0", "0.02,1.0"))):
        folder, code, errors = run_text("sober", text)
        check((code, errors) == (0, ""), "silent: " + errors)
        check(", warnings 0\n" in log_of(folder), "silent: the log")
    path = os.path.join(TMP, "two.k")
    text = blocks(poisson=0.495)
    again = text[text.index("*MAT_ELASTIC") :].splitlines()[:2]
    text = text.replace("*MAT_ELASTIC", "\n".join(again).replace("\n1,", "\n2,") + "\n*MAT_ELASTIC")
    with open(path, "w") as out:
        out.write(text)
    for option in ("--check", "--plan"):
        code, errors, output = bipact(path, TMP, option)
        check(lines_of(errors) == ["poisson"] and "2 x poisson" in output, option + output)
        check(bipact(path, TMP, option, "--quiet") == (code, errors, ""), option + " --quiet")
    folder, code, errors = run_text("two", text)
    check(lines_of(log_of(folder)) == ["poisson"] * 2, "log: " + log_of(folder))
    check(lines_of(errors) == ["poisson"], "screen: " + errors)
    folder, code, errors = run_text("stiff", stiff())
    missed = "certificate not met" in log_of(folder)
    check(("certificate" in lines_of(errors)) == missed, "certificate: " + errors)
    folder, code, errors = run_text("lesson", lesson())
    count = int(re.search(r"(\d+) x energy-growth", log_of(folder)).group(1))
    check(count > 50 and errors.count("\n") == 1, "%d times: %s" % (count, errors))


def screen_of(data):
    """What a terminal shows: a carriage return goes to the start of the line, letters overwrite
    what is there."""
    rows, at = [""], 0
    for letter in data.replace("\r\n", "\n"):
        if letter == "\n":
            rows, at = rows + [""], 0
        elif letter == "\r":
            at = 0
        else:
            rows[-1] = rows[-1][:at].ljust(at) + letter + rows[-1][at + 1 :]
            at += 1
    return [row.rstrip() for row in rows if row.strip()]


def terminal():
    """On a terminal a line of progress is shown (after 64 steps); the warning of step 105 comes
    on a line of its own, whole and alone."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [BIPACT, NEWMARK, "-o", os.path.join(TMP, "terminal")],
        stdout=subprocess.DEVNULL,
        stderr=theirs,
    ) as child:
        os.close(theirs)
        data = b""
        while True:
            try:
                more = os.read(ours, 65536)
            except OSError:  # the other side is closed
                break
            if not more:
                break
            data += more
        os.close(ours)
        check(child.wait() == 0, "exit code")
    text = data.decode()
    check("step 64 " in text, "progress is shown: %r" % text)
    _, code, errors = run_text("plain", lesson())
    check(screen_of(text) == errors.splitlines(), "the screen: %s" % screen_of(text))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
