"""What the studies share: run a deck as a child process, read its log, paths."""

import argparse
import json
import multiprocessing
import os
import platform
import re
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
PROGRAM = os.path.join(ROOT, "bin", "bipact")


def run(deck, folder, program=PROGRAM, limit=None):
    """Runs a deck; {code, cpu, peak, errors}: exit code (None after `limit` processor seconds),
    user + system seconds, peak MiB, messages."""
    with tempfile.TemporaryFile() as messages:
        child = os.fork()
        if child == 0:
            os.dup2(messages.fileno(), 2)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            if limit:
                import resource

                resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 1))
            os.execv(program, [program, deck, "-o", folder, "--quiet"])
        _, status, usage = os.wait4(child, 0)
        messages.seek(0)
        errors = messages.read().decode(errors="replace")
    code = os.WEXITSTATUS(status) if os.WIFEXITED(status) else None
    return {
        "code": code,
        "cpu": usage.ru_utime + usage.ru_stime,
        "peak": usage.ru_maxrss / 1024.0,
        "errors": errors.strip(),
    }


def read_log(folder):
    """Counts and phases of bipact.log: {name: number}, phases as 'phase NAME' in seconds."""
    found, phases = {}, False
    with open(os.path.join(folder, "bipact.log")) as log:
        for line in log:
            if phases:
                found["phase " + line[:30].strip()] = float(line[30:42])
                found["calls " + line[:30].strip()] = int(line[42:])
            phases = phases or line.startswith("phase ")
            for name, key in (
                ("steps", "steps"),
                ("factorisations", "factors"),
                (", solves", "solves"),
                ("contact solves", "contact_solves"),
                ("sweeps", "sweeps"),
                ("contact searches", "searches"),
            ):
                match = re.search(r"%s (\d+)" % name, line)
                if match and key not in found:
                    found[key] = int(match.group(1))
            if line.startswith("WARNING "):
                found.setdefault("warnings", []).append(line[8:].strip())
            match = re.search(r"closing overlaps gave back (\S+)", line)
            if match:
                found["corrections"] = found.get("corrections", 0.0) + float(match.group(1))
            match = re.search(r"worst error (\S+), eta (\S+),.*certificate (.*)", line)
            if match:
                found["certificate"] = match.group(3).strip()
    return found


def machine():
    """One line on the machine, without its name."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as info:
            model = next(x.split(":")[1].strip() for x in info if x.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return "%s, %d cores, %s" % (model, os.cpu_count() or 1, platform.system())


def today():
    return time.strftime("%Y-%m-%d")


def without_tables(path):
    """A copy of a deck without requests for tables, for timing; returns its path."""
    out, skip = [], False
    with open(path) as deck:
        for line in deck:
            if line.startswith("*"):
                skip = line.startswith("*DATABASE_")
            if not skip:
                out.append(line)
    name = path[:-2] + "_silent.k"
    with open(name, "w") as deck:
        deck.writelines(out)
    return name


def sweep(work, tasks, key, store, jobs):
    """Results of work(task) for all tasks, {key(task): result}, one run per core. Each result
    goes to store/runs.jsonl at once, and what is there already is not made again."""
    path = os.path.join(store, "runs.jsonl")
    done = {}
    if os.path.exists(path):
        with open(path) as file:
            done = dict(json.loads(line) for line in file if line.endswith("\n"))
    left = [task for task in tasks if key(task) not in done]
    start = time.time()
    with multiprocessing.Pool(jobs) as pool, open(path, "a") as file:
        found = pool.imap(work, left)
        for k, (task, result) in enumerate(zip(left, found), 1):
            file.write(json.dumps([key(task), result]) + "\n")
            file.flush()
            done[key(task)] = result
            if sys.stderr.isatty() or k % 200 == 0 or k == len(left):
                word = "\r%d of %d runs, %.0f s" % (k, len(left), time.time() - start)
                print(word, end="", file=sys.stderr)
    if left:
        print(file=sys.stderr)
    return done


def label(run):
    """Short name of a combination, a dictionary or (method, mass, redist): THETA D*, NEWMARK C,
    THETA 0.55 C."""
    if isinstance(run, tuple):
        run = dict(zip(("method", "mass", "redist"), run))
    return "%s %s%s" % (run["method"], run["mass"][0], "*" if run["redist"] else "")


def study_parser(words):
    """Parser of the options that the studies share."""
    parser = argparse.ArgumentParser(
        description=words, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="few runs, into build/")
    parser.add_argument("--reduced", action="store_true", help="part of the full study")
    parser.add_argument("--fresh", action="store_true", help="forget earlier runs")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--out", help="folder of the report")
    parser.add_argument("--store", help="folder of the kept results")
    return parser


def study_folders(name, a):
    """(folder of the kept results, folder of the report) of a study; made, emptied if fresh."""
    size = "quick" if a.quick else "reduced" if a.reduced else "full"
    store = a.store or os.path.join(ROOT, "build", name, size)
    out = a.out or (store if a.quick else os.path.join(ROOT, "doc", name))
    os.makedirs(store, exist_ok=True)
    os.makedirs(out, exist_ok=True)
    for name in ("runs.jsonl", "start.json", "peers.jsonl"):
        kept = os.path.join(store, name)
        if a.fresh and os.path.exists(kept):
            os.remove(kept)
    return store, out
