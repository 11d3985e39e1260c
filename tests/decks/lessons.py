"""Runs the decks of input/lessons, input/space and input/finite and checks what each of them says to expect:
$ expect: TABLE [ID=N] COLUMN last VALUE +- TOLERANCE, or TABLE COLUMN max VALUE at least."""

import glob
import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from scenes import at_most, bipact, check, finish, table

LINE = re.compile(
    r"^\$ expect: (\w+)(?: (\w+)=(\d+))? (\w+) (last|max) (\S+) (\+-|at least) ?(\S*)$"
)


def expected(name, deck, folder):
    """What the head of a deck says to expect of its run."""
    found = [LINE.match(x.rstrip("\n")) for x in open(deck) if x.startswith("$ expect:")]
    check(len(found) > 0 and all(found), name + ": says what to expect")
    for tab, key, number, column, which, value, relation, tolerance in (
        m.groups() for m in found if m
    ):
        rows = table(folder, tab, **({key: int(number)} if key else {}))[column]
        got = rows[-1] if which == "last" else rows.max()
        text = "%s: %s %s" % (name, tab, column)
        if relation == "+-":
            at_most(abs(got - float(value)), float(tolerance), text)
        else:
            at_most(float(value), got, text)


def solved(deck):
    """Runs a deck and its echo, whose tables must be the same; returns the folder."""
    name = os.path.basename(deck)[:-2]
    folder, again = os.path.join(scenes.TMP, name), os.path.join(scenes.TMP, name + ".again")
    code, errors, _ = bipact(deck, folder, "--quiet")
    check(code == 0, "%s: exit code %d %s" % (name, code, errors))
    code, errors, _ = bipact(os.path.join(folder, "deck.echo.k"), again, "--quiet")
    check(code == 0, "%s: echo deck: exit code %d %s" % (name, code, errors))
    for path in glob.glob(os.path.join(folder, "*.tab")):
        same = open(path).read() == open(os.path.join(again, os.path.basename(path))).read()
        check(same, "%s: the echo deck gives another %s" % (name, os.path.basename(path)))
    return folder


def main():
    decks = []
    for folder in ("lessons", "space", "finite"):
        decks += sorted(glob.glob(os.path.join(scenes.ROOT, "input", folder, "*.k")))
    check(len(decks) >= 8, "the lessons are there")
    for deck in decks:
        expected(os.path.basename(deck)[:-2], deck, solved(deck))


if __name__ == "__main__":
    main()
    finish()
