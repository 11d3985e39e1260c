"""A small scene in plain fixed columns, by sections that a test replaces, and what may be asked
of a changed deck: the same tables in every digit, or a refusal with certain words."""

import os
import shutil

import scenes
from scenes import check, run_text, show


def fixed(*values, width=10):
    """Values right-aligned in columns of one width; None leaves a field blank."""
    return "".join(("" if v is None else str(v)).rjust(width) for v in values).rstrip()


def long(*values):
    """Values in columns of the long form."""
    return fixed(*values, width=20)


def cards(keyword, *lines):
    """A keyword with its cards."""
    return "\n".join(["*" + keyword] + list(lines))


def pair(*texts):
    """Pairs of *PARAMETER: names and values in turn."""
    return "".join(n.ljust(10) + str(v).rjust(10) for n, v in zip(texts[::2], texts[1::2]))


def node(nid, x, y, *more):
    """A card of *NODE; more: z, TC, RC."""
    card = fixed(nid, width=8) + fixed(x, y, *more[:1], width=16)
    return (card.ljust(56) + fixed(*more[1:], width=8)).rstrip() if len(more) > 1 else card


def shell(*ids):
    """A card of *ELEMENT_SHELL."""
    return fixed(*ids, width=8)


def table(name, interval="0.001"):
    """A request for a table."""
    return "*DATABASE_" + name + "\n" + fixed(interval)


# Two blocks of two quadrilaterals; the left one flies at the right one, whose far side is held.
# The sections in the order of the deck.
LEFT, RIGHT = range(1, 7), range(11, 17)
SECTIONS = {
    "title": "*TITLE\na block meets another",
    "end": "*CONTROL_TERMINATION\n" + fixed(0.01),
    "general": "*CONTROL_IMPLICIT_GENERAL\n" + fixed(1, 0.0001),
    "dynamics": "*CONTROL_IMPLICIT_DYNAMICS\n" + fixed(1),
    "time": "*BIPACT_TIME\n" + fixed("THETA", 0.5),
    "early": "",
    "nodes": "*NODE\n"
    + "\n".join(
        node(first + 3 * j + i, x + 0.5 * i, 1.0 * j)
        for first, x in ((1, 0.0), (11, 1.005))
        for j in (0, 1)
        for i in (0, 1, 2)
    ),
    "elements": "*ELEMENT_SHELL\n"
    + "\n".join(
        shell(e, part, a, a + 1, a + 4, a + 3)
        for e, part, a in ((1, 1, 1), (2, 1, 2), (3, 2, 11), (4, 2, 12))
    ),
    "parts": "*PART\nleft\n" + fixed(1, 1, 1) + "\nright\n" + fixed(2, 1, 2),
    "section": "*SECTION_SHELL\n" + fixed(1, 13, None, 4) + "\n" + fixed(0.5),
    "left material": "*MAT_ELASTIC\n" + fixed(1, 0.001, 1000.0, 0.3),
    "right material": "*MAT_ELASTIC\n" + fixed(2, 0.002, 2000.0, 0.25),
    "held": "*SET_NODE_LIST\n" + fixed(1) + "\n" + fixed(13, 16),
    "left set": "*SET_PART_LIST\n" + fixed(11) + "\n" + fixed(1),
    "right set": "*SET_PART_LIST\n" + fixed(12) + "\n" + fixed(2),
    "support": "*BOUNDARY_SPC_SET\n" + fixed(1, None, 1, 1),
    "curve": "*DEFINE_CURVE\n"
    + fixed(1)
    + "\n"
    + fixed(0.0, 1.0, width=20)
    + "\n"
    + fixed(1.0, 3.0, width=20),
    "load": "*LOAD_BODY_Y\n" + fixed(1, 5.0),
    "velocity": "*INITIAL_VELOCITY_GENERATION\n" + fixed(1, 2, None, 1.0, -0.25) + "\n",
    "contact": "*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE\n" + fixed(11, 12, None, None, 0.3),
    "tables": "\n".join(
        table(n) for n in "GLSTAT MATSUM NODOUT ELOUT RCFORC SLEOUT SPCFORC NCFORC".split()
    ),
    "nodes of nodout": "*DATABASE_HISTORY_NODE\n" + fixed(1, 3, 6, 11, 13, 14, 16),
    "elements of elout": "*DATABASE_HISTORY_SHELL\n" + fixed(1, 2, 3, 4),
    "more": "",
}


