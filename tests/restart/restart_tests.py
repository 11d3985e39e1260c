"""A run that is stopped, killed or starved goes on from its last good restart file as if
nothing had been: every byte of its tables, every number of its fields."""

import glob
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

for folder in ("support", "decks"):
    sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", folder))
import contact_geometry as geometry
import scenes
import walls
from full_disk import on_small_disk, one_message, starved
import stick_slip
from scenes import BIPACT, TMP, at_most, bipact, check, finish, make_bars, show

import fields
import make_scenes
import mortar

HDF5 = re.sub(r"bipact([^/]*)$", r"bipact-hdf5\1", BIPACT)
RESTART = "*BIPACT_RESTART\n%10d%10s%10d\n"
EVERY_FIELD = "*BIPACT_FIELD\n%10.3e\n       ALL\n"


def scene(name):
    """A deck's text: two bars with and without friction, massless nodes, a wall, a block."""
    path = os.path.join(TMP, "scene-%s.k" % name)
    bars = dict(nx=20, ny=2, courant=0.5, touch=0.5)
    if name == "smooth":
        make_bars.write(path, **bars)
    elif name == "friction":
        make_bars.write(path, mu=0.3, slide=0.3, poisson=0.3, **bars)
    elif name == "massless":
        make_bars.write(path, mass="DISPERSION", redist=1, **bars)
    elif name == "newmark":
        make_bars.write(path, scheme="NEWMARK", mu=0.2, slide=0.2, **bars)
    elif name.startswith("near"):
        mass = "LUMPED" if name == "near-lumped" else "CONSISTENT"
        make_bars.write(path, mu=0.3, slide=0.3, poisson=0.3, mass=mass, **bars)
        with open(path) as file:
            return with_cards(file.read(), "*BIPACT_CONTACT\n\nBLOCK\n")
    elif name == "lumped":
        make_bars.write(path, mass="LUMPED", **bars)
    elif name == "explicit":
        make_bars.write(path, scheme="PAOLI", pbeta=0.0, mass="LUMPED", mu=0.3, slide=0.3, **bars)
    elif name == "asleep":
        make_bars.write(path, **dict(bars, touch=100.5))
    elif name == "wall":
        make_scenes.write(path, "wall", n=20, mu=0.2)
    elif name == "block":
        make_scenes.write(path, "sliding", n=3, tend=0.1, courant=2.0)
    elif name == "pushed":
        make_scenes.write(path, "pushed", n=3, tend=0.4, courant=8.0)
    elif name == "stick-slip":
        return stick_slip.oscillator(0.02, "THETA,0.55,0.55", tend=9.0)
    elif name.startswith("damped"):
        scheme = "NEWMARK" if name == "damped-newmark" else "THETA"
        make_bars.write(path, scheme=scheme, mu=0.2, slide=0.2, **bars)
        with open(path) as file:
            return with_cards(file.read(), DAMPING)
    with open(path) as file:
        return file.read()


# A coefficient that changes in every step until the bars touch, then stands; K of one bar.
DAMPING = (
    "*DEFINE_CURVE\n77,\n0.0,0.0\n0.01,20.0\n0.02,20.0\n1.0,30.0\n"
    "*DAMPING_PART_MASS\n1,77,2.0\n*DAMPING_PART_STIFFNESS\n2,-1e-4\n"
)
SCENES = (
    "smooth friction massless newmark lumped explicit asleep wall block pushed damped "
    "damped-newmark stick-slip near near-lumped".split()
)


def with_cards(text, cards):
    """A deck with more cards before its end."""
    assert "*END" in text
    return text.replace("*END", cards + "*END")


def steps_of(folder):
    """Steps of a run, from its log."""
    with open(os.path.join(folder, "bipact.log")) as log:
        return int(re.search(r"^steps (\d+),", log.read(), re.M).group(1))


def contents(folder):
    """All that must be equal: bytes of the tables but TIMING, frames of the fields, warnings of
    a log with their counts, the number of factorisations."""
    out = {}
    with open(os.path.join(folder, "bipact.log")) as log:
        text = log.read()
    out["warnings"] = re.findall(r"(?m)^(?:WARNING|  \d+ x) .*", text)
    out["factors"] = re.findall(r"(?m)^factorisations \d+", text)
    for path in glob.glob(os.path.join(folder, "*.tab")):
        if not path.endswith("timing.tab"):
            with open(path, "rb") as file:
                out[os.path.basename(path)] = file.read()
    if glob.glob(os.path.join(folder, "fields.*.vtkhdf")):
        run = fields.Fields(folder)
        out["times"] = run.times.tobytes()
        for name in run.names:
            for k in range(len(run.times)):
                out[name, k] = run.frame(k, name).tobytes()
    return out


