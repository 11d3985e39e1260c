"""scripts/sweep.py: all combinations, one row each, failed ones too; what is finished is not
run again unless version, values, deck or includes changed; several at once; interrupted it goes
on.
"""

import csv
import os
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import BIPACT, ROOT, TMP, check, finish, table

import make_bars
import sweep

SWEEP = os.path.join(ROOT, "scripts", "sweep.py")
DECK = os.path.join(TMP, "bars.k")
OUT = os.path.join(TMP, "bars.sweep")


def call(*words, program=BIPACT, wait=True):
    """Runs the sweep in TMP; (exit code, last line of output, messages), or the process."""
    child = subprocess.Popen(
        [sys.executable, SWEEP, *words, "--bipact", program],
        cwd=TMP,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    if not wait:
        return child
    output, errors = child.communicate()
    return child.returncode, output.strip(), errors


def rows(path=os.path.join(OUT, "sweep.csv")):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def ran(errors):
    """How many runs the messages tell of."""
    return sum(": " in line for line in errors.splitlines() if "/" in line.split(" ")[0])


def combinations():
    """Two values by three, one of which is refused by the deck: one row each, in order, with
    the numbers of the run; exit code 1 for the refused ones."""
    make_bars.write(DECK, nx=10, courant=0.5, split=True, tables=["glstat"])
    code, output, errors = call("bars.k", "mu=0.0,0.3", "dt=1e-4,5e-5,-1", "--jobs", "3")
    found = rows()
    check(code == 1 and output.endswith("4 of 6 runs are done"), "%d %s" % (code, errors))
    wanted = [(m, d) for m in ("0.0", "0.3") for d in ("1e-4", "5e-5", "-1")]
    check([(r["mu"], r["dt"]) for r in found] == wanted, "one row each, in order")
    check(ran(errors) == 6 and "6/6 " in errors, "a line of progress each: " + errors)
    for row in found:
        folder = os.path.join(TMP, row["folder"])
        if row["dt"] == "-1":
            check(row["status"] == "deck error" and row["exit_code"] == "2", row["status"])
            check("-D gives" in row["message"] or "DT0" in row["message"], row["message"])
            check("\n" not in row["message"] and row["steps"] == "", "one line, no numbers")
            continue
        last = table(folder, "glstat")
        check(row["status"] == "done" and row["exit_code"] == "0", "done")
        for column, name in (("time", "time"), ("energies_total", "total")):
            check(float(row[column]) == last[name][-1], "%s reads back equal" % column)
        check(row["certificate_met"] == "true", "a logical value")
        deck = open(os.path.join(folder, "deck.echo.k")).read()
        check(row["mu"] in deck and float(row["scene_dt"]) == float(row["dt"]), "its values")


def again():
    """Finished runs stay; a change of the deck, of an include, of the values, of the version,
    of the summary, or --fresh makes them again."""
    words = ("bars.k", "mu=0.0,0.3", "dt=1e-4,5e-5")
    marks = [os.path.join(TMP, r["folder"], "glstat.tab") for r in rows() if r["dt"] != "-1"]
    times = [os.stat(path).st_mtime_ns for path in marks]
    code, output, errors = call(*words)
    check(code == 0 and ran(errors) == 0 and "4 finished before" in errors, errors)
    check([os.stat(path).st_mtime_ns for path in marks] == times, "nothing was run")
    check(len(rows()) == 4 and rows()[3]["status"] == "done", "the table is whole")
    check(ran(call(*words, "v0=1")[2]) == 4, "other values")
    for name in ("bars.k", "bars_mesh.k"):
        with open(os.path.join(TMP, name), "a") as file:
            file.write("$ a comment\n")
        check(ran(call(*words)[2]) == 4, "%s changed" % name)
        check(ran(call(*words)[2]) == 0, "and is known")
    path = os.path.join(OUT, "mu=0.0,dt=1e-4", "summary.json")
    for old, new in (('"0.1.0"', '"0.0.9"'), ('"exit_code": 0', '"exit_code": 3'), ("}", "")):
        with open(path) as file:
            text = file.read()
        with open(path, "w") as file:
            file.write(text.replace(old, new))
        check(text.count(old) > 0 and ran(call(*words)[2]) == 1, "%s: %s" % (old, new))
    check(ran(call(*words, "--fresh")[2]) == 4, "--fresh")
    shutil.rmtree(os.path.dirname(path))
    check(ran(call(*words)[2]) == 1, "a folder that went")


def failures():
    """A run that fails numerically is finished and counts as not done; one without a summary of
    its own does not show that of an earlier run."""
    words = ("gain.k", "tend=0.001,0.06", "--csv", os.path.join(TMP, "gain.csv"), "-o", "g")
    make_bars.write(DECK, nx=20, courant=0.5, scheme="newmark")
    with open(DECK) as file:
        text = file.read()
    with open(os.path.join(TMP, "gain.k"), "w") as file:
        file.write(text.replace("*END", "*BIPACT_LEDGER\n,1e-6,STOP\n*END"))
    code, _, errors = call(*words)
    found = rows(os.path.join(TMP, "gain.csv"))
    check(code == 1 and [r["status"] for r in found] == ["done", "failed"], errors)
    check("growth" in found[1]["message"] and int(found[1]["steps"]) > 0, found[1]["message"])
    code, _, errors = call(*words)
    check(code == 1 and ran(errors) == 0, "a failed run is finished")
    fake = os.path.join(TMP, "fake")
    with open(fake, "w") as file:
        file.write("#!/bin/sh\n[ $1 = --version ] && echo bipact 0 && exit\nkill -9 $$\n")
    os.chmod(fake, 0o755)
    code, _, errors = call(*words, program=fake)
    found = rows(os.path.join(TMP, "gain.csv"))
    check(code == 1 and {r["status"] for r in found} == {"killed"}, "killed: " + errors)
    check(not any("steps" in r for r in found), "no numbers of an earlier run")


def interrupted():
    """Ctrl-C, or SIGTERM, ends the runs and writes the table; started again it goes on."""
    make_bars.write(DECK, nx=80, ny=4, courant=0.02)
    words = ("bars.k", "mu=0.1,0.2,0.3,0.4", "tend=0.001,1.0", "--jobs", "2", "-o", "stop")
    for number in (signal.SIGINT, signal.SIGTERM):
        child = call(*words, wait=False)
        while "done" not in child.stderr.readline() and child.poll() is None:
            pass
        time.sleep(0.3)
        child.send_signal(number)
        child.communicate()
        check(child.returncode == 130, "interrupted: code %d" % child.returncode)
        found = rows(os.path.join(TMP, "stop", "sweep.csv"))
        check(len(found) == 8 and found[0]["status"] == "done", "the table is there")
        check("not run" in {r["status"] for r in found}, "some were not run")
        check(found[1]["status"] == "stopped", "those that ran: " + found[1]["status"])
        if number == signal.SIGINT:
            shutil.rmtree(os.path.join(TMP, "stop"))
    code, _, errors = call("bars.k", "mu=0.1", "tend=0.001", "-o", "stop")
    check(code == 0 and ran(errors) == 0, "what was done is not run again")
    path = os.path.join(TMP, "stop", "mu=0.1,tend=0.001", "summary.json")
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(text.replace('"exit_code": 0', '"exit_code": 4'))
    code, _, errors = call("bars.k", "mu=0.1", "tend=0.001", "-o", "stop")
    check(code == 0 and ran(errors) == 1, "what was stopped is")


def arguments():
    """Wrong words: exit code 2 and nothing made."""
    for words in (
        ("bars.k",),
        ("bars.k", "mu"),
        ("bars.k", "mu="),
        ("bars.k", "mu=1,,2"),
        ("bars.k", "mu=1,1"),
        ("bars.k", "mu=1", "MU=2"),
        ("bars.k", "mu=1", "--jobs", "0"),
        ("none.k", "mu=1"),
    ):
        code, _, errors = call(*words, "-o", "wrong")
        check(code == 2 and "error: " in errors, "%s: %d %s" % (words, code, errors))
    check(not os.path.exists(os.path.join(TMP, "wrong")), "nothing is made")
    check(sweep.quoted("a=b/c ü") == "a=b%2Fc%20ü", sweep.quoted("a=b/c ü"))
    check(sweep.quoted("m=1.0E+3-x_y") == "m=1.0E+3-x_y", "plain words stay")


for test in (combinations, again, failures, interrupted, arguments):
    test()
finish()
