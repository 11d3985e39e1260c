#!/usr/bin/env python3
"""Run a deck with all combinations of values of its parameters, several at once.

    sweep.py deck.k mu=0.1,0.2,0.3 dt=1e-5,2e-5 --jobs 4

A name is one that *PARAMETER of the deck defines; a value replaces it as `bipact DECK -D
name=value` does. Every combination has a folder of its own, deck.sweep/mu=0.1,dt=1e-5, and
deck.sweep/sweep.csv one row for each: the values, how the run ended, and the numbers of its
summary.json (doc/output.md); of a run that left no summary, such as one with an error in the
deck, the message.

Started again the sweep goes on: combinations that are finished (done, or failed numerically)
are not run again, as long as version, values, deck and included files are the same; runs that
were stopped or killed, or that failed for want of disk or memory, are.

Exit code: 0 every run is done, 1 some run is not, 2 wrong arguments, 130 interrupted.
"""

import argparse
import csv
import itertools
import json
import os
import re
import signal
import subprocess
import sys
import threading
from array import array
from concurrent.futures import ThreadPoolExecutor

import startup

FINISHED = (0, 1)  # exit codes: done, numerical failure
NO_SUMMARY = {2: "deck error", 3: "file error"}
# Members of summary.json that are no columns: they describe the deck, not the run.
LEFT_OUT = ("schema", "deck", "restarted_from", "phases", "warnings")
MODULUS = 4294967291  # 2^32 - 5


def checksum(data):
    """Fletcher's checksum of bytes, as base_checksum of bipact makes it: the sum of the 32-bit
    words and the sum of its partial sums."""
    words = array("I", data + b"\0" * (-len(data) % 4))
    return "%08X%08X" % (sum(itertools.accumulate(words)) % MODULUS, sum(words) % MODULUS)


class Sweep:
    """Combinations of values, their folders, their processes."""

    limit = None  # seconds after which a run is stopped

    def __init__(self, program, deck, values, out):
        self.program, self.deck, self.out = program, os.path.abspath(deck), out
        self.names = list(values)
        self.combinations = list(itertools.product(*values.values()))
        self.version = version_of(program)
        self.files = {}  # path: (bytes, checksum)
        self.processes, self.stopping = set(), threading.Event()
        self.lock, self.count = threading.Lock(), 0

    def words(self, combination):
        """What tells a combination from the others."""
        return ["%s=%s" % pair for pair in zip(self.names, combination)]

    def folder(self, combination):
        """Folder of a combination: its values, with what no file name may hold as %XX."""
        return os.path.join(self.out, ",".join(map(quoted, self.words(combination))))

    def command(self, combination):
        """What runs a combination."""
        command = [self.program, self.deck, "-o", self.folder(combination), "--quiet"]
        for word in self.words(combination):
            command += ["-D", word]
        return command

    def is_its(self, summary, combination):
        """Does a summary tell of the deck and the values of a combination?"""
        given = {name.upper(): value for name, value in zip(self.names, combination)}
        used = summary["deck"]["parameters"]
        return summary["deck"]["path"] == self.deck and all(
            used.get(name) == value for name, value in given.items()
        )

    def same_file(self, entry):
        """Is a file that the run read what it was?"""
        path = entry["path"]
        if path not in self.files:
            try:
                with open(path, "rb") as file:
                    data = file.read()
            except OSError:
                return False
            self.files[path] = len(data), checksum(data)
        return self.files[path] == (entry["bytes"], entry["checksum"])

    def is_finished(self, combination):
        """Does the folder hold the end of just this run?"""
        summary = read_summary(self.folder(combination))
        try:
            return (
                summary["version"] == self.version
                and summary["exit_code"] in FINISHED
                and self.is_its(summary, combination)
                and all(map(self.same_file, summary["deck"]["files"]))
            )
        except (KeyError, TypeError):
            return False

    def run(self, combination):
        """Runs a combination; returns how it ended where it leaves no summary, else None."""
        if self.stopping.is_set():
            return {"status": "not run"}
        folder = self.folder(combination)
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, "summary.json")
        if os.path.exists(path):
            os.remove(path)
        code, errors = self.call(self.command(combination))
        summary = read_summary(folder)
        ending = None
        if summary is None:
            status = "killed" if code < 0 else NO_SUMMARY.get(code, "no summary")
            ending = {"status": status, "exit_code": code, "message": errors}
        self.tell(combination, (summary or ending)["status"])
        return ending

    def call(self, command):
        """Exit code and messages of a command."""
        environment = dict(os.environ)
        environment.setdefault("OMP_NUM_THREADS", "1")  # several runs share the machine
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=environment,
        )
        self.processes.add(process)
        if self.stopping.is_set():
            process.terminate()
        try:
            errors = process.communicate(timeout=self.limit)[1]
        except subprocess.TimeoutExpired:
            process.terminate()
            errors = process.communicate()[1]
        self.processes.discard(process)
        return process.returncode, errors.decode(errors="replace").strip()

    def tell(self, combination, status):
        """A line of progress."""
        with self.lock:
            self.count += 1
            words = ",".join(self.words(combination))
            print("%d/%d %s: %s" % (self.count, self.total, words, status), file=sys.stderr)

    def run_all(self, jobs, fresh):
        """Runs what is not finished. Returns {combination: how it ended without a summary}, and
        whether the sweep was interrupted."""
        remaining = [c for c in self.combinations if fresh or not self.is_finished(c)]
        self.total = len(remaining)
        if len(remaining) < len(self.combinations):
            print("%d finished before" % (len(self.combinations) - self.total), file=sys.stderr)
        with ThreadPoolExecutor(jobs) as pool:
            futures = {c: pool.submit(self.run, c) for c in remaining}
            try:
                for future in futures.values():
                    future.result()
            except KeyboardInterrupt:
                self.stopping.set()
                for process in list(self.processes):
                    process.terminate()
        return {c: future.result() for c, future in futures.items()}, self.stopping.is_set()

    def rows(self, endings):
        """One dictionary for each combination."""
        for combination in self.combinations:
            row = dict(zip(self.names, combination))
            folder = self.folder(combination)
            ending = endings.get(combination)
            summary = ending or read_summary(folder) or {"status": "no summary"}
            row.update(flat(summary))
            row["warnings"] = " | ".join(summary.get("warnings", ()))
            row["folder"] = folder
            yield row


