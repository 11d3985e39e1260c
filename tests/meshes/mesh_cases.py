"""What the tests of mesh2deck.py share: a conversion, its deck read back, what is in it."""

import contextlib
import io
import os
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import TMP, bipact, check

import mesh2deck
from deck_text import Deck

PARTS, NODES, SEGMENTS = "*SET_PART_LIST_TITLE", "*SET_NODE_LIST_TITLE", "*SET_SEGMENT_TITLE"
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def path(name):
    return os.path.join(TMP, name)


def put(name, text):
    """Writes a file; returns its path."""
    with open(path(name), "w", encoding="utf-8") as out:
        out.write(text)
    return path(name)


def run(*words):
    """mesh2deck.py in this process: (exit code, output, messages)."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            code = mesh2deck.main(list(words))
        except SystemExit as stop:
            code = stop.code
    return code, out.getvalue(), errors.getvalue()


def convert(source, *options, deck="out.k"):
    """The deck of a mesh, read back, and the summary."""
    code, out, errors = run(source, path(deck), *options)
    check(code == 0 and not errors, "%s: exit code %s: %s" % (source, code, errors))
    return Deck(path(deck)), out


def refused(source, *words, code=2):
    """A mesh that makes no deck: one message with these words, no file."""
    deck = path("refused.k")
    got, out, errors = run(source, deck)
    what = "%s: exit %s, %r" % (os.path.basename(source), got, errors)
    check(got == code and not out, what)
    check(errors.count("\n") == 1 and errors.startswith("mesh2deck.py: "), what)
    for word in words:
        check(word in errors, "%s lacks %r" % (what, word))
    check(
        not [n for n in os.listdir(TMP) if n.startswith("refused")], what + ": a file is there"
    )


def gmsh(name, geometry, *options, dim=2):
    """Meshes a geometry to a file; returns its path."""
    source = put("geometry.geo", geometry)
    done = subprocess.run(
        [
            sys.executable,
            os.path.join(os.path.dirname(sys.executable), "gmsh"),
            source,
            "-%d" % dim,
        ]
        + ["-o", path(name)]
        + list(options),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    check(done.returncode == 0 and os.path.exists(path(name)), "gmsh: " + done.stdout)
    return path(name)


def areas(deck):
    """{part: sum of the areas of its elements}; every element must be counter-clockwise."""
    nodes, sums = deck.nodes(), {}
    for number, (part, corners) in deck.elements().items():
        x, y = (np.array([nodes[n] for n in corners]) - nodes[corners[0]]).T
        area = 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
        check(area > 0.0, "element %d is clockwise" % number)
        sums[part] = sums.get(part, 0.0) + area
    return sums


def places(deck, numbers):
    """Coordinates of nodes as a set."""
    nodes = deck.nodes()
    return {nodes[n] for n in numbers}


def named(deck, keyword):
    """{title: members} of sets; each title once."""
    sets, names = deck.sets(keyword), deck.names(keyword)
    check(len(set(names.values())) == len(names), "two sets of %s have one title" % keyword)
    return {names[number]: members for number, members in sets.items()}


def headings(deck):
    """{heading: part id}"""
    found = {heading: number for number, (heading, _, _) in deck.parts().items()}
    check(len(found) == len(deck.parts()), "two parts have one heading")
    return found


def around(deck, *more):
    """A main deck of motion around a mesh that is included, of materials of density 1."""
    parts = Deck(path(deck)).parts().values()
    lines = ["*KEYWORD", "*INCLUDE", deck, "*CONTROL_TERMINATION", "1.0,"]
    lines += ["*CONTROL_IMPLICIT_GENERAL", "1,0.1", "*CONTROL_IMPLICIT_DYNAMICS", "1,"]
    if "*ELEMENT_SHELL" in Deck(path(deck)).cards:
        lines += ["*SECTION_SHELL", "1,13", "1.0,"]
    else:
        forms = {1: -1, 16: 16, 24: 24}
        for section in sorted({s for _, s, _ in parts}):
            lines += ["*SECTION_SOLID", "%d,%d" % (section, forms[section])]
    for mid in sorted({mid for _, _, mid in parts}):
        lines += ["*MAT_ELASTIC", "%d,1.0,1.0" % mid]
    return put("main.k", "\n".join(lines + [*more, "*END", ""]))


def is_valid(deck="out.k"):
    """bipact takes the mesh by *INCLUDE: --check of a main deck around it."""
    code, errors, _ = bipact(around(deck), path("main"), "--check")
    check(code == 0, "%s is refused: %s" % (deck, errors))


def three(members):
    """Segments of a set in space as lists of their three or four different corners."""
    found = [members[k : k + 4] for k in range(0, len(members), 4)]
    return [s[:3] if s[2] == s[3] else s for s in found]


def flux(deck, segments):
    """Flux of the place through faces: three times the volume that they close, outward. A face
    with four corners is bilinear: the mean of its two pairs of triangles."""
    at, total = {n: np.array(p) for n, p in deck.points().items()}, 0.0
    for s in segments:
        c = [at[n] for n in s]
        pairs = [(0, 1, 2)] if len(s) == 3 else [(0, 1, 2), (0, 2, 3), (0, 1, 3), (1, 2, 3)]
        each = [c[i] @ np.cross(c[j], c[k]) for i, j, k in pairs]
        total += 0.5 * sum(each) / max(1, len(pairs) / 2)
    return total
