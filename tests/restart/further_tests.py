"""A run goes on from its restart file to a later end, or with other output: it is then the one
long run, and what differs between the decks is named."""

import glob
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time

for folder in ("support", "decks", "restart"):
    sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", folder))
import contact_geometry as geometry
import numpy as np
import restart_tests as base
import scenes
from restart_tests import contents, differences, restart_files, with_cards, write_deck
from scenes import BIPACT, TMP, at_most, bipact, check, finish, make_bars, show

import fields
import make_scenes

COMMENTS = r"(?:\$[^\n]*\n)*"


def with_card(text, keyword, card):
    """A deck with another first card under a keyword."""
    out, count = re.subn(
        r"(?m)^(\*%s\n%s)[^\n]*" % (keyword, COMMENTS), lambda m: m.group(1) + card, text
    )
    assert count == 1, (keyword, count)
    return out


def ended(text, end):
    """A deck with another ENDTIM; further fields stay where they stand behind commas."""
    card = re.search(r"(?m)^\*CONTROL_TERMINATION\n%s([^\n]*)" % COMMENTS, text).group(1)
    return with_card(text, "CONTROL_TERMINATION", "%r," % end + card.partition(",")[2])


def step_of(text):
    """DT0 of a deck, its parameters resolved."""
    card = re.search(r"(?m)^\*CONTROL_IMPLICIT_GENERAL\n%s([^\n]*)" % COMMENTS, text).group(1)
    word = card.split(",")[1] if "," in card else card[10:20]
    if "&" in word:
        name = word.strip()[1:]
        word = re.search(r"(?m)R%s\s+(\S+?)(?=[RIC]|\s|$)" % name, text).group(1)
    return float(word)


def every(text, interval):
    """A deck whose tables all have this interval."""
    return re.sub(
        r"(?m)^(\*DATABASE_(?:GLSTAT|MATSUM|NODOUT|ELOUT|RCFORC|RWFORC|SLEOUT|SPCFORC|NCFORC)\n"
        r"%s)[^\n]*" % COMMENTS,
        lambda m: m.group(1) + "%r," % interval,
        text,
    )


def run_to(name, text, end, folder, *options):
    """A run to an end; its log."""
    deck = write_deck(name.replace(" ", "-"), ended(text, end))
    code, errors, _ = bipact(deck, folder, "--quiet", *options)
    check(code == 0, "%s to %r: %d %s" % (name, end, code, errors))
    return log_of(folder)


def log_of(folder):
    with open(os.path.join(folder, "bipact.log")) as log:
        return log.read()


# ------------------------------------------------------------------------ a later end


def variants():
    """(name, deck, may be cut): every scheme, mass and engine, with contact and without, walls,
    loads, motions, corners, several cards, a purse that is short."""
    for name in base.SCENES:
        yield name, base.scene(name), name != "massless"
    bars = dict(nx=20, ny=2, courant=0.5, touch=0.5)
    path = os.path.join(TMP, "bars.k")
    for name, data in (
        ("dispersion", dict(mass="DISPERSION")),
        ("lumped massless", dict(mass="LUMPED", redist=1, mu=0.3, slide=0.3)),
        ("theta 0.7", dict(theta=0.7, mu=0.3, slide=0.3)),
        ("theta 1", dict(theta=1.0)),
        ("newmark massless", dict(scheme="NEWMARK", redist=1)),
        ("newmark dispersion", dict(scheme="NEWMARK", mass="DISPERSION")),
        ("finer", dict(nx=20, nx2=14, ny=3, ny2=2, mu=0.4, slide=0.3, poisson=0.3)),
    ):
        make_bars.write(path, **dict(bars, **data))
        with open(path) as file:
            yield name, file.read(), "DISPERSION" not in data.values()
    smooth = base.scene("friction")
    for card in ("LDLT,NATURAL", "LDLT,RCM", "LDLT,METIS", "SKYLINE,RCM", "SUPERNODAL,METIS"):
        yield card.lower(), with_cards(smooth, "*BIPACT_SOLVER\n%s,\n" % card), True
    for card in ("GS,", "PROX,", "NEWTON,", "GS,,,,EXACT", ",,,,,,,0"):
        yield "contact " + card, with_cards(smooth, "*BIPACT_CONTACT\n%s\n" % card), True
    path = os.path.join(os.environ["ROOT"], "input", "cards", "every_keyword.k")
    with open(path) as file:
        text = re.sub(r"(?ms)^\*BIPACT_(?:RESTART|FIELD)\n.*?(?=^\*)", "", file.read())
    yield "every keyword", text, True
    yield "every keyword newmark", text.replace("Cscheme        THETA", "Cscheme      NEWMARK"), True
    for name, scene in (
        ("corner", geometry.corner_on_edge(mu=0.3)),
        ("groove", geometry.v_groove(0.0, 1, 0.07)),
        ("slider", geometry.pressed_slider()),
        ("three bodies", geometry.three_bodies()),
        ("U", geometry.closing_u()),
        ("short purse", geometry.pressed_flat()),
    ):
        yield name, scene.text(), True


