"""Several ranks: the tables of the serial program whatever their number (in every digit on
one), restarts from any number to any other, an end when one of them dies."""

import glob
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import BIPACT, ROOT, TMP, at_most, bipact, check, finish, make_bars, show

PROGRAM = re.sub(r"bipact([^/]*)$", r"bipact-mpi\1", BIPACT)
if "sanitize" in PROGRAM:    # libraries of MPI keep memory, and stacks through them need the slow way
    keeps = os.path.join(ROOT, "tests", "mpi", "leaks.supp")
    os.environ["LSAN_OPTIONS"] = "suppressions=%s:print_suppressions=0" % keeps
    os.environ["ASAN_OPTIONS"] = "fast_unwind_on_malloc=0"
# Scales of what is compared: columns of one kind share theirs, for one that is zero but for
# round-off has none. Bounds: "equal" of doc/verification.md, forces 1e-6, all else 1e-9.
KINDS = {
    "nodout": [(("ux", "uy", "uz"), 1e-9), (("vmx", "vmy", "vmz"), 1e-9)],
    "glstat": [
        (("kinetic", "internal", "total", "external", "motion"), 1e-9),
        (("friction", "contact", "algorithmic", "damping", "kinetic", "internal"), 1e-9),
    ],
    "matsum": [(("kinetic", "internal"), 1e-9)],
    "rcforc": [(("fx", "fy", "fz", "fn", "ft"), 1e-6), (("ix", "iy", "iz"), 1e-9)],
    "rwforc": [(("fx", "fy", "fz", "fn", "ft"), 1e-6)],
    "spcforc": [(("fx", "fy", "fz"), 1e-6)],
    "elout": [(("sxx", "syy", "sxy", "szz"), 1e-6), (("energy",), 1e-9)],
}
# Steps of a deck: enough for all that it has but for late impacts, few for a crowded machine.
STEPS = {"finite": 2, "every": 8}
# Ranks; 3: all of input/ besides, which takes minutes.
MOST = int(os.environ.get("RANKS", "2"))
ALONE = "input_cards", "input_catalogue", "input_lessons", "input_space"
EXPLICIT = dict(scheme="PAOLI", pbeta=0.0, mass="LUMPED", courant=0.3)


def mpirun(ranks, *command):
    """The command that starts so many ranks."""
    root = ["--allow-run-as-root"] if os.getuid() == 0 else []
    start = ["mpirun", *root, "--oversubscribe", "--bind-to", "none"]
    start += ["--mca", "mpi_yield_when_idle", "1", "-n", str(ranks)]
    return start + [PROGRAM, *command]


