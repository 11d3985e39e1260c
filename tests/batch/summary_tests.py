"""summary.json: its members are those that doc/output.md lists, its numbers those of the tables
and the log, its texts JSON whatever the deck holds; failed and stopped runs leave one too, a
deck error none."""

import json
import math
import os
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import scenes
from scenes import BIPACT, ROOT, TMP, bipact, check, finish, table

import make_bars
import sweep

SPREAD = ("deck.parameters", "phases")  # members whose names depend on the run


def strict(text):
    """JSON without the words of Python that JSON has not (NaN, Infinity), and without two
    members of one name."""

    def refuse(word):
        raise ValueError("%s is no JSON" % word)

    def unique(pairs):
        check(len(dict(pairs)) == len(pairs), "names differ: %s" % [k for k, _ in pairs])
        return dict(pairs)

    return json.loads(text, parse_constant=refuse, object_pairs_hook=unique)


def summary_of(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return strict(file.read())


def log_of(folder):
    with open(os.path.join(folder, "bipact.log"), errors="replace") as file:
        return file.read()


def exists(folder, name="summary.json"):
    return os.path.exists(os.path.join(folder, name))


def members(value, path=""):
    """Paths of all members that hold no others, as doc/output.md writes them."""
    if isinstance(value, dict) and value:
        for name, item in value.items():
            yield from members(
                item,
                (
                    "NAME".join((path + ".", ""))
                    if path in SPREAD
                    else (path + "." + name if path else name)
                ),
            )
    elif isinstance(value, list) and path != "warnings":
        for item in value:
            yield from members(item, path + "[]")
    else:
        yield path + "[]" * (path == "warnings")


def documented():
    """The members that doc/output.md lists."""
    with open(os.path.join(ROOT, "doc", "output.md"), encoding="utf-8") as page:
        section = page.read().split("## summary.json")[1].split("\n## ")[0]
    cells = [line.split("|")[1] for line in section.split("\n") if line.startswith("| `")]
    return {name for cell in cells for name in re.findall("`([^`]+)`", cell)}


def scene(name, cards="", **options):
    """A two-bar deck, with more cards before its end."""
    path = os.path.join(TMP, name + ".k")
    make_bars.write(path, **dict(dict(nx=20, courant=0.5, mu=0.3, slide=0.1), **options))
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(text.replace("*END", cards + "*END"))
    return path, os.path.join(TMP, name)


def compare_energies(summary, glstat):
    """Time, steps and energies are those of the last row, bit for bit."""
    for name, value in summary["energies"].items():
        if name != "worst_residual":
            check(value == glstat[name][-1], "energies.%s as in glstat" % name)
    worst = summary["energies"]["worst_residual"]
    check(worst == max(abs(glstat["residual"])), "worst residual")
    check(summary["time"] == glstat["time"][-1], "time")
    check(summary["steps"] == glstat.cycle, "steps")


def every_term():
    """A scene with loads, motions, walls, friction: no two terms of the ledger are equal."""
    folder = os.path.join(TMP, "terms")
    code, errors, _ = bipact(os.path.join(ROOT, "input", "cards", "every_keyword.k"), folder)
    summary, glstat = summary_of(folder), table(folder, "glstat")
    check(code == 0, errors)
    compare_energies(summary, glstat)
    terms = [v for n, v in summary["energies"].items() if v != 0.0 and "residual" not in n]
    check(len(set(terms)) == len(terms) >= 9, "terms differ: %s" % summary["energies"])
    depths = [summary["certificate"][n] for n in ("penetration", "penetration_per_edge")]
    check(depths[0] >= max(table(folder, "sleout")["penetration"]) > 0.0, "penetration")
    check(0.0 < depths[0] < depths[1], "edges are shorter than 1: %s" % depths)


def done():
    """A run that ends: members, and each number against the table or the log."""
    deck, folder = scene("done", tables=["glstat", "sleout=step"], split=True)
    code, _, screen = bipact(deck, folder, "-D", "mu=0.2")
    summary, log = summary_of(folder), log_of(folder)
    check(code == 0 and summary["status"] == "done", "done: %d" % code)
    check(summary["exit_code"] == 0 and summary["message"] is None, "done: code, message")
    check(
        set(members(summary)) == documented(),
        "members as in doc/output.md: %s" % (set(members(summary)) ^ documented()),
    )
    compare_energies(summary, table(folder, "glstat"))
    solves = table(folder, "sleout", contact=0)
    check(summary["certificate"]["error"] == max(solves["error"]), "worst error")
    check(summary["certificate"]["eta"] == max(solves["eta"]), "worst eta")
    check(summary["certificate"]["met"] is True, "certificate met")
    check(summary["counts"]["contact_solves"] == sum(solves["solves"]), "contact solves")
    check(summary["counts"]["sweeps"] == sum(solves["sweeps"]), "sweeps")
    counted = re.search(r"factorisations (\d+), solves (\d+), contact searches (\d+)", log)
    for name, found in zip(("factors", "solves", "contact_searches"), counted.groups()):
        check(summary["counts"][name] == int(found), "counts.%s as in the log" % name)
    for text, where in ((log, "log"), (screen, "screen")):
        cpu = float(re.search(r"CPU (\S+) s", text).group(1))
        check(abs(summary["cpu"] - cpu) <= 1e-5 * cpu, "cpu as on the %s (6 digits)" % where)
        check(
            "peak memory %d kB" % (summary["peak_memory"] // 1024) in text, "memory, " + where
        )
    phases = log.split("phase  ")[1].strip().split("\n")[1:]
    for line, (name, phase) in zip(phases, summary["phases"].items(), strict=True):
        check(line[:30].strip() == name and int(line[42:]) == phase["calls"], "phase " + name)
        check(math.isclose(float(line[30:42]), phase["seconds"], rel_tol=1e-4), name)
    check(summary["deck"]["parameters"]["MU"] == "0.2", "the value of -D")
    paths = [deck, os.path.join(TMP, "done_mesh.k")]
    check([f["path"] for f in summary["deck"]["files"]] == paths, "the deck and its include")
    for entry in summary["deck"]["files"]:
        with open(entry["path"], "rb") as file:
            data = file.read()
        check(entry["bytes"] == len(data), "bytes")
        check(entry["checksum"] == sweep.checksum(data), "checksum")


def warned():
    """Warnings are those of the log, letter by letter; notes are counted."""
    deck, folder = scene("warned", scheme="newmark", tend=0.06)
    bipact(deck, folder)
    summary, log = summary_of(folder), log_of(folder)
    listed = re.findall("(?m)^WARNING (.*)$", log)
    check(len(listed) > 0 and summary["warnings"] == listed, "warnings: %s" % listed)
    check(summary["warning_count"] == len(listed), "number of warnings")
    check(summary["note_count"] == len(re.findall("(?m)^NOTE ", log)), "number of notes")


def failed():
    """Failures in a step and before the first: code and message as on the screen."""
    stop = "*BIPACT_LEDGER\n,1e-6,STOP\n"
    deck, folder = scene("failed", stop, scheme="newmark", tend=0.06)
    code, errors, _ = bipact(deck, folder)
    summary = summary_of(folder)
    check(code == 1 and summary["status"] == "failed", "failed: %d %s" % (code, errors))
    check(summary["exit_code"] == 1, "its code")
    check(errors.strip().endswith("bipact: " + summary["message"]), "its message: " + errors)
    check(0 < summary["steps"] < 100000, "its step")
    check(
        "# end: failed, cycle %d" % summary["steps"]
        in open(os.path.join(folder, "glstat.tab")).read(),
        "the step of the tables",
    )
    # Newmark finds no first acceleration of a node that has a load and no mass.
    load = "*LOAD_NODE_POINT\n%d,1,1,1.0\n*DEFINE_CURVE\n1,\n0.0,1.0\n1.0,1.0\n"
    node = make_bars.describe(nx=20, courant=0.5)["face1"][0]
    deck, folder = scene("start", load % node, scheme="newmark", redist=1)
    code, errors, _ = bipact(deck, folder)
    summary = summary_of(folder)
    check(code == 1 and summary["exit_code"] == 1, "before the first step: %s" % errors)
    check(summary["steps"] == 0 and "bipact: " + summary["message"] == errors.strip(), errors)
    check(os.listdir(folder) == ["summary.json"], "nothing else")


def texts():
    """A title with every byte but a new line, a parameter that is a word, a path in Latin-1."""
    deck, folder = scene("texts")
    with open(deck, "rb") as file:
        data = file.read()
    title = bytes(k for k in range(1, 80) if k not in (10, 13, 36, 42))
    for k, line in enumerate(
        (
            b'"\\' + title,
            bytes(range(128, 208)),
            bytes(range(176, 256)),
            "µ = 0.3 – größer".encode(),
        )
    ):
        changed = re.sub(rb"(?<=\*TITLE\n).*", lambda m: line, data)
        path = os.path.join(TMP.encode(), b"text\xfc%d.k" % k)
        with open(path, "wb") as file:
            file.write(changed)
        code, errors, _ = bipact(path, folder)
        summary = summary_of(folder)
        check(code == 0, "texts: %s" % errors)
        try:
            expected = line.decode()
        except UnicodeDecodeError:
            expected = line.decode("latin-1")
        check(summary["deck"]["title"] == expected[:80].strip(), "title %r" % expected)
        check(summary["deck"]["path"].endswith("text\xfc%d.k" % k), "a path in Latin-1")


def parameters():
    """Of two parameters of one name that of all files is named, one of an include alone too."""
    include = os.path.join(TMP, "own.k")
    with open(include, "w") as file:
        file.write("*PARAMETER_LOCAL\nRmu,0.7,Rown,1.5\n*END\n")
    deck, folder = scene("local")
    with open(deck) as file:
        text = file.read()
    with open(deck, "w") as file:
        file.write(text.replace("*PARAMETER\n", "*INCLUDE\nown.k\n*PARAMETER\n", 1))
    code, errors, _ = bipact(deck, folder, "--quiet")
    summary = summary_of(folder)
    found = summary["deck"]["parameters"]
    check(
        code == 0 and (found["MU"], found["OWN"]) == ("0.3", "1.5"), "%s %s" % (errors, found)
    )
    check(summary["deck"]["files"][1]["path"] == include, "the include")


def without_contact():
    """No contact, no tables: the ledger all the same, no certificate."""
    lines, _ = scenes.two_blocks()
    text = scenes.deck(lines, 1e-3, 1e-2, extra=["*INITIAL_VELOCITY", "2,", "1.0,"])
    text = re.sub(r"\*DATABASE_\w+\n.*\n", "", text)
    folder, code, errors = scenes.run_text("alone", text)
    summary = summary_of(folder)
    check(code == 0 and summary["certificate"] is None, "no contact: %s" % errors)
    check(summary["energies"]["initial"] > 0.0, "the ledger without glstat")
    check(summary["deck"]["parameters"] == {}, "no parameters")


def old_ones():
    """A deck error leaves the folder as it was; a run that is killed leaves no summary, not
    even of an earlier run; what cannot be written is a failure, and there is no half of it."""
    deck, folder = scene("old", nx=80, courant=0.02)
    code, _, _ = bipact(deck, folder, "--quiet", "-D", "tend=0.001")
    before = open(os.path.join(folder, "summary.json")).read()
    code, _, _ = bipact(deck, folder, "--quiet", "-D", "nosuch=1")
    check(
        code == 2 and open(os.path.join(folder, "summary.json")).read() == before, "untouched"
    )
    code, _, _ = bipact(deck, os.path.join(TMP, "new"), "--quiet", "-D", "nosuch=1")
    check(code == 2 and not exists(os.path.join(TMP, "new"), ""), "a deck error writes nothing")
    child = subprocess.Popen([BIPACT, deck, "-o", folder, "--quiet"])
    while child.poll() is None and exists(folder):
        time.sleep(0.001)
    child.kill()
    check(child.wait() == -signal.SIGKILL and not exists(folder), "killed: no summary")
    os.mkdir(os.path.join(folder, "summary.tmp"))
    code, errors, _ = bipact(deck, folder, "--quiet", "-D", "tend=0.001")
    check(code == 3 and "summary.tmp" in errors, "cannot be written: %d %s" % (code, errors))
    check(errors.count("bipact: ") == 1 and not exists(folder), "one message, no summary")
    check(
        "# end: done" in open(os.path.join(folder, "glstat.tab")).read(), "the tables are whole"
    )


def stopped():
    """A signal ends the run, the summary says so; going on from there ends it, and says from
    where."""
    card = "*BIPACT_RESTART\n%10d\n" % 0
    deck, folder = scene("stopped", card, nx=80, courant=0.02)
    if not os.path.exists(re.sub(r"bipact([^/]*)$", r"bipact-hdf5\1", BIPACT)):
        print("bipact-hdf5 is not built: a stopped run was NOT tested")
        return
    child = subprocess.Popen([BIPACT, deck, "-o", folder, "--quiet"], stderr=subprocess.PIPE)
    while child.poll() is None and not exists(folder, "bipact.log"):
        time.sleep(0.01)
    time.sleep(0.1)
    child.send_signal(signal.SIGTERM)
    errors = child.communicate()[1].decode()
    summary = summary_of(folder)
    check(child.returncode == 4 and summary["exit_code"] == 4, "stopped: %s" % errors)
    check(summary["status"] == "stopped" and summary["message"] in errors, "stopped: status")
    check(summary["counts"]["restart_files"] == 1, "its restart file")
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    again = summary_of(folder)
    check(code == 0 and again["status"] == "done", "went on: %s" % errors)
    check(again["restarted_from"].startswith(os.path.join(folder, "restart.")), "from where")
    check(again["steps"] > summary["steps"] > 0, "steps go on")


for test in (
    done,
    every_term,
    warned,
    failed,
    texts,
    parameters,
    without_contact,
    old_ones,
    stopped,
):
    test()
finish()