def further():
    """Ended three times on the way, once within a step, each time gone on to the next end: at the
    cut one and at the last the run is the one that goes there at once, in every byte of its tables
    and every number of its frames. Rows and frames fall between steps and ends, so that each end
    has a row that the longer run does not have."""
    touched = 0
    folder, long = os.path.join(TMP, "on"), os.path.join(TMP, "long")
    for name, text, may_be_cut in variants():
        run_to(name, text, end_of(text), long)
        steps, step = base.steps_of(long), step_of(text)
        text = every(text, 2.3 * step)
        text = with_cards(text, base.EVERY_FIELD % (6.7 * step) + base.RESTART % (0, "", 9))
        ends = [round(share * steps) * step for share in (0.3, 0.55, 0.8, 1.0)]
        ends[1] -= 0.63 * step * may_be_cut
        shutil.rmtree(folder, ignore_errors=True)
        for k, end in enumerate(ends):
            log = run_to(name, text, end, folder, *(["--restart", "latest"] if k else []))
            if k in (1, 3):
                run_to(name, text, end, long)
                off = differences(contents(long), contents(folder))
                check(not off, "%s to %r: %s" % (name, end, off[:5]))
            if k > 0:
                check("NOTE restart: *CONTROL_TERMINATION, field ENDTIM" in log, name)
                was_cut = "ended with a step cut to" in log
                check(was_cut == (may_be_cut and k == 2), "%s: cut step" % name)
        touched += "contact solves 0," not in log
        again_is_the_same(name, text, ends[-1], folder)
    show("%d scenes with contact" % touched)
    check(touched > 20, "scenes with contact")
    refined()
    damaged()
    killed_again()


def end_of(text):
    """ENDTIM of a deck, its parameters resolved."""
    card = re.search(r"(?m)^\*CONTROL_TERMINATION\n%s([^\n]*)" % COMMENTS, text).group(1)
    word = (card.split(",")[0] if "," in card else card[:10]).strip()
    if word.startswith("&"):
        word = re.search(r"(?m)R%s\s+(\S+?)(?=[RIC]|\s|$)" % word[1:], text).group(1)
    return float(word)


def again_is_the_same(name, text, end, folder):
    """From the file of the end to the same end: nothing to do, nothing lost."""
    before = contents(folder)
    run_to(name, text, end, folder, "--restart", "latest")
    off = differences(before, contents(folder))
    check(not off, "%s once more: %s" % (name, off[:5]))


def refined():
    """A body whose solves are refined when their drift may pass 1e-12: the steps so far decide,
    not the end, so a run that ends before that goes on to the run that ends behind it."""
    path = os.path.join(TMP, "stiff.k")
    make_scenes.write(path, "sliding", n=3, tend=0.5, courant=20.0)
    with open(path) as file:
        text = with_cards(file.read(), base.RESTART % (0, "", 2))
    step, folder, long = step_of(text), os.path.join(TMP, "stiff"), os.path.join(TMP, "long")
    log = run_to("stiff", text, 400 * step, long)
    after = int(re.search(r"refinement\s+on .* after (\d+) steps", log).group(1))
    check(2 < after < 200, "refined after %d steps" % after)
    log = run_to("stiff", text, (after - 2) * step, folder)
    check(re.search(r"refinement\s+off", log), "not refined before")
    run_to("stiff", text, 400 * step, folder, "--restart", "latest")
    off = differences(contents(long), contents(folder))
    check(not off, "into refinement: %s" % off[:5])


