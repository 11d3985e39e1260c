"""Does what the walk-through of doc/developer.md says, in a copy of the sources.

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
    shutil.copy2(os.path.join(ROOT, "tests/unit/test_linalg.f90"), TREE + "/tests/unit")
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


def columns(engine, card):
    """{(table, column): values} of the scene with an engine, which the log must name."""
    deck, folder = os.path.join(TMP, engine + ".k"), os.path.join(TMP, engine)
    with open(os.path.join(ROOT, SCENE)) as file:
        text = file.read()
    with open(deck, "w") as out:
        out.write(text.replace("*END", card + "*END"))
    run(["bin/bipact", deck, "-o", folder, "--quiet"])
    with open(os.path.join(folder, "bipact.log")) as file:
        if "solver %s," % engine not in file.read():
            sys.exit("the log does not name " + engine)
    found = {}
    for name, wanted in COMPARED.items():
        path = os.path.join(folder, name + ".tab")
        with open(path) as file:
            heads = next(line for line in file if line.startswith("# time")).split()[1:]
        rows = np.loadtxt(path)
        found.update({(name, head): rows[:, heads.index(head)] for head in wanted})
    return found


def main():
    with open(os.path.join(ROOT, "doc/developer.md")) as file:
        text = section(file.read(), "A new linear solver, step by step")
    copy_tree()
    card, commands, written = None, [], 0
    for kind, before, body in blocks(text):
        if kind == "fortran":
            write_block(before, body)
            written += 1
        elif kind == "sh":
            commands += body.splitlines()
        else:
            card = body
    for command in commands:
        print(command + ":", run(command, shell=True).splitlines()[-1])
    full, ldlt = columns("FULL", card), columns("LDLT", "")
    off = max(np.abs(full[k] - ldlt[k]).max() / np.abs(ldlt[k]).max() for k in ldlt)
    print("FULL against LDLT in %d columns: %.1e, bound %.1e" % (len(ldlt), off, BOUND))
    if not (written == 3 and len(commands) > 3 and off <= BOUND):
        sys.exit("the walk-through does not lead where it says")


main()