MESH = SECTIONS["nodes"] + "\n" + SECTIONS["elements"]


def held_nodes(tc, *nodes, rc=None):
    """The nodes with TC (and RC) for some of them."""
    lines = []
    for line in SECTIONS["nodes"].split("\n"):
        if line[:1] == " " and int(line[:8]) in nodes:
            line = line.ljust(56) + fixed(tc, rc, width=8)
        lines.append(line)
    return "\n".join(lines)


def deck(sections=None, **changes):
    """The deck with sections replaced; an underscore in a name stands for a blank. `more` comes
    last, `early` before the nodes."""
    parts = dict(SECTIONS if sections is None else sections)
    for name, text in changes.items():
        if name.replace("_", " ") not in parts:
            raise KeyError(name)
        parts[name.replace("_", " ")] = text
    return "\n".join(["*KEYWORD"] + [t for t in parts.values() if t] + ["*END", ""])


def write_files(files):
    """Writes files that a deck includes, beside it."""
    for name, text in (files or {}).items():
        path = os.path.join(scenes.TMP, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", newline="", encoding="utf-8") as out:
            out.write(text)


def remove_files(files):
    """Removes files that a deck included, so that no other deck finds them."""
    for name in files:
        path = os.path.join(scenes.TMP, name)
        if os.path.exists(path):
            os.remove(path)


def rows_of(folder):
    """{table: its text without the lines of the header}."""
    found = {}
    for name in sorted(os.listdir(folder)):
        if name.endswith(".tab"):
            with open(os.path.join(folder, name)) as lines:
                found[name] = "".join(x for x in lines if x[:1] != "#")
    return found


def notes_of(folder):
    """Notes and warnings of the log, one a line; what the run itself notes is left out."""
    with open(os.path.join(folder, "bipact.log")) as log:
        found = [x.strip() for x in log if x.startswith(("NOTE ", "WARNING "))]
    of_the_run = ("closing overlaps gave back", "WARNING bending")
    return [x for x in found if not any(words in x for words in of_the_run)]


_plain = {}


def run_plain(text):
    """Tables of a deck that is known to be right; each text runs once."""
    if text not in _plain:
        folder, code, errors = run_text("plain", text, "--quiet")
        if code != 0:
            raise RuntimeError("the plain deck: exit code %d: %s" % (code, errors))
        _plain[text] = rows_of(folder)
    return _plain[text]


def same(name, text, plain=None, files=None, options=(), notes=None):
    """A changed deck must give the tables of the plain one in every digit, and so must its echo
    deck. notes: words of its notes and warnings, one text for each, in any order."""
    expected = run_plain(deck() if plain is None else plain)
    check(text != plain, name + ": the deck is a changed one")
    write_files(files)
    folder, code, errors = run_text("changed", text, "--quiet", *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    if code != 0:
        return
    check(rows_of(folder) == expected, name + ": other tables")
    found = notes_of(folder)
    if notes is not None:
        check(
            len(found) == len(notes) and all(any(n in f for f in found) for n in notes),
            "%s: notes %s, expected %s" % (name, found, list(notes)),
        )
    with open(os.path.join(folder, "deck.echo.k"), newline="", encoding="utf-8") as echo:
        echo_text = echo.read()
    folder, code, errors = run_text("echo", echo_text, "--quiet")
    check(code == 0, "%s: its echo deck: exit code %d: %s" % (name, code, errors))
    if code == 0:
        check(rows_of(folder) == expected, name + ": other tables by its echo deck")
    show("%-60s the same" % name)


def refused(name, text, *words, files=None, options=(), problems=None):
    """A deck that must be refused: exit code 2, nothing written, all words in the messages, and
    as many problems as are said, where they are."""
    write_files(files)
    folder = os.path.join(scenes.TMP, "refused")
    shutil.rmtree(folder, ignore_errors=True)
    _, code, errors = run_text("refused", text, "--quiet", *options)
    check(code == 2, "%s: exit code %d: %s" % (name, code, errors))
    check(not os.path.exists(folder), name + ": files after a refusal")
    for word in words:
        check(word in errors, '%s: no "%s" in: %s' % (name, word, errors))
    if problems is not None:
        counted = "%d problem%s in the deck" % (problems, "" if problems == 1 else "s")
        check(counted in errors, "%s: expected %s: %s" % (name, counted, errors))
    show("%-60s %s" % (name, errors.split("\n")[0]))
