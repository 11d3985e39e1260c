"""What the studies share: run a deck as a child process, read its log, paths."""

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