def damaged():
    """The file of the end is damaged: latest goes on from the one before; and that one, named,
    goes on to an end before the damaged one."""
    text = with_cards(base.scene("friction"), base.RESTART % (20, "", 2))
    step, folder, long = step_of(text), os.path.join(TMP, "damaged"), os.path.join(TMP, "long")
    for end, which in ((120, "latest"), (65, None)):
        run_to("damaged", text, 70 * step, folder)
        first, last = restart_files(folder)
        with open(last, "r+b") as file:
            file.seek(2000)
            file.write(b"damage")
        log = run_to("damaged", text, end * step, folder, "--restart", which or first)
        run_to("damaged", text, end * step, long)
        check(("is passed over" in log) == (which == "latest"), "damaged: %s" % which)
        check("restarted from %s" % first in log, "from the file before")
        off = differences(contents(long), contents(folder))
        check(not off, "damaged: %s" % off[:5])


def killed_again():
    """A run that went on from the end of another deck's is killed before its first restart file:
    it goes on once more from that end."""
    text = with_cards(base.scene("friction"), base.RESTART % (0, "", 2) + base.EVERY_FIELD % 1e-9)
    step, folder, long = step_of(text), os.path.join(TMP, "killed"), os.path.join(TMP, "long")
    run_to("killed", text, 40 * step, folder)
    deck = write_deck("killed", ended(text, 20000 * step))
    base.killed([BIPACT, deck, "-o", folder, "--quiet", "--restart", "latest"], 0.3)
    check(len(restart_files(folder)) == 1, "no file of its own yet")
    run_to("killed", text, 120 * step, folder, "--restart", "latest")
    run_to("killed", text, 120 * step, long)
    off = differences(contents(long), contents(folder))
    check(not off, "killed: %s" % off[:5])


# ------------------------------------------------------------------------ other output


def rows(folder, name):
    """(time, line) of each row of a table."""
    with open(os.path.join(folder, name + ".tab")) as file:
        lines = [line for line in file if not line.startswith("#")]
    return [(float(line.split()[0]), line) for line in lines]


def without(text, keyword):
    """A deck without the cards of a keyword."""
    out = re.sub(r"(?ms)^\*%s\n.*?(?=^\*)" % keyword, "", text)
    assert out != text, keyword
    return out


def supported():
    """Decks of a block with a foot that is held, which another meets; theta and Newmark."""
    for scheme in ("THETA,0.5,0.5", "THETA,0.7,0.7", "NEWMARK,"):
        lines, sets = scenes.two_blocks(gap=0.002)
        extra = ["*INITIAL_VELOCITY", "2,", "0.3,-1.0", "*BOUNDARY_SPC_NODE"]
        extra += ["%d,,1,1" % node for node in sets[1] if node % 3 == 1]  # the foot of the base
        step = 2.0e-4
        text = scenes.deck(
            lines, step, 150 * step, scheme, mu=0.3, extra=extra, history=[1, 20], every=3.3 * step
        )
        yield scheme.split(",")[0] + scheme.split(",")[1], text, step