def quoted(word):
    """A word as part of a file name."""
    return re.sub(r"[^\w.+=-]", lambda m: "".join("%%%02X" % b for b in m[0].encode()), word)


def version_of(program):
    """What `bipact --version` prints, without the name."""
    done = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    return done.stdout.split()[-1]


def read_summary(folder):
    """summary.json of a folder; None where there is none, or none of this layout."""
    try:
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
    except (OSError, ValueError):
        return None
    return summary if summary.get("schema") == 1 else None


def flat(summary):
    """The members of a summary as columns: those of an object with its name before theirs."""
    columns = {}
    for name, value in summary.items():
        if name in LEFT_OUT:
            continue
        inner = value.items() if isinstance(value, dict) else ()
        columns.update(("%s_%s" % (name, key), plain(item)) for key, item in inner)
        if not isinstance(value, dict):
            columns[name] = plain(value)
    return columns


def plain(value):
    """A value as a cell; a text of several lines in one."""
    if isinstance(value, bool):
        return str(value).lower()
    return re.sub(r"\s*\n\s*", " / ", value) if isinstance(value, str) else value


def write_csv(path, names, rows):
    """All rows under all names that they have; the file is replaced at once."""
    columns = dict.fromkeys(names + ["status", "exit_code", "message"])
    for row in rows:
        columns.update(dict.fromkeys(row))
    for last in ("warnings", "folder"):
        columns.pop(last)
    with open(path + ".tmp", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, [*columns, "warnings", "folder"], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    os.replace(path + ".tmp", path)


def values_of(words, parser):
    """{name: [value, ...]} of the words name=a,b,c."""
    values = {}
    for word in words:
        name, equal, text = word.partition("=")
        listed = text.split(",")
        if not (name and equal and all(listed)):
            parser.error('expected name=a,b,c, found "%s"' % word)
        if len(set(listed)) < len(listed):
            parser.error("%s: a value is given twice" % word)
        if name.upper() in map(str.upper, values):
            parser.error("%s is given twice" % name)
        values[name] = listed
    return values


def arguments(argv):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("deck", metavar="DECK")
    add("values", nargs="+", metavar="name=a,b,c", help="a parameter and its values")
    add("-o", dest="out", metavar="DIR", help="folder of the sweep (DECK's name with .sweep)")
    add("--csv", metavar="FILE", help="the table (DIR/sweep.csv)")
    add("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="runs at once (cores)")
    add("--fresh", action="store_true", help="run finished combinations again")
    add("--bipact", metavar="PATH", default=startup.program(), help="program")
    a = parser.parse_args(argv)
    a.values = values_of(a.values, parser)
    if a.jobs < 1:
        parser.error("--jobs must be at least 1")
    if not os.path.isfile(a.deck):
        parser.error('there is no deck "%s"' % a.deck)
    if not os.access(a.bipact, os.X_OK):
        parser.error('there is no program "%s"' % a.bipact)
    a.out = a.out or os.path.splitext(os.path.basename(a.deck))[0] + ".sweep"
    return a


def main(argv=None):
    a = arguments(argv)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sweep = Sweep(a.bipact, a.deck, a.values, a.out)
    os.makedirs(a.out, exist_ok=True)
    endings, interrupted = sweep.run_all(a.jobs, a.fresh)
    rows = list(sweep.rows(endings))
    path = a.csv or os.path.join(a.out, "sweep.csv")
    write_csv(path, sweep.names, rows)
    done = sum(row["status"] == "done" for row in rows)
    print("%s: %d of %d runs are done" % (path, done, len(rows)))
    if interrupted:
        return 130
    return 0 if done == len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