def on_ranks(ranks, deck, folder, *options):
    """Runs a deck; returns (exit code, messages)."""
    done = subprocess.run(
        mpirun(ranks, deck, "-o", folder, "--quiet", *options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        timeout=250,
    )
    return done.returncode, done.stderr + done.stdout


def rows(path):
    """Names of the columns, and the numbers."""
    names, numbers = [], []
    with open(path) as file:
        for line in file:
            if line.startswith("# time"):
                names = line[1:].split()
            elif not line.startswith("#"):
                numbers.append([float(word) for word in line.split()])
    return names, np.array(numbers, ndmin=2)


def difference(one, other, kind, columns):
    """The largest difference of columns of a kind over their largest value."""
    k = [columns.index(c) for c in kind if c in columns]
    size = np.abs(one[:, k]).max() if k else 0.0
    return np.abs(one[:, k] - other[:, k]).max() / size if size > 0.0 else 0.0


def same_tables(serial, shared, what, twin=None):
    """Compares all tables of two runs by kinds of columns. twin: the serial run with another
    engine or other last digits. Where round-off moves it by more than the bound (forces of massless nodes, which are
    those of an elastic layer; slip of an exactly sticking node), ranks may do so too: ten times
    that, for they add in yet another order."""
    for path in sorted(glob.glob(os.path.join(serial, "*.tab"))):
        name = os.path.basename(path)[:-4]
        if name not in KINDS:
            continue
        columns, a = rows(path)
        _, b = rows(os.path.join(shared, name + ".tab"))
        check(a.shape == b.shape, "%s: %s has %s rows, not %s" % (what, name, b.shape, a.shape))
        if a.shape != b.shape or a.size == 0:
            continue
        for kind, bound in KINDS[name]:
            if twin:
                _, c = rows(os.path.join(twin, name + ".tab"))
                bound = max(bound, 10.0 * difference(a, c, kind, columns))
            worst = difference(a, b, kind, columns)
            at_most(worst, bound, "%s: %s %s" % (what, name, kind[0]))
        if name == "glstat":
            # Of a static contact solve it is what the solve leaves.
            k = columns.index("residual")
            bound = max(1e-10, 10.0 * np.abs(a[:, k]).max())
            at_most(np.abs(b[:, k]).max(), bound, "%s: ledger" % what)


def same_bytes(serial, shared, what):
    """Tables of one rank."""
    for path in sorted(glob.glob(os.path.join(serial, "*.tab"))):
        name = os.path.basename(path)
        if name == "timing.tab":
            continue
        with open(path, "rb") as one, open(os.path.join(shared, name), "rb") as other:
            check(one.read() == other.read(), "%s: %s differs" % (what, name))


def cut_short(deck, steps):
    """Gives a deck an end after some steps."""
    with open(deck) as file:
        lines = file.read().split("\n")
    k = lines.index("*CONTROL_TERMINATION") + 1
    while lines[k].startswith("$"):
        k += 1
    if "," in lines[k]:
        fields = lines[k].split(",") + [""]
        lines[k] = ",".join([fields[0], str(steps)] + fields[2:])
    else:
        lines[k] = lines[k].ljust(20)[:10] + "%10d" % steps + lines[k][20:]
    with open(deck, "w") as file:
        file.write("\n".join(lines))


def try_decks(folder):
    """The first deck of a folder of input/ on one rank and on two; with RANKS=3 in the environment
    all of them, on three too (minutes)."""
    counts = range(1, MOST + 1)
    copy = os.path.join(TMP, "input")
    shutil.copytree(os.path.join(ROOT, "input"), copy)
    done = 0
    for deck in sorted(glob.glob(os.path.join(copy, folder, "*.k"))):
        with open(deck) as file:
            text = file.read()
        if "*CONTROL_TERMINATION" not in text:
            continue    # a mesh
        if MOST < 3 and done:
            break
        done += 1
        name = os.path.relpath(deck, copy)
        finite = folder == "finite" or "finite" in name
        cut_short(deck, STEPS["finite" if finite else "every"])
        serial = os.path.join(TMP, "serial")
        code, errors, _ = bipact(deck, serial, "--quiet")
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        for ranks in counts:
            shared = os.path.join(TMP, "shared")
            code, said = on_ranks(ranks, deck, shared)
            what = "%s on %d" % (name, ranks)
            if "more ranks" in said:
                check(code == 2 and ranks > text_elements(serial), what + ": " + said)
                continue
            check(code == 0, "%s: exit code %d: %s" % (what, code, said))
            if code == 0 and ranks == 1:
                same_bytes(serial, shared, what)
            elif code == 0 and "newmark" not in name:
                same_tables(serial, shared, what)
            shutil.rmtree(shared, ignore_errors=True)
        shutil.rmtree(serial, ignore_errors=True)


def text_elements(folder):
    """Elements of a run, from its log."""
    with open(os.path.join(folder, "bipact.log")) as file:
        return int(re.search(r"(\d+) elements", file.read()).group(1))


def bars(name, **more):
    """A deck of two bars that meet halfway through its 120 steps."""
    path = os.path.join(TMP, name + ".k")
    scene = dict(nx=12, ny=3, courant=0.5, touch=0.25, poisson=0.3, mu=0.3, slide=0.3)
    scene.update(more)
    make_bars.write(path, **scene)
    cut_short(path, 90)
    return path


def with_cards(path, cards):
    """Adds cards to a deck."""
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(text.replace("*END", cards + "*END"))
    return path


def contact():
    """Impact with friction, massless nodes, explicit, two stages, damping; without RANKS=3 friction
    and explicit alone."""
    damping = "*DEFINE_CURVE\n77,\n0.0,20.0\n1.0,30.0\n*DAMPING_PART_MASS\n1,77,2.0\n"
    damping += "*DAMPING_PART_STIFFNESS\n2,-1e-4\n"
    scenes = [
        bars("friction"),
        bars("massless", mass="DISPERSION", redist=1),
        bars("explicit", **EXPLICIT),
        bars("two-stages", scheme="NSGENALPHA"),
        with_cards(bars("damped"), damping),
    ]
    for deck in scenes if MOST > 2 else (scenes[0], scenes[2]):
        name = os.path.basename(deck)[:-2]
        serial = os.path.join(TMP, name)
        code, errors, _ = bipact(deck, serial, "--quiet")
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        twin, other = serial + "-twin", deck[:-2] + "-twin.k"
        if name == "explicit":    # no engine, but sums in another order: a speed like it
            bars(name + "-twin", v0=1.0 + 1.0e-14, **EXPLICIT)
        else:
            with_cards(shutil.copy(deck, other), "*BIPACT_SOLVER\n   SKYLINE\n")
        code, errors, _ = bipact(other, twin, "--quiet")
        check(code == 0, "%s, twin: exit code %d: %s" % (name, code, errors))
        for ranks in range(2, MOST + 1):
            shared = "%s-%d" % (serial, ranks)
            code, said = on_ranks(ranks, deck, shared)
            check(code == 0, "%s on %d: exit code %d: %s" % (name, ranks, code, said))
            if code == 0:
                same_tables(serial, shared, "%s on %d" % (name, ranks), twin)


def restart():
    """From any number of ranks to any other, and to and from the serial program."""
    deck = with_cards(bars("kept"), "*BIPACT_RESTART\n%10d%10s%10d\n" % (40, "", 9))
    serial = os.path.join(TMP, "kept-serial")
    code, errors, _ = bipact(deck, serial, "--quiet")
    check(code == 0, "serial: " + errors)
    first = {"serial": serial}
    for ranks in (1, 2, 3):
        first[ranks] = os.path.join(TMP, "kept-%d" % ranks)
        code, said = on_ranks(ranks, deck, first[ranks])
        check(code == 0, "%d ranks: %s" % (ranks, said))
    for source, target in ((1, 2), (2, 1), (2, 3), (3, 2), ("serial", 3), (3, "serial")):
        file = sorted(glob.glob(os.path.join(first[source], "restart*.h5")))[1]
        folder = os.path.join(TMP, "on-%s-%s" % (source, target))
        shutil.copytree(first[source], folder)
        if target == "serial":
            code, said, _ = bipact(deck, folder, "--quiet", "--restart", file)
        else:
            code, said = on_ranks(target, deck, folder, "--restart", file)
        what = "from %s to %s" % (source, target)
        check(code == 0, "%s: exit code %d: %s" % (what, code, said))
        if code == 0:
            same_tables(serial, folder, what)


def children(pid):
    """Processes that a process has started."""
    with open("/proc/%d/task/%d/children" % (pid, pid)) as file:
        return [int(word) for word in file.read().split()]


def rank_of(pid):
    """Rank of a process, None where it has none (yet)."""
    try:
        with open("/proc/%d/environ" % pid) as file:
            found = re.search(r"OMPI_COMM_WORLD_RANK=(\d+)", file.read())
    except OSError:
        return None
    return int(found.group(1)) if found else None


def kill_one(ranks, victim, deck, folder, moment):
    """Starts a run and kills a rank of it: moment = (step, seconds), so long after the restart file
    of a step, or of a later one, is there; step 0: after the start. Returns (killed, exit code,
    messages); no code: it hangs."""
    run = subprocess.Popen(
        mpirun(ranks, deck, "-o", folder, "--quiet"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    step, seconds = moment
    while step > 0 and run.poll() is None and last_step(folder) < step:
        time.sleep(0.002)
    time.sleep(seconds)
    target = [pid for pid in children(run.pid) if rank_of(pid) == victim]
    for pid in target:
        os.kill(pid, signal.SIGKILL)
    try:
        said, _ = run.communicate(timeout=60)
    except subprocess.TimeoutExpired:
        run.kill()
        return True, None, ""
    return bool(target), run.returncode, said


def killed():
    """A rank that dies ends the run with a message, the last restart file is good, and the run
    that goes on from it is the whole one. KILLS=20 in the environment: so many random moments, of
    any rank of 2 and 3 (SEED=1); else ranks 1 and 0 of 2, once files are there."""
    count = int(os.environ.get("KILLS", "0"))
    chance = random.Random(int(os.environ.get("SEED", "1")))
    deck = bars("long", nx=40, ny=10)
    cut_short(deck, 300)
    with_cards(deck, "*BIPACT_RESTART\n%10d%10s%10d\n" % (5, "", 3))
    whole, twin = os.path.join(TMP, "whole"), os.path.join(TMP, "twin")
    code, errors, _ = bipact(deck, whole, "--quiet")
    check(code == 0, "whole run: exit code %d: %s" % (code, errors))
    other = with_cards(shutil.copy(deck, deck[:-2] + "-twin.k"), "*BIPACT_SOLVER\n   SKYLINE\n")
    code, errors, _ = bipact(other, twin, "--quiet")
    check(code == 0, "twin: exit code %d: %s" % (code, errors))
    plans = [(2, 1, (10, 0.0)), (2, 0, (10, 0.0))]
    if count:
        plans = [
            (k % 2 + 2, chance.randrange(k % 2 + 2), (chance.randrange(-40, 300), chance.random()))
            for k in range(count)
        ]
    for k, (ranks, victim, (step, share)) in enumerate(plans):
        moment = (step, 0.05 * share if step > 0 else 0.4 + share)
        go_on_after(k, ranks, victim, moment, deck, whole, twin)


def last_step(folder):
    """Step of the last restart file, 0 where there is none."""
    files = sorted(glob.glob(os.path.join(folder, "restart*.h5")))
    return int(re.search(r"(\d+)\.h5", files[-1]).group(1)) if files else 0


def go_on_after(k, ranks, victim, moment, deck, whole, twin):
    """One death, and the run that goes on after it."""
    folder = os.path.join(TMP, "killed-%d" % k)
    hit, code, said = kill_one(ranks, victim, deck, folder, moment)
    what = "rank %d of %d killed" % (victim, ranks)
    what += " %.3f s after step %d" % (moment[1], max(moment[0], 0))
    last = last_step(folder)
    show("%s: hit %s, exit %s, last restart file of step %d" % (what, hit, code, last))
    check(code is not None, what + ": the run hangs")
    if code is None:
        return
    if hit:
        check(code != 0, what + ": the run fails")
        check("signal 9" in said and "rank %d" % victim in said, what + ", and says why: " + said)
    else:
        check(code == 0, what + ", too early or too late: " + said)
    if last > 0:
        code, said = on_ranks(ranks, deck, folder, "--restart", "latest")
        check(code == 0, what + ", goes on: %d: %s" % (code, said))
        with open(os.path.join(folder, "bipact.log")) as file:
            check('" is passed over' not in file.read(), what + ": the last restart file is good")
        if code == 0:
            same_tables(whole, folder, what, twin)
    shutil.rmtree(folder, ignore_errors=True)


def wait_until(condition, seconds=120):
    """Waits for something, not for ever."""
    end = time.time() + seconds
    while not condition() and time.time() < end:
        time.sleep(0.05)
    check(condition(), "nothing came of it in %d s" % seconds)


def called_wrongly():
    """Errors of the call (exit code 3) and of the deck (2) on several ranks: one message, of the
    first rank."""
    good = bars("good")
    cases = [
        (3, "unknown option", [good, "--nonsense"]),
        (3, "--threads needs", [good, "--threads"]),
        (3, "--threads needs a number", [good, "--threads", "0"]),
        (3, "no deck given", []),
        (3, "cannot read", [os.path.join(TMP, "none.k")]),
        (2, "no such parameter", [good, "-D", "none=1.0"]),
    ]
    for word, card in (
        ("THREADS", "%10s%10s%10s%10s%10s%10s%10s\n" % ("AUTO", "", "", "", "", "", "0")),
        ("ENGINE", "%10s\n" % "PARDISO"),
        ("DIAGONAL", "%10s\n" % "DIAGONAL"),
    ):
        deck = with_cards(shutil.copy(good, os.path.join(TMP, word + ".k")), "*BIPACT_SOLVER\n" + card)
        cases.append((2, word, [deck]))
    for code, word, command in cases:
        for ranks in range(2, MOST + 1):
            folder = os.path.join(TMP, "refused")
            done = subprocess.run(
                mpirun(ranks, *command, *(["-o", folder] if command else [])),
                capture_output=True,
                text=True,
                timeout=100,
            )
            said = done.stdout + done.stderr
            what = "%s on %d ranks: exit code %d: %s" % (word, ranks, done.returncode, said)
            check(done.returncode == code and word in said and said.count("bipact:") == 1, what)
            check(re.search(r"\[\d+,1\],0\]", said), "it is the first rank that fails: " + what)
            check(not os.path.exists(folder), "no file: " + what)


def errors():
    """Errors by name, each told once."""
    called_wrongly()
    small = os.path.join(ROOT, "input", "lessons", "falling_block.k")
    code, said = on_ranks(2, small, os.path.join(TMP, "e1"))
    check(code == 2 and said.count("more ranks (2) than elements (1)") == 1, said)
    bad = os.path.join(TMP, "bad.k")
    with open(bad, "w") as file:
        file.write("*KEYWORD\n*NODEX\n*END\n")
    code, said = on_ranks(3, bad, os.path.join(TMP, "e2"))
    check(code == 2 and said.count("bipact:") == 1, said)
    deck = with_cards(bars("engine"), "*BIPACT_SOLVER\n     MUMPS\n")
    code, said, _ = bipact(deck, os.path.join(TMP, "e3"), "--quiet")
    check(code == 2 and "bin/bipact-mpi" in said, said)
    code, said = on_ranks(1, deck, os.path.join(TMP, "e4"))
    check(code == 0, "MUMPS on one rank: " + said)
    linked = subprocess.run(["ldd", BIPACT], capture_output=True, text=True).stdout
    check("libmpi" not in linked and "mumps" not in linked, "MPI in bipact: " + linked)


def main():
    if shutil.which("mpirun") is None or not os.access(PROGRAM, os.X_OK):
        print("bipact-mpi is not built: no MPI or MUMPS here")
        sys.exit(77)
    what = sys.argv[1]
    if what in ALONE and MOST < 3:
        print("minutes on a busy machine: RANKS=3 in the environment runs it")
        sys.exit(77)
    if what.startswith("input_"):
        try_decks(what[len("input_") :])
    else:
        {"contact": contact, "restart": restart, "killed": killed, "errors": errors}[what]()
    show("ranks: " + what)
    finish()


main()