def changed():
    """Tables with another interval, that begin, that end, with other nodes: rows before the
    restart are those of the run so far, rows from it on those of a run that had this deck from the
    start. The residual of the ledger is a share of the largest term seen so far, SLEOUT counts
    since the last row: these two depend on the rows before."""
    for name, text, step in supported():
        text = with_cards(text, base.RESTART % (0, "", 2))
        other = without(text, "DATABASE_MATSUM")
        for table, interval in (("GLSTAT", 2.0), ("RCFORC", 5.1)):
            other = with_card(other, "DATABASE_" + table, "%r," % (interval * step))
        other = with_card(other, "DATABASE_HISTORY_NODE", "20,21,22")
        cards = "".join(
            "*DATABASE_%s\n%r,\n" % (table, interval * step)
            for table, interval in (("ELOUT", 2.7), ("SPCFORC", 1.0), ("NCFORC", 1.0))
        )
        other = with_cards(other, cards + "*DATABASE_HISTORY_SHELL\n1,2\n")
        # 60 steps: within the first contact, where forces of the step before matter.
        before, folder, long = (os.path.join(TMP, x) for x in ("before", "on", "long"))
        shutil.rmtree(folder, ignore_errors=True)
        run_to(name, text, 60 * step, before)
        shutil.copytree(before, folder)
        log = run_to(name, other, 150 * step, folder, "--restart", "latest")
        run_to(name, other, 150 * step, long)
        for words in (
            "*DATABASE_GLSTAT, field DT",
            "*DATABASE_HISTORY_NODE, field ID1",
            "table MATSUM ends here",
            "table NCFORC begins here",
            "table SPCFORC begins here",
        ):
            check("NOTE restart: " + words in log, "%s: no note %s" % (name, words))
        compare_rows(name, before, folder, long, 60 * step)
        asked_again(name, text, folder, step)
    changed_fields()


def asked_again(name, text, folder, step):
    """A table that was given up goes on where it ended."""
    before = rows(folder, "matsum")
    run_to(name, text, 180 * step, folder, "--restart", "latest")
    found, here = rows(folder, "matsum"), 149.5 * step
    check([x for x in found if x[0] < here] == [x for x in before if x[0] < 59.5 * step], name)
    check(found[-1][0] > 179 * step and len(found) > len(before), name + ": MATSUM goes on")


def compare_rows(name, before, folder, long, time):
    """Rows before and after a restart at a time."""
    for path in glob.glob(os.path.join(long, "*.tab")):
        table = os.path.basename(path)[:-4]
        start = time - 1.0e-9
        late = table in ("spcforc", "ncforc")  # the step before the restart is not known
        found, whole = rows(folder, table), rows(long, table)
        if late:
            start = time + 1.0e-9
        if os.path.exists(os.path.join(before, table + ".tab")):
            so_far = [line for at, line in rows(before, table) if at < start]
            check([x for at, x in found if at < start] == so_far, "%s %s: before" % (name, table))
            check(so_far, "%s %s: rows before" % (name, table))
        else:
            check(all(at > start for at, _ in found), "%s %s: begins" % (name, table))
        found = [line.split() for at, line in found if at > start]
        whole = [line.split() for at, line in whole if at > start]
        if table == "glstat":
            for row in found + whole:
                row[14] = ""
        if table == "sleout":
            found, whole = ([row[:4] for row in x] for x in (found, whole))
        if table == "spcforc" and name.startswith("NEWMARK"):
            first = [row for row in found if row[0] == found[0][0]]
            close(name, first, whole[: len(first)])
            found, whole = found[len(first) :], whole[len(first) :]
        check(found == whole and found, "%s %s: rows after" % (name, table))


def close(name, found, whole):
    """Newmark's mean reaction of the first step needs that before, found anew from M A + K U, and
    not from the solve: the same to the round-off of sums over some hundred terms."""
    found, whole = (np.array(x, dtype=float) for x in (found, whole))
    at_most(abs(found - whole).max() / abs(whole[:, 2:]).max(), 1.0e-12, name + ": reaction")


def framed(text, step, interval, names="U"):
    return with_cards(text, "*BIPACT_FIELD\n%r,\n%s\n" % (interval * step, names))


def frames(folder, start, end):
    """Values of all fields at the frames of a span of time."""
    run = fields.Fields(folder)
    return {
        (run.times[k], name): run.frame(k, name).tobytes()
        for k in range(len(run.times))
        for name in run.names
        if start <= run.times[k] <= end
    }


