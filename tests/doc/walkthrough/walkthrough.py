"""Does what the walk-throughs of doc/developer.md say, in a copy of the sources.

Its blocks are marked by the line before them: "New file `PATH`:", or "In `PATH`, before `LINE`:"
(or after); a block of sh is run, the block of a deck is given to a scene."""

import os
import re
import shutil
import subprocess
import sys

import numpy as np

ROOT, TMP, FLAVOUR = (os.environ[name] for name in ("ROOT", "TMP", "FLAVOUR"))
TREE = os.path.join(TMP, "tree")
SCENE = "input/lessons/sliding_block.k"  # contact with friction: the last nodes matter
COMPARED = {
    "glstat": ("kinetic", "internal", "friction"),
    "matsum": ("momx", "vx"),
    "rcforc": ("fx", "fy", "ix", "iy"),
}
BOUND = 1.0e-9  # of the column's largest: any change of round-off, as in decks/engines
COPIED = ("Makefile", "VERSION", "src", "scripts", "tests/run.sh", "tests/support")
UNITS = ("test_linalg", "test_element", "test_space")
BUILT = ("obj", "mod", "gen", "flags", "deps.mk", "libbipact.a", "libsupport.a")


def section(page, title):
    """The text under a heading, up to the next of its rank."""
    return re.search(r"(?ms)^## %s$(.*?)(?=^## |\Z)" % re.escape(title), page).group(1)


def blocks(text):
    """(kind, line before, lines) of every fenced block."""
    for before, kind, body in re.findall(r"(?ms)^([^\n]*)\n\n```(\w*)\n(.*?)^```$", text):
        yield kind, before, body


def copy_tree():
    """The sources, and what has been built of them, so that only the new is compiled."""
    for name in COPIED:
        source, target = os.path.join(ROOT, name), os.path.join(TREE, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if os.path.isdir(source):
            shutil.copytree(source, target)
        else:
            shutil.copy2(source, target)
    os.makedirs(os.path.join(TREE, "tests/unit"))
    for name in UNITS:
        shutil.copy2(os.path.join(ROOT, "tests/unit", name + ".f90"), TREE + "/tests/unit")
    for name in BUILT:
        source = os.path.join(ROOT, "build", FLAVOUR, name)
        target = os.path.join(TREE, "build", FLAVOUR, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if os.path.isdir(source):
            shutil.copytree(source, target)
        elif os.path.exists(source):
            shutil.copy2(source, target)
    os.makedirs(os.path.join(TREE, "bin"))
    if FLAVOUR != "release":
        os.symlink("bipact-" + FLAVOUR, os.path.join(TREE, "bin/bipact"))


def write_block(before, body):
    """A new file, or lines beside one that the page names."""
    new = re.fullmatch(r"New file `(.+)`:", before)
    if new:
        with open(os.path.join(TREE, new.group(1)), "w") as out:
            out.write(body)
        return
    path, side, line = re.fullmatch(r"In `(.+?)`, (before|after) `(.+)`:", before).groups()
    path = os.path.join(TREE, path)
    with open(path) as file:
        text = file.read()
    if text.count(line + "\n") != 1:
        sys.exit("%s does not have the line once: %s" % (path, line))
    parts = (body, line + "\n") if side == "before" else (line + "\n", body)
    with open(path, "w") as out:
        out.write(text.replace(line + "\n", "".join(parts)))


def run(command, **options):
    """A command of the page, which must succeed; what it printed."""
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL")}
    environment["FFLAGS"] = "-O0"  # that the code is right takes no fast one
    done = subprocess.run(
        command,
        cwd=TREE,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        **options,
    )
    if done.returncode != 0:
        sys.exit("%s: exit code %d\n%s" % (command, done.returncode, done.stdout))
    return done.stdout


def columns(name, text):
    """{(table, column): values} of a deck, given as text."""
    deck, folder = os.path.join(TMP, name + ".k"), os.path.join(TMP, name)
    with open(deck, "w") as out:
        out.write(text)
    run(["bin/bipact", deck, "-o", folder, "--quiet"])
    with open(os.path.join(folder, "bipact.log")) as file:
        if name not in file.read():
            sys.exit("the log does not name " + name)
    found = {}
    for table, wanted in COMPARED.items():
        path = os.path.join(folder, table + ".tab")
        with open(path) as file:
            heads = next(line for line in file if line.startswith("# time")).split()[1:]
        rows = np.loadtxt(path)
        found.update({(table, head): rows[:, heads.index(head)] for head in wanted})
    return found


def with_engine(deck, cards):
    """The scene with more cards."""
    return deck.replace("*END", cards + "*END")


def with_scheme(deck, cards):
    """The scene with another time card."""
    text, one = re.subn(r"\*BIPACT_TIME\n(?:\$.*\n)*.*\n", cards, deck)
    if one != 1:
        sys.exit("the scene has no time card")
    return text


# Title of a section, blocks of code that it adds, and unless its tests are all there is, what its
# cards do to a scene, whose tables must be the same: name, cards.
WALKS = (
    ("A new linear solver, step by step", 3, with_engine, "FULL", "LDLT", ""),
    (
        "A new time scheme, step by step",
        4,
        with_scheme,
        "EULER",
        "THETA",
        "*BIPACT_TIME\nTHETA,1.0,1.0\n",
    ),
    ("A new element, step by step", 3),
)


def walk(page, deck, title, blocks_of_code, *scene):
    """One section, done to the letter."""
    card, commands, written = None, [], 0
    for kind, before, body in blocks(section(page, title)):
        if kind == "fortran":
            write_block(before, body)
            written += 1
        elif kind == "sh":
            commands += body.splitlines()
        else:
            card = body
    for command in commands:
        print(command + ":", run(command, shell=True).splitlines()[-1])
    if not (written == blocks_of_code and len(commands) > 2):
        sys.exit("the walk-through has not the blocks that it should have")
    if scene:
        compare(deck, card, *scene)


def compare(deck, card, change, name, other, cards):
    """Tables of a scene with the new thing and with what it should agree with."""
    new, old = columns(name, change(deck, card)), columns(other, change(deck, cards))
    off = max(np.abs(new[k] - old[k]).max() / np.abs(old[k]).max() for k in old)
    print("%s against %s in %d columns: %.1e, bound %.1e" % (name, other, len(old), off, BOUND))
    if off > BOUND:
        sys.exit("the walk-through does not lead where it says")


def main():
    with open(os.path.join(ROOT, "doc/developer.md")) as file:
        page = file.read()
    with open(os.path.join(ROOT, SCENE)) as file:
        deck = file.read()
    copy_tree()
    for one in WALKS:
        walk(page, deck, *one)


main()