def differences(one, other):
    """Names of what is not the same."""
    return sorted(str(k) for k in set(one) | set(other) if one.get(k) != other.get(k))


def write_deck(name, text):
    path = os.path.join(TMP, name + ".k")
    with open(path, "w") as file:
        file.write(text)
    return path


def restart_files(folder):
    return sorted(glob.glob(os.path.join(folder, "restart.*.h5")))


def bitwise():
    """For every scheme and mass, with and without friction, before, in and after contact, with
    the search asleep, at walls, with loads: a run that goes on from each of its restart files is
    the whole run."""
    for name in SCENES:
        plain = scene(name)
        folder = os.path.join(TMP, name)
        code, errors, _ = bipact(write_deck(name, plain), folder, "--quiet")
        steps = steps_of(folder)
        before = contents(folder)
        step = time_of_step(folder)
        cards = RESTART % (max(1, steps // 7), "", 99) + EVERY_FIELD % (5.2 * step)
        deck = write_deck(name, with_cards(plain, cards))
        code, errors, _ = bipact(deck, folder, "--quiet")
        check(code == 0, "%s: %s" % (name, errors))
        whole = contents(folder)
        changed = [k for k in before if before[k] != whole.get(k)]
        check(not changed, "%s: restart files change %s" % (name, changed))
        go_on_from_each(name, deck, folder, whole)
    # Motions that begin and end, reactions, loads, walls, a last step that is cut; every scheme.
    runs = [("THETA", ["-D", "tend=0.01985"]), ("THETA", ["-D", "mu=0.0"])]
    for scheme, more in runs + [(name, []) for name in scenes.words_of("SCHEME")]:
        text, options = scenes.every_keyword(scheme)
        comments = r"(?:\$[^\n]*\n)*"
        text, one = re.subn(r"(\*BIPACT_RESTART\n%s).*" % comments, r"\g<1>        17,,99", text)
        text, two = re.subn(r"(\*BIPACT_FIELD\n%s).*" % comments, r"\g<1>    0.0007", text)
        check(one == 1 and two == 1, "the cards of restarts and fields are there")
        deck, folder = write_deck("every", text), os.path.join(TMP, "every")
        code, errors, _ = bipact(deck, folder, "--quiet", *options, *more)
        check(code == 0, "every keyword: " + errors)
        go_on_from_each("every keyword", deck, folder, contents(folder), *options, *more)


def contact():
    """The same for contact of every kind: corners, two edges at a node, an edge pressed in,
    several cards, all bodies in one card, a body with itself, an open obstacle, forces on
    nodes, a wall with rounding taken as a touch, late rows, a purse that is short in the very
    step that a file stands before or behind."""
    for name, scene in (
        ("corner", geometry.corner_on_edge(mu=0.3)),
        ("L", geometry.corner_of_l((4, 3), (-3.0, -2.0), 0.3)),
        ("groove", geometry.v_groove(0.0, 1, 0.07)),
        ("slider", geometry.pressed_slider()),
        ("two floors", geometry.two_floors(0.3)),
        ("three bodies", geometry.three_bodies()),
        ("U", geometry.closing_u()),
        ("open", geometry.open_floor("segments")),
        ("glued", geometry.glued()),
        ("inclined", geometry.inclined()),
        ("mortar", mortar.thrown("B,,,,MORTAR", steps=120)),
        ("mortar, corner", mortar.thrown("A,,,,MORTAR", 0.3, 0.2, (0.2, -1.5), steps=400)),
    ):
        text = with_cards(scene.text(), RESTART % (scene.steps // 6, "", 9))
        if name != "glued":  # it has fields of its own
            text = with_cards(text, EVERY_FIELD % (10.3 * scene.dt))
        deck, folder = write_deck(name, text), os.path.join(TMP, name)
        code, errors, _ = bipact(deck, folder, "--quiet")
        check(code == 0, "%s: %s" % (name, errors))
        force = scenes.table(folder, "rwforc" if name == "inclined" else "rcforc")["fn"]
        check((force > 0.0).any(), name + ": it touches")
        go_on_from_each(name, deck, folder, contents(folder))
    short_purse()


def rigid_walls():
    """The same at walls of every shape, at rest and moving, with friction: schemes on positions and
    velocities, of one stage and two, with both ends of a step; steps cut at a touch."""
    cuts = "*BIPACT_STEP\nEVENT,\n"
    others = ("NEWMARK,", ""), ("MOREAU,0.5", ""), ("PAOLI,", ""), ("NSGENALPHA,", "")
    for number, kind in enumerate(walls.KINDS):
        for scheme, cards in (("THETA,0.5", cuts * (number % 2)), others[number % 4]):
            block, text = walls.thrown(kind, scheme, steps=400)
            text = with_cards(text, RESTART % (63, "", 9) + EVERY_FIELD % (41 * block.dt) + cards)
            name = "%s %s%s" % (kind, scheme.split(",")[0], " cut" if cards else "")
            deck, folder = write_deck(name.replace(" ", "-"), text), os.path.join(TMP, "walls")
            code, errors, _ = bipact(deck, folder, "--quiet")
            check(code == 0, "%s: %s" % (name, errors))
            whole = contents(folder)
            go_on_from_each(name, deck, folder, whole)


def steps():
    """The same from within a step that is halved, and from the touch at which one is cut: a
    restart file after every step, with every scheme of one step, with motions that begin and
    end, from a static phase."""
    cuts = "*BIPACT_STEP\nEVENT,\n"
    halves = "*BIPACT_STEP\nHALVE,\n*BIPACT_CONTACT\nGS,,%d\n"
    for scheme in ("THETA,0.5", "NEWMARK,", "GENALPHA,"):
        for name, scene, times, cards in (
            ("cut corner", geometry.corner_on_edge(mu=0.3), 10, cuts),
            ("cut bodies", geometry.three_bodies(0.6), 20, cuts),
            ("halved L", geometry.corner_of_l((4, 3), (-3.0, -2.0), 0.6), 10, halves % 12),
            ("halved bodies", geometry.three_bodies(0.6), 20, halves % 100),
            ("halved slider", geometry.pressed_slider(), 80, "*BIPACT_STEP\nHALVE,\n"),
        ):
            if name in ("halved bodies", "halved slider") and scheme != "THETA,0.5":
                continue  # the one fails, the other halves no step
            name += " " + scheme
            count = scene.steps // times
            scene.dt, scene.steps, scene.scheme = scene.dt * scene.steps / count, count, scheme
            scene.every = scene.dt / 1000
            text = with_cards(scene.text().replace("STOP", "WARN"), cards + RESTART % (1, "", 99))
            deck, folder = write_deck("steps", text), os.path.join(TMP, "steps")
            code, errors, _ = bipact(deck, folder, "--quiet")
            check(code == 0, "%s: %s" % (name, errors))
            length = scenes.table(folder, "glstat")["dt"]
            kinds = len(set(np.round(np.log2(length), 9)))
            check(kinds > 1, name + ": all steps are equal")
            show("%s: %d steps of %d lengths" % (name, len(length) - 1, kinds))
            go_on_from_each(name, deck, folder, contents(folder))
    path = os.path.join(os.environ["ROOT"], "input", "cards", "every_keyword.k")
    with open(path) as file:
        text = file.read()
    comments = r"(?:\$[^\n]*\n)*"
    text, one = re.subn(r"(\*BIPACT_RESTART\n%s).*" % comments, r"\g<1>         9,,99", text)
    text, two = re.subn(r"(\*CONTROL_IMPLICIT_DYNAMICS\n%s).*" % comments, r"\g<1>1,,,0.002", text)
    # What moves freely has no place in the static phase: a wall, a rigid part.
    free = r"(?m)^\*(?:RIGIDWALL_PLANAR_MOVING|LOAD_RIGID_BODY)\n(?:[^*].*\n)*"
    text, gone = re.subn(free, "", text)
    check(one == two == 1 and gone == 2, "the cards of restarts, of inertia, of free bodies")
    text = text.replace("       1.0         1         0\n", "       1.0         4         0\n")
    deck, folder = write_deck("every", text), os.path.join(TMP, "every")
    for scheme in ("THETA", "NEWMARK"):
        options = ["-D", "mode=EVENT", "-D", "scheme=" + scheme]
        code, errors, _ = bipact(deck, folder, "--quiet", *options)
        check(code == 0, "every keyword: " + errors)
        go_on_from_each("every keyword", deck, folder, contents(folder), *options)


def short_purse():
    """Restart files all over a run whose purse is short in some steps; runs that end there tell
    how many of these came before."""
    scene = geometry.pressed_flat()
    deck = write_deck("short", with_cards(scene.text(), RESTART % (8, "", 99)))
    folder = os.path.join(TMP, "short")
    code, errors, _ = bipact(deck, folder, "--quiet")
    check(code == 0, "short purse: " + errors)
    go_on_from_each("short purse", deck, folder, contents(folder))
    steps, beside = scene.steps, 0
    for cycle in range(8, steps, 8):
        count = []
        for scene.steps in (cycle - 1, cycle + 1):
            other = scenes.run_text("shorter", scene.text(), "--quiet")[0]
            count.append(geometry.counted(other, "steps with a short purse"))
        beside += count[1] > count[0]
    show("restart files beside a step with a short purse: %d" % beside)
    check(beside > 0, "no restart file is beside a step with a short purse")


def go_on_from_each(name, deck, folder, whole, *options):
    """From each restart file of a run, in a copy of its folder, to the whole run."""
    files = restart_files(folder)
    check(len(files) >= 5, "%s: %d restart files" % (name, len(files)))
    for file in files:
        copy = os.path.join(TMP, "copy")
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(folder, copy)
        file = os.path.join(copy, os.path.basename(file))
        code, errors, _ = bipact(deck, copy, "--quiet", "--restart", file, *options)
        check(code == 0, "%s from %s: %s" % (name, os.path.basename(file), errors))
        off = differences(whole, contents(copy))
        check(not off, "%s from %s: %s" % (name, os.path.basename(file), off[:5]))


def time_of_step(folder):
    """Length of a step, from the log."""
    with open(os.path.join(folder, "bipact.log")) as log:
        text = log.read()
    return float(re.search(r"^  steps .* of (\S+)$", text, re.M).group(1))


def killed(command, moment):
    """Runs a command and kills it: after some seconds, or as soon as a path is there."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if isinstance(moment, str):
        while child.poll() is None and not os.path.exists(moment):
            pass
    else:
        time.sleep(moment)
    child.kill()
    child.wait()


def kills():
    """SIGKILL at random moments, some inside the write of a restart file (it is there under its
    other name), some inside that of a field file (it is there and grows): the run goes on, or
    starts anew where it had no restart file yet, and is the whole run."""
    random.seed(4711)
    count = int(os.environ.get("KILLS", "50"))
    names = ["smooth", "friction", "massless", "newmark", "block"]
    total = resumed = 0
    for name in names:
        plain = scene(name)
        folder = os.path.join(TMP, name)
        bipact(write_deck(name, plain), folder, "--quiet")
        steps, step = steps_of(folder), time_of_step(folder)
        cards = RESTART % (max(1, steps // 10), "", 2) + EVERY_FIELD % step
        deck = write_deck(name, with_cards(plain, cards))
        start = time.time()
        bipact(deck, folder, "--quiet")
        seconds = time.time() - start
        whole = contents(folder)
        for k in range(count // len(names)):
            shutil.rmtree(folder, ignore_errors=True)
            moment = random.uniform(0.0, 1.1 * seconds)
            if k % 5 == 3:
                moment = os.path.join(folder, "restart.tmp")
            if k % 5 == 4:
                moment = os.path.join(folder, "fields.%03d.vtkhdf" % random.randint(0, 8))
            killed([BIPACT, deck, "-o", folder, "--quiet"], moment)
            options = ["--restart", "latest"] if restart_files(folder) else []
            resumed += len(options) > 0
            code, errors, _ = bipact(deck, folder, "--quiet", *options)
            check(code == 0, "%s, kill %d: %s" % (name, k, errors))
            off = differences(whole, contents(folder))
            check(not off, "%s, kill %d: %s" % (name, k, off[:5]))
            total += 1
    show("%d kills, %d runs had a restart file and went on from it" % (total, resumed))
    check(resumed > total // 4, "%d of %d kills came after a restart file" % (resumed, total))


def long_run(cards=""):
    """A deck that runs for some seconds, and a step of it."""
    path = os.path.join(TMP, "long.k")
    meta = make_bars.write(path, nx=80, ny=8, courant=0.0125, touch=0.5, mu=0.2, slide=0.2)
    with open(path) as file:
        text = file.read()
    write_deck("long", with_cards(text, cards))
    return path, meta["dt"]


def started(deck, folder, *options):
    """Starts a run and waits until its log is there and a moment more."""
    shutil.rmtree(folder, ignore_errors=True)
    child = subprocess.Popen(
        [BIPACT, deck, "-o", folder, "--quiet"] + list(options),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while child.poll() is None and not os.path.exists(os.path.join(folder, "bipact.log")):
        time.sleep(0.01)
    time.sleep(0.2)
    return child


def ended(child):
    """(exit code, standard error) of a run."""
    _, errors = child.communicate(timeout=120)
    return child.returncode, errors


def signals():
    """SIGTERM and SIGINT: a restart file, exit code 4, and the run goes on to the same end.
    SIGUSR1: a restart file, and the run is not disturbed. ONSIG 0 and no card: no file."""
    folder = os.path.join(TMP, "signals")
    deck, step = long_run(RESTART % (0, "", 2) + EVERY_FIELD % 1.0e-3)
    code, errors, _ = bipact(deck, folder, "--quiet")
    check(code == 0, errors)
    whole = contents(folder)
    for number in (signal.SIGTERM, signal.SIGINT):
        child = started(deck, folder)
        child.send_signal(number)
        code, errors = ended(child)
        check(
            code == 4 and "stopped by a signal" in errors, "%s: %d %s" % (number, code, errors)
        )
        check(len(restart_files(folder)) == 1, "%s: one restart file" % number)
        with open(os.path.join(folder, "glstat.tab")) as file:
            check("# end: stopped" in file.read(), "the table says so")
        code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
        check(code == 0, errors)
        check(not differences(whole, contents(folder)), "%s: the same end" % number)
    child = started(deck, folder)
    child.send_signal(signal.SIGUSR1)
    code, errors = ended(child)
    check(code == 0, "SIGUSR1: the run goes on: %d %s" % (code, errors))
    check(len(restart_files(folder)) == 2, "SIGUSR1: one restart file, and that of the end")
    check(not differences(whole, contents(folder)), "SIGUSR1: the same end")
    deck, step = long_run("*BIPACT_RESTART\n         0                             0\n")
    child = started(deck, folder)
    child.send_signal(signal.SIGTERM)
    code, errors = ended(child)
    check(code == 4 and not restart_files(folder), "ONSIG 0: no file")
    deck, step = long_run("*BIPACT_RESTART\n         0       0.1         3\n")
    child = started(deck, folder)
    code, errors = ended(child)
    found = len(restart_files(folder))
    check(code == 0 and found == 3, "WALL: %d files are kept, expected 3" % found)


def fletcher(data):
    """The checksum of restart files, computed apart."""
    modulus = 4294967291
    data = data + b"\0" * (-len(data) % 4)
    one = two = 0
    for word in np.frombuffer(data, "<u4").tolist():
        one += word
        two += one
    return b"%08X%08X" % (two % modulus, one % modulus)


def refused():
    """Damaged, cut, foreign, older files and those of another deck: exit 3 with the reason, and
    the folder as it was. "latest" takes the newest good one."""
    folder = os.path.join(TMP, "refused")
    deck = write_deck("refused", with_cards(scene("friction"), RESTART % (20, "", 9)))
    code, errors, _ = bipact(deck, folder, "--quiet")
    whole = contents(folder)
    files = restart_files(folder)
    check(code == 0 and len(files) >= 3, "restart files are there")
    with open(files[-1], "rb") as file:
        good = file.read()
    head, rest = good[:512], good[512:]
    check(head[400:416] == fletcher(head[:400]), "the checksum of the first bytes")
    check(fletcher(rest) in head, "the checksum of the rest")
    random.seed(4711)
    cases = [(b"", "it is no restart file"), (b"*KEYWORD\n*END\n", "it is no restart file")]
    other = os.path.join(TMP, "other.h5")
    with h5py.File(other, "w") as file:
        file["archive/0001 x"] = np.zeros(3)
    with open(other, "rb") as file:
        cases.append((file.read(), "it is no restart file"))
    for k in range(60):
        at, bit = random.randrange(14, len(good)), random.randrange(8)
        wrong = bytearray(good)
        wrong[at] ^= 1 << bit
        cases.append((bytes(wrong), "damaged"))
    for k in range(10):
        cases.append((good[: random.randrange(600, len(good))], "cut off"))
    cases.append((good + b"more", "cut off or added to"))

    def relabelled(old, new):
        text = head[:400].replace(old, new)
        assert text != head[:400] and len(text) == 400
        return text + fletcher(text) + head[416:] + rest

    number = re.search(rb"format +\d+", head).group()
    cases.append((relabelled(number, number[:-1] + b"9"), "its format is"))
    version = re.search(rb"version (\S+)", head).group(1)
    cases.append((relabelled(version, b"0" * len(version)), "of bipact wrote it"))
    cases.append(
        (relabelled(re.search(rb"deck (\S+)", head).group(1), b"0" * 16), "its deck is not")
    )
    path = os.path.join(TMP, "bad.h5")
    for data, reason in cases:
        with open(path, "wb") as file:
            file.write(data)
        code, errors, _ = bipact(deck, folder, "--quiet", "--restart", path)
        check(code == 3 and reason in errors, "expected %s: %d %s" % (reason, code, errors))
    check(not differences(whole, contents(folder)), "the folder is as it was")
    lonely = os.path.join(TMP, "bipact")
    shutil.copy(BIPACT, lonely)
    done = subprocess.run([lonely, deck, "-o", folder], capture_output=True, text=True)
    words = 'need the program "%s"' % os.path.join(TMP, "bipact-hdf5")
    check(done.returncode == 3 and words in done.stderr, "without HDF5: " + done.stderr)
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "nowhere.h5")
    check(code == 3 and "no such file" in errors, errors)
    with open(files[-1], "wb") as file:
        file.write(good[:-7])
    with open(files[-2], "r+b") as file:
        file.seek(700)
        file.write(b"damage")
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    check(code == 0, "latest: %s" % errors)
    check(not differences(whole, contents(folder)), "latest: the newest good one")
    with open(os.path.join(folder, "bipact.log")) as log:
        text = log.read()
    check(
        os.path.basename(files[-3]) in text and "checksum" in text,
        "the log tells which, and why",
    )
    lost_rows(deck, folder, whole)
    cut_fields()
    code, errors, _ = bipact(deck, os.path.join(TMP, "empty"), "--restart", "latest")
    check(code == 3 and "no restart file" in errors, errors)
    count = len(restart_files(folder))
    with open(os.path.join(folder, "rcforc.tab"), "w") as file:
        file.write("short\n")
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", restart_files(folder)[0])
    check(code == 3 and "lost rows" in errors, errors)
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    check(code == 3 and "none of the %d restart files" % count in errors, errors)
    check(len(restart_files(folder)) == count, "a refused restart removes nothing")
    check(not os.path.exists(os.path.join(folder, "deck.echo.tmp")), "nor leaves anything")


def lost_rows(deck, folder, whole):
    """A table whose end did not reach the disk, as after a loss of power: latest goes back to a
    restart file from before that."""
    table = os.path.join(folder, "glstat.tab")
    os.truncate(table, int(0.6 * os.path.getsize(table)))
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    check(code == 0, "lost rows: %s" % errors)
    check(not differences(whole, contents(folder)), "lost rows: the same end")
    with open(os.path.join(folder, "bipact.log")) as log:
        text = log.read()
    check("lost rows" in text, "lost rows: the log tells")
    check(os.path.basename(restart_files(folder)[-1]) in text, "lost rows: and of which file")


def cut_fields():
    """A field file that was cut short, emptied or overwritten: latest goes back to a restart file
    from before it, and ends as the run did."""
    folder = os.path.join(TMP, "cut")
    cards = RESTART % (20, "", 9) + EVERY_FIELD % 1.0e-2
    deck = write_deck("cut", with_cards(scene("friction"), cards))
    code, errors, _ = bipact(deck, folder, "--quiet")
    whole = contents(folder)
    path = os.path.join(folder, "fields.002.vtkhdf")
    check(code == 0 and len(restart_files(folder)) > 4 and os.path.exists(path), "segments")
    for size in (os.path.getsize(path) // 2, 0):
        os.truncate(path, size)
        code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
        check(code == 0, "cut fields: %s" % errors)
        check(not differences(whole, contents(folder)), "cut fields: the same end")
        with open(os.path.join(folder, "bipact.log")) as log:
            check("has lost frames" in log.read(), "cut fields: the log tells")


def whole_rows(folder):
    """No table ends within a row."""
    for path in glob.glob(os.path.join(folder, "*.tab")):
        with open(path, "rb") as file:
            lines = file.read().split(b"\n")
        rows = [len(line) for line in lines[:-1] if not line.startswith(b"#")]
        check(len(set(rows)) <= 1 and not lines[-1], "%s: whole rows" % os.path.basename(path))


def faults():
    """Disk full (a limit on the size of files), folders read-only or gone, files that cannot be
    made, memory: one message, exit 3, whole rows only, and the last restart file still good."""
    # The run-time library gives up the buffer of a file whose last write failed.
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"
    folder = os.path.join(TMP, "faults")
    cards = RESTART % (20, "", 9)
    text = scene("friction")
    deck = write_deck("tables", text)
    code, errors, _ = bipact(deck, folder, "--quiet")
    largest = max(os.path.getsize(p) for p in glob.glob(os.path.join(folder, "*.tab")))
    shutil.rmtree(folder)
    code, errors = starved(deck, folder, bytes_of_file=largest // 2)
    one_message(code, errors, "cannot write", "disk full, tables")
    whole_rows(folder)
    deck = write_deck("restarts", with_cards(text, cards))
    bipact(deck, folder, "--quiet")
    whole = contents(folder)
    size = os.path.getsize(restart_files(folder)[0])
    if size > largest:
        code, errors = starved(deck, folder, bytes_of_file=size // 2)
        one_message(code, errors, "cannot write", "disk full, restart file")
        check(not restart_files(folder), "disk full: no half restart file")
        check(
            not os.path.exists(os.path.join(folder, "restart.tmp")), "nor what was to become it"
        )
    deck_f = write_deck("fields", with_cards(text, RESTART % (20, "", 9) + EVERY_FIELD % 1e-9))
    bipact(deck_f, folder, "--quiet")
    whole_f = contents(folder)
    code, errors = starved(deck_f, folder, bytes_of_file=max(size, largest) + 20000)
    if code != 0:
        one_message(code, errors, "cannot write", "disk full, fields")
        if restart_files(folder):
            code, errors, _ = bipact(deck_f, folder, "--quiet", "--restart", "latest")
            check(code == 0, "after a full disk: %s" % errors)
            check(not differences(whole_f, contents(folder)), "after a full disk: the same end")
    starved_fields(folder)
    full_disk(deck_f, whole_f)
    gone(folder)
    unwritable(deck, deck_f, folder, whole)
    memory(folder)


def starved_fields(folder):
    """Field files at every stage of their making: the library must not fall over what it could
    not write, and what is left can be opened."""
    path = os.path.join(TMP, "sliding.k")
    limits = {6: (15_000, 40_000, 80_000, 150_000, 300_000), 40: (6_000_000, 9_800_000)}
    for n, limit in [(n, limit) for n in limits for limit in limits[n]]:
        make_scenes.write(path, "sliding", n=n, tend=1.0, courant=4.0)
        with open(path) as file:
            deck = write_deck("sliding", with_cards(file.read(), EVERY_FIELD % 0.02))
        shutil.rmtree(folder, ignore_errors=True)
        code, errors = starved(deck, folder, bytes_of_file=limit)
        if code == 0:
            continue
        one_message(code, errors, "cannot write", "field file of %d bytes" % limit)
        for left in glob.glob(os.path.join(folder, "fields.*")):
            check(not left.endswith(".tmp"), "%s is left" % left)
            if left.endswith(".vtkhdf"):
                with h5py.File(left, "r") as file:
                    group = file["VTKHDF"]
                    frames = group["Steps"].attrs["NSteps"]
                    rows = group["PointData/U"].shape[0]
                    check(
                        rows >= frames * group["Points"].shape[0], "frames that are not there"
                    )


def full_disk(deck, whole):
    """The same on a small file system, where one can be made."""
    copy = os.path.join(TMP, "large")
    done = on_small_disk("600k", deck, copy)
    if done is None:
        print("note: no small file system can be mounted here: NOT tested on one")
        return
    one_message(*done, "cannot write", "small disk")
    whole_rows(copy)
    if restart_files(copy):
        code, errors, _ = bipact(deck, copy, "--quiet", "--restart", "latest")
        check(code == 0, "from a small disk to a large one: %s" % errors)
        check(not differences(whole, contents(copy)), "the same end")


def gone(folder):
    """The folder is removed while the run writes to it."""
    for cards, words in (
        ("", "was removed while the run wrote it"),
        (RESTART % (50, "", 2), "cannot"),
        (EVERY_FIELD % 1.0e-2, "cannot"),
    ):
        deck, step = long_run(cards)
        child = started(deck, folder)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(folder, ignore_errors=True)
        code, errors = ended(child)
        check(
            code == 3 and words in errors or "removed" in errors, "gone: %d %s" % (code, errors)
        )
        check(errors.count("bipact: ") == 1, "gone: one message: %s" % errors)


def unwritable(deck, deck_fields, folder, whole):
    """Files and folders in the way."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "glstat.tab"))
    code, errors, _ = bipact(deck, folder, "--quiet")
    one_message(code, errors, "glstat.tab", "a folder in the place of a table")
    shutil.rmtree(folder)
    os.makedirs(os.path.join(folder, "fields.000.vtkhdf", "x"))
    code, errors, _ = bipact(deck_fields, folder, "--quiet")
    one_message(code, errors, "fields.000.vtkhdf", "a folder in the place of a field file")
    shutil.rmtree(folder)
    os.makedirs(os.path.join(folder, "restart.tmp", "x"))
    code, errors, _ = bipact(deck, folder, "--quiet")
    one_message(code, errors, "restart.tmp", "a folder in the place of a restart file")
    shutil.rmtree(folder)
    bipact(deck, folder, "--quiet")
    os.remove(os.path.join(folder, "glstat.tab"))
    os.makedirs(os.path.join(folder, "glstat.tab"))
    code, errors, _ = bipact(deck, folder, "--quiet", "--restart", "latest")
    one_message(code, errors, "glstat.tab", "a table made unwritable before going on")
    check(len(restart_files(folder)) > 0, "the restart files are still there")
    with open(os.path.join(TMP, "file"), "w"):
        pass
    code, errors, _ = bipact(deck, os.path.join(TMP, "file", "x"), "--quiet")
    one_message(code, errors, "cannot make or write the folder", "a folder below a file")
    if os.geteuid() == 0:
        print("note: the superuser may write everywhere: read-only folders NOT tested")
        return
    closed = os.path.join(TMP, "closed")
    os.makedirs(closed)
    os.chmod(closed, 0o555)
    code, errors, _ = bipact(deck, closed, "--quiet")
    one_message(code, errors, "cannot make or write the folder", "read-only folder")
    shutil.rmtree(folder)
    deck_long, step = long_run(RESTART % (50, "", 2))
    child = started(deck_long, folder)
    os.chmod(folder, 0o555)
    code, errors = ended(child)
    os.chmod(folder, 0o755)
    one_message(code, errors, "cannot", "a folder closed during the run")


def memory(folder):
    """Not enough memory for the scene, wherever it ends: reading, METIS, the matrix."""
    if "sanitize" in BIPACT:
        print("note: the sanitizer needs more memory than the limit: NOT tested")
        return
    deck = os.path.join(TMP, "large.k")
    make_bars.write(deck, nx=400, ny=100)
    code, errors = starved(deck, folder, bytes_of_memory=60_000_000)
    one_message(code, errors, "not enough memory", "memory")
    make_bars.write(deck, nx=200, ny=60, tend=1.0e-6)
    for megabytes in range(34, 66, 3):
        code, errors = starved(deck, folder, bytes_of_memory=megabytes * 1_000_000)
        if "shared libraries" in errors:
            continue
        if code != 0:
            one_message(code, errors, "not enough memory", "%d MB" % megabytes)


if __name__ == "__main__":
    if not os.path.exists(HDF5):
        print("%s is not built: restarts NOT tested" % HDF5)
        sys.exit(77)
    globals()[sys.argv[1]]()
    finish()