def changed_fields():
    """Frames at other times, asked for first, of other fields, no more: those before the restart
    stay, those from it on are those of a run that had this deck from the start."""
    contact = "U,V,FORCE,PRESSURE,GAP,STATUS,STRESS"
    before, folder, long = (os.path.join(TMP, x) for x in ("before", "on", "long"))
    for name, text, step in supported():
        text = with_cards(text, base.RESTART % (25, "", 2))
        for what, old, new in (
            ("times", framed(text, step, 7.7), framed(text, step, 4.1)),
            ("begun", text, framed(text, step, 2.0, contact)),
            ("other", framed(text, step, 7.7), framed(text, step, 6.0, contact)),
        ):
            shutil.rmtree(folder, ignore_errors=True)
            run_to(name, old, 60 * step, before)
            shutil.copytree(before, folder)
            log = run_to(name, new, 150 * step, folder, "--restart", "latest")
            run_to(name, new, 150 * step, long)
            here, title = 59.5 * step, "%s, fields %s" % (name, what)
            after = frames(long, here, 1.0)
            check(after == frames(folder, here, 1.0) and after, title + ": after")
            check("*BIPACT_FIELD, field DT" in log, title + ": named")
            early = frames(folder, 0.0, here)
            check(early == (frames(before, 0.0, here) if what == "times" else {}), title)
            check(("hold other fields" in log) == (what == "other"), title + ": a note")
            count = fields.Fields(folder).times.size
            with open(os.path.join(folder, "fields.xdmf")) as file:
                check(file.read().count("<Time ") == count, title + ": fields.xdmf")
        run_to(name, text, 150 * step, before)
        files = sorted(os.listdir(folder))
        run_to(name, text, 170 * step, folder, "--restart", "latest")
        check([x for x in files if x not in os.listdir(folder) and "fields" in x] == [], "no more")


# ------------------------------------------------------------------------ what differs


def loaded():
    """A deck with something of every kind, and its step."""
    lines, sets = scenes.two_blocks(gap=0.002)
    step = 2.0e-4
    extra = [
        "*INITIAL_VELOCITY",
        "2,",
        "0.3,-1.0",
        "*BOUNDARY_SPC_SET",
        "1,,1,1",
        "*DEFINE_CURVE",
        "7,",
        "0.0,0.0",
        "1.0,2.0",
        "*LOAD_NODE_SET",
        "3,2,7,0.5",
        "*LOAD_BODY_Y",
        "7,1.5",
        "*SET_NODE_LIST",
        "3,",
        "16,17",
        "*SET_NODE_LIST",
        "4,",
        "20,21,22",
        "*DATABASE_HISTORY_NODE_SET",
        "4,",
        "*RIGIDWALL_PLANAR",
        "2,",
        "5.0,0.0,0.0,4.0,0.0,0.0,0.1",
        "*BIPACT_CONTACT",
        "AUTO,1.0E-10",
        ",",
        "*BIPACT_SOLVER",
        "LDLT,",
    ]
    text = scenes.deck(
        lines, step, 60 * step, mu=0.3, extra=extra, history=[1], every=3.3 * step
    )
    return with_cards(text, base.RESTART % (25, "", 2)), step


def blocks_of(text):
    """A deck as its keywords with their cards, without *KEYWORD and *END."""
    found = re.findall(r"(?ms)^\*.*?(?=^\*|\Z)", text)
    return [x for x in found if not x.startswith(("*KEYWORD", "*END"))]


def joined(blocks):
    return "*KEYWORD\n" + "".join(blocks) + "*END\n"


def same_decks(text):
    """(what, deck, words that the notes must have; none: no note but of ENDTIM)."""
    blocks = blocks_of(text)
    mesh = [x for x in blocks if x.startswith(("*NODE", "*ELEMENT"))]
    rest = [x for x in blocks if x not in mesh]
    with open(os.path.join(TMP, "mesh.k"), "w") as file:
        file.write(joined(mesh))
    yield "the same", text, []
    yield "comments", text.replace("\n*", "\n$ a comment\n*"), []
    yield "blocks backwards", joined(blocks[::-1]), []
    yield "an include", joined(["*INCLUDE\nmesh.k\n"] + rest), []
    yield "comma and columns", text.replace("7,1.5", "%10d%10s" % (7, "1.50E+0")), []
    young = "*PARAMETER\nRyoung,1.0E4\n" + text.replace("10000.0", "&young")[9:]
    yield "a parameter", "*KEYWORD\n" + young, []
    yield "blank cards", text.replace(
        "*END", "*BIPACT_LEDGER\n,\n*CONTROL_IMPLICIT_SOLUTION\n1,\n*END"
    ), []
    yield "no card of the scheme", text.replace("*BIPACT_TIME\nTHETA,0.5,0.5,\n", ""), []
    yield "a penalty factor", text.replace("11,12,,", "11,12,2.0,"), ["field SFACT", "1.0", "2.0"]
    yield "a title", text.replace("test scene", "another one"), ["*TITLE, field TITLE"]
    yield "a heading", text.replace("\nbase\n", "\nfoot\n"), ["*PART 1, field HEADING"]
    for card, words in (
        ("*BIPACT_LEDGER\n7,1.0E-6,STOP\n", ["field EVERY", "field GROWTH", "field ACTION"]),
        ("*SET_NODE_LIST\n9,\n1,2,3\n", ["*SET_NODE_LIST 9", "not in the run so far"]),
        ("*DEFINE_CURVE\n9,\n0.0,1.0\n1.0,1.0\n", ["*DEFINE_CURVE 9"]),
        ("*BIPACT_TIMING\n0.001,\n", ["*BIPACT_TIMING, field DT"]),
    ):
        yield card, with_cards(text, card), words
    yield "ROTWARN, a dump", text.replace(
        "AUTO,1.0E-10\n,", "AUTO,1.0E-10\n,,,9.0,80,85"
    ), ["field ROTWARN", "field DFIRST", "field DLAST"]
    yield "NLAST", text.replace("LDLT,", "LDLT,,,700"), ["field NLAST", "600", "700"]
    yield "ENDENG", with_card(text, "CONTROL_TERMINATION", "1.0,100,,90.0"), [
        "field ENDCYC",
        "field ENDENG",
    ]
    yield "a set of history nodes", text.replace("\n20,21,22", "\n20,22,"), ["*SET_NODE_LIST 4"]
    yield "KEEP", with_card(text, "BIPACT_RESTART", "10,,5,0"), ["field KEEP", "field NSTEP"]
    yield "no restarts", without(text, "BIPACT_RESTART"), ["*BIPACT_RESTART, field NSTEP"]


def other_decks(text):
    """(what is exchanged, by what, the words of the message)."""
    yield "1,1.0,10000.0,0.3", "1,1.0,10000.5,0.3", "*MAT_ELASTIC 1, field E", "10000.0", "10000.5"
    yield "1,0.0002", "1,0.0001", "*CONTROL_IMPLICIT_GENERAL, field DT0", "0.0002", "0.0001"
    yield "THETA,0.5,0.5", "THETA,0.6,0.5", "*BIPACT_TIME, field THETA", "0.5", "0.6"
    yield "THETA,0.5,0.5", "THETA,0.5", "*BIPACT_TIME, field XI", "0.5", "blank"
    yield "CONSISTENT,0", "LUMPED,0", "*BIPACT_MASS, field TYPE", "CONSISTENT", "LUMPED"
    yield "11,12,,,0.3", "11,12,,,0.4", "SURFACE, field FS", "0.3", "0.4"
    yield "11,12,,,0.3", "12,11,,,0.3", "SURFACE, field SURFA", "11", "12"
    yield "SURFACE_TO_SURFACE", "NODE_TO_SURFACE", "SURFACE_TO_SURFACE in the run so far", "", ""
    yield "0.3,-1.0", "0.3,-1.1", "*INITIAL_VELOCITY 2, field VY", "-1.0", "-1.1"
    yield "1,,1,1", "1,,1,0", "*BOUNDARY_SPC_SET 1, field DOFY", "1", "0"
    yield "1.0,2.0\n", "1.0,2.5\n", "*DEFINE_CURVE 7, field O", "2.0", "2.5"
    yield "1.0,2.0\n", "1.0,2.0\n2.0,2.0\n", "*DEFINE_CURVE 7", "a card more", ""
    yield "3,2,7,0.5", "3,2,7,0.25", "*LOAD_NODE_SET 3, field SF", "0.5", "0.25"
    yield "\n16,17\n", "\n16,18\n", "*SET_NODE_LIST 3, field NID2", "17", "18"
    yield "4.0,0.0,0.0,0.1", "4.0,0.0,0.0,0.2", "*RIGIDWALL_PLANAR, field FRIC", "0.1", "0.2"
    yield "AUTO,1.0E-10", "GS,1.0E-10", "*BIPACT_CONTACT, field SOLVER", "AUTO", "GS"
    yield "AUTO,1.0E-10\n,", "AUTO,1.0E-10\n,,1.0E-6", "field PENTOL", "1.0E-9", "1.0E-6"
    yield "LDLT,", "SKYLINE,", "*BIPACT_SOLVER, field ENGINE", "LDLT", "SKYLINE"
    yield "\n30,1.0,1.002\n", "\n30,1.0,1.5\n", "*NODE 30, field Y", "1.002", "1.5"
    yield "*LOAD_BODY_Y\n7,1.5\n", "", "*LOAD_BODY_Y 7: in the run so far, not in this deck", "", ""
    first, second = re.search(r"\*ELEMENT_SHELL\n(.*)\n(.*)\n", text).groups()
    yield first + "\n" + second, second + "\n" + first, "*ELEMENT_SHELL 2, field EID", "1", "2"


def named():
    """What no step depends on may differ, and is named in the log with both values; else the
    restart is refused with keyword, field and both values, and the folder is as it was. Comments,
    layout, order, includes and parameters are no differences."""
    text, step = loaded()
    before, folder, long = (os.path.join(TMP, x) for x in ("before", "on", "long"))
    run_to("before", text, 60 * step, before)
    run_to("long", text, 100 * step, long)
    for what, other, words in same_decks(text):
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(before, folder)
        log = run_to("other", other, 100 * step, folder, "--restart", "latest")
        notes = re.findall(r"(?m)^NOTE restart: (.*)$", log)
        check(any("field ENDTIM" in note for note in notes), what + ": ENDTIM is named")
        for word in words:
            check(any(word in note for note in notes), "%s: no %s in %s" % (what, word, notes))
        if not words:
            check(len(notes) == 1, "%s: %s" % (what, notes))
        if not words or words[0].startswith("*SET_NODE_LIST 9"):
            off = differences(contents(long), contents(folder))
            check(not off, "%s: %s" % (what, off[:5]))
    from_the_echo(before, folder, long, step)
    unchanged = contents(before)
    for old, new, *words in other_decks(text):
        assert text.count(old) == 1, (old, text.count(old))
        deck = write_deck("refused", ended(text.replace(old, new), 100 * step))
        code, errors, _ = bipact(deck, before, "--quiet", "--restart", "latest")
        check(code == 3, "%s: %d %s" % (old, code, errors))
        line = [x for x in errors.split("\n") if words[0] in x]
        told = len(line) == 1 and all(word in line[0].split(words[0])[1] for word in words[1:])
        check(told, "%s: not told: %s" % (words, errors))
        check(errors.count("in the run so far") in (1, 2), "one difference: " + errors)
    check(not differences(unchanged, contents(before)), "the folder is as it was")
    check(len(restart_files(before)) == 2, "with its restart files")
    far_off(before, text, step)


def from_the_echo(before, folder, long, step):
    """The deck as understood is the same deck."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(before, folder)
    with open(os.path.join(before, "deck.echo.k")) as file:
        run_to("echoed", file.read(), 100 * step, folder, "--restart", "latest")
    check(not differences(contents(long), contents(folder)), "from deck.echo.k")


def far_off(before, text, step):
    """A deck of another scene, one that ends before the file, and one whose contacts act at other
    times by its end."""
    deck = write_deck("foreign", base.scene("friction"))
    code, errors, _ = bipact(deck, before, "--quiet", "--restart", "latest")
    check(code == 3 and "another deck" in errors and " more\n" in errors, "foreign: " + errors)
    check(errors.count("\n") < 26, "a foreign deck makes a short message")
    for card, words in (
        ("%r," % (40 * step), "ENDTIM 0.008 lies before the file, step 60, time 0.012"),
        ("1.0,59", "ENDCYC 59 lies before the file, step 60"),
    ):
        deck = write_deck("short", with_card(text, "CONTROL_TERMINATION", card))
        code, errors, _ = bipact(deck, before, "--quiet", "--restart", "latest")
        check(code == 3 and words in errors, "%s: %d %s" % (words, code, errors))
    all_parts = "*CONTACT_2D_AUTOMATIC_SINGLE_SURFACE\n0,,,,0.1\n"
    born = text.replace("11,12,,,0.3\n", "11,12,,,0.3\n%r,\n" % (80 * step))
    born = with_cards(born, all_parts)
    folder = os.path.join(TMP, "born")
    run_to("born", born, 60 * step, folder)
    deck = write_deck("born", ended(born, 100 * step))
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    check(code == 3 and "to this ENDTIM a contact acts" in errors, "born: %d %s" % (code, errors))


# ------------------------------------------------------------------------ after a signal


def way_on():
    """After Ctrl-C the screen gives the command that goes on, as a shell takes it: names with
    blanks and quotes, -D in both forms, the program as it was called, --restart of before once."""
    folder = os.path.join(TMP, "it's a folder")
    text = base.with_cards(long_deck(), base.RESTART % (0, "", 2))
    with open(os.path.join(TMP, "a deck.k"), "w") as file:
        file.write(text)
    short = ["a deck.k", "-o", folder, "-D", "tend=0.004", "-Dtend2=1"]
    words = ["a deck.k", "-o", folder, "--quiet", "-D", "tend=9.0", "-Dtend2=1"]
    program = os.path.relpath(BIPACT, TMP)
    done = subprocess.run([program] + short, cwd=TMP, capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    command = [program] + words + ["--restart", "latest"]
    for number in (signal.SIGINT, signal.SIGTERM):
        errors = stopped(command, number)
        hint = re.search(r"(?m)^    hint: to go on: (.*)$", errors)
        check(hint, "the way on is told: " + errors)
        command = shlex.split(hint.group(1))
        check(command == [program] + words + ["--restart", "latest"], hint.group(1))
    steps = int(restart_files(folder)[-1].split(".")[-2])
    end = (steps + 20) * step_of(text)
    line = hint.group(1).replace("tend=9.0", "tend=%r" % end)
    done = subprocess.run(line, shell=True, cwd=TMP, capture_output=True, text=True)
    check(done.returncode == 0, "the command goes on: " + done.stderr)
    check(base.steps_of(folder) == steps + 20, "to the end")
    without_restarts(long_deck())


def long_deck():
    """Bars that fly and meet, with an end that another parameter does not change."""
    path = os.path.join(TMP, "bars.k")
    make_bars.write(path, nx=40, ny=4, courant=0.1, touch=0.5, mu=0.2, slide=0.2)
    with open(path) as file:
        text = file.read()
    return text.replace("*CONTROL_TERM", "*PARAMETER\nItend2,2\n*CONTROL_TERM")


def stopped(command, number):
    """Standard error of a run that a signal stops; its process group gets it, as from a
    terminal."""
    child = subprocess.Popen(
        command, cwd=TMP, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True,
    )
    time.sleep(0.7)
    os.killpg(child.pid, number)
    _, errors = child.communicate(timeout=60)
    check(child.returncode == 4, "stopped: %d %s" % (child.returncode, errors))
    return errors


def without_restarts(text):
    """Where there is no file to go on from, the screen says how there would be one."""
    for cards, words in (("", "*BIPACT_RESTART in the deck"), ("*BIPACT_RESTART\n0,,,0\n", "ONSIG")):
        write_deck("none", base.with_cards(text, cards))
        errors = stopped([BIPACT, "none.k", "-o", "none", "-D", "tend=9.0"], signal.SIGINT)
        check(words in errors and "to go on:" not in errors, "no file: " + errors)


if __name__ == "__main__":
    if not os.path.exists(base.HDF5):
        print("%s is not built: restarts NOT tested" % base.HDF5)
        sys.exit(77)
    globals()[sys.argv[1]]()
    finish()
