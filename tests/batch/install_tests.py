"""make install into an empty DESTDIR: what is there, its manual pages and completion; every
command that README.md and the pages of doc/ show for users runs from another folder, by its
path and by a link; bipact without bipact-hdf5 says so; make uninstall leaves nothing behind.

A page of doc/ names its files by words in capitals and by the names in PLACES, below."""

import os
import re
import shutil
import subprocess
import sys
import venv

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import BIPACT, ROOT, TMP, check, finish, show

SUFFIX = os.path.basename(BIPACT)[len("bipact") :]  # of the flavour: -debug
PREFIX = "/opt/bi pact"
DEST = os.path.join(TMP, "dest")
TOP = DEST + PREFIX
BIN = os.path.join(TOP, "bin")
SHARE = os.path.join(TOP, "share", "bipact")
WORK = os.path.join(TMP, "work")
LINKS = os.path.join(TMP, "links")
BARE = os.path.join(TMP, "bare")
HDF5 = os.path.exists(BIPACT.replace("bin/bipact", "bin/bipact-hdf5"))

# What stands for a file in the pages: what is there when the commands run.
PLACES = {
    "DECK": "run.k",
    "DIR": "run",
    "RUN": "run",
    "deck.k": "run.k",
    "name=value": "mu=0.1",
    "name=a,b,c": "mu=0.1,0.2",
    "PROBLEM.hdf5": "contact.hdf5",
    "SOLUTION.hdf5": "solution.hdf5",
    "THETA,PAOLI": "THETA,PAOLI",
    "IN": "plate.inp",
    "OUT.k": "other.k",
    "disc.msh": "plate.inp",
    "disc.k": "plate.k",
    "disc_scene.k": "plate_scene.k",
    "disc_scene.out": "plate_scene.out",
    "ball.msh": "block.inp",
    "ball.k": "block.k",
    "ball_scene.k": "block_scene.k",
    "ball_scene.out": "block_scene.out",
}
PLATE = """*NODE
1, 0.0, 0.0
2, 1.0, 0.0
3, 2.0, 0.0
4, 0.0, 1.0
5, 1.0, 1.0
6, 2.0, 1.0
*ELEMENT, TYPE=CPS4, ELSET=plate
1, 1, 2, 5, 4
2, 2, 3, 6, 5
"""
BLOCK = """*NODE
1, 0.0, 0.0, 0.0
2, 1.0, 0.0, 0.0
3, 1.0, 1.0, 0.0
4, 0.0, 1.0, 0.0
5, 0.0, 0.0, 1.0
6, 1.0, 0.0, 1.0
7, 1.0, 1.0, 1.0
8, 0.0, 1.0, 1.0
*ELEMENT, TYPE=C3D8, ELSET=block
1, 1, 2, 3, 4, 5, 6, 7, 8
"""
# Of the tree of sources, which is not installed.
STAYS = (
    "check_style.py collide.py collide_space.py draw_catalogue.py draw_contact.py draw_rows.py "
    "make_cards.py make_doc.sh"
).split()


def call(*command, **options):
    """(exit code, output, messages) of a command."""
    done = subprocess.run(command, capture_output=True, text=True, **options)
    return done.returncode, done.stdout, done.stderr


def make(target):
    """make install or uninstall, into DEST."""
    words = ["FLAVOUR=" + os.environ["FLAVOUR"], "DESTDIR=" + DEST, "PREFIX=" + PREFIX]
    code, output, errors = call("make", "-C", ROOT, target, *words)
    check(code == 0, "make %s: %s%s" % (target, output, errors))


def files(folder):
    """Paths of all files below a folder."""
    return sorted(
        os.path.relpath(os.path.join(where, name), folder)
        for where, _, names in os.walk(folder)
        for name in names
    )


def installed():
    """Programs, pages, completion, scripts, decks; nothing outside PREFIX, nothing secret."""
    make("install")
    check(
        os.listdir(DEST) == ["opt"] and os.listdir(DEST + "/opt") == ["bi pact"], "PREFIX only"
    )
    found = set(files(TOP))
    wanted = {"bin/bipact" + SUFFIX, "share/man/man1/bipact.1"}
    if HDF5:
        wanted |= {"bin/bipact-%s%s" % (name, SUFFIX) for name in ("hdf5", "fclib")}
        wanted.add("share/man/man1/bipact-fclib.1")
    wanted |= {"share/bash-completion/completions/bipact", "share/doc/bipact/LICENSE"}
    wanted |= {"share/bipact/input/" + path for path in files(os.path.join(ROOT, "input"))}
    scripts = os.listdir(os.path.join(ROOT, "scripts"))
    kept = {s for s in scripts if s.endswith(".py") and not s.startswith("collide")}
    wanted |= {"share/bipact/scripts/" + name for name in kept - set(STAYS)}
    check(wanted <= found, "missing: %s" % sorted(wanted - found))
    for path in found:
        mode = os.stat(os.path.join(TOP, path)).st_mode & 0o777
        runs = (
            path.startswith("bin/")
            or path.startswith("share/bipact/scripts/")
            and (os.access(os.path.join(ROOT, "scripts", os.path.basename(path)), os.X_OK))
        )
        check(mode == (0o755 if runs else 0o644), "%s: mode %o" % (path, mode))


def pages():
    """The manual pages name every option that --help names, and are sound."""
    for name in ("bipact", "bipact-fclib")[: 1 + HDF5]:
        path = os.path.join(TOP, "share", "man", "man1", name + ".1")
        with open(path) as file:
            text = file.read().replace("\\-", "-")
        _, output, _ = call(os.path.join(BIN, name + SUFFIX), "--help")
        options = re.findall(r"(?m)^  (\S.*?)  +\S", output)
        check(len(options) > 5, "%s --help names options" % name)
        for option in options:
            check("\n.B %s\n" % option in text, "%s.1 lacks %s" % (name, option))
        for section in ("NAME", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "SEE ALSO"):
            check("\n.SH %s\n" % section in text, "%s.1 lacks %s" % (name, section))
        if shutil.which("groff"):
            code, output, errors = call("groff", "-ww", "-man", "-Tascii", path)
            check(
                code == 0 and not errors and "DECK" in output or name != "bipact",
                "groff: " + errors,
            )


def completed(*words):
    """What bash offers for the last of the words."""
    script = (
        'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _bipact; '
        'printf "%s\\n" "${COMPREPLY[@]}"'
    )
    path = os.path.join(TOP, "share", "bash-completion", "completions", "bipact")
    code, output, errors = call("bash", "-c", script, "bash", path, *words, cwd=WORK)
    check(code == 0 and not errors, "completion: " + errors)
    return set(output.split("\n")) - {""}


def completion():
    program = os.path.join(BIN, "bipact" + SUFFIX)
    wanted = {"--restart", "--check", "--plan", "--quiet", "--keywords", "--help", "--version"}
    check(wanted <= completed(program, "--"), "options: %s" % completed(program, "--"))
    check(completed(program, "--pl") == {"--plan"}, "the rest of an option")
    check(completed(program, "ru") == {"run", "run.k"}, "decks and folders")
    found = completed(program, "run.k", "-D", "")
    check(found == {"tend=", "dt=", "v0=", "mu="}, "parameters: %s" % found)
    check(completed(program, "comma.k", "-D", "m") == {"mu=", "mass="}, "in comma form")
    check(completed(program, "run.k", "--restart", "l") == {"latest"}, "latest")


def prepare():
    """The folder that the commands run in: the deck of the README, one with fields, restart
    files and parameters, a contact problem."""
    os.makedirs(WORK)
    with open(os.path.join(WORK, "first.k"), "w") as file:
        file.write(call(os.path.join(ROOT, "tests", "support", "first_deck.sh"))[1])
    with open(os.path.join(ROOT, "input", "two_bars", "theta.k")) as file:
        text = file.read()
    cards = "*BIPACT_CONTACT\nAUTO,\n,,,,1100\n"
    if HDF5:
        cards += "*BIPACT_FIELD\n0.004,\n*BIPACT_RESTART\n1000,,5\n"
    with open(os.path.join(WORK, "run.k"), "w") as file:
        file.write(text.replace("*END", cards + "*END"))
    shutil.copy(os.path.join(ROOT, "input", "two_bars", "mesh.k"), WORK)
    for name, text in (("plate.inp", PLATE), ("block.inp", BLOCK)):
        with open(os.path.join(WORK, name), "w") as file:
            file.write(text)
    with open(os.path.join(WORK, "comma.k"), "w") as file:
        file.write("*KEYWORD\n*PARAMETER\n$ a comment\nRmu,0.3,Cmass,LUMPED\n*END\n")
    code, _, errors = call(
        os.path.join(BIN, "bipact" + SUFFIX), "run.k", "-o", "run", "--quiet", cwd=WORK
    )
    check(code == 0, "the run with fields and restarts: " + errors)
    if HDF5:
        fclib = os.path.join(BIN, "bipact-fclib" + SUFFIX)
        problem = os.path.join("run", "contact_000001100.txt")
        check(call(fclib, problem, "--convert", "contact.hdf5", cwd=WORK)[0] == 0, "convert")
        check(call(fclib, "contact.hdf5", "-o", "solution.hdf5", cwd=WORK)[0] == 0, "solve")


def shown_commands():
    """(page, command) of all that the pages show and that is for users."""
    names = ["README.md", "input/README.md"]
    names += sorted("doc/" + n for n in os.listdir(ROOT + "/doc") if n.endswith(".md"))
    start = r"(?:\.venv/bin/python )?(?:(?:bin/)?bipact(?:-fclib)? |scripts/\w+\.(?:py|sh)\b)"
    for name in names:
        with open(os.path.join(ROOT, name), encoding="utf-8") as file:
            text = file.read()
        lines = re.findall(r"(?m)^    (%s.*)$" % start, text)
        spans = [s for s in re.findall("`([^`\n]+)`", text) if re.match(start, s)]
        for command in lines + spans:
            command = command.removeprefix(".venv/bin/python ")
            yield name, re.sub(r"\s{2,}#.*|[\s.]+$", "", command)


def runnable(command):
    """Words of a command with files in place of what stands for them; None for one that cannot
    be run here: a synopsis, a script without its arguments, one that stays with the sources."""
    words = command.split()
    if len(words) < 2 or "[" in command or os.path.basename(words[0]) in STAYS:
        return None
    needs_hdf5 = words[0].endswith("fclib") or re.search(
        r"\bRUN\b|--restart|(?:disc|ball)_scene", command
    )
    if needs_hdf5 and not HDF5:
        return None
    for place in sorted(PLACES, key=len, reverse=True):
        words = [
            re.sub(r"(?<![\w.])%s(?![\w.])" % re.escape(place), PLACES[place], w) for w in words
        ]
    return [word for word in words if word != "..."]


def place_of(word):
    """Where a program, script or deck of the tree is installed."""
    if re.match(r"(?:bin/)?bipact", word):
        return os.path.join(BIN, os.path.basename(word) + SUFFIX)
    if word.startswith(("scripts/", "input/")):
        return os.path.join(SHARE, word)
    return word


def commands():
    """Each command twice: by its path with the Python that has the packages, and by a link,
    with one that has none, so that the .venv of the installation is found."""
    os.mkdir(LINKS)
    os.symlink(os.path.realpath(os.path.join(ROOT, ".venv")), os.path.join(SHARE, ".venv"))
    bare = dict(os.environ, PATH=os.path.join(BARE, "bin") + os.pathsep + os.environ["PATH"])
    full = dict(
        os.environ, PATH=os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]
    )
    del bare["BIPACT"], full["BIPACT"]
    seen = {}
    for page, command in shown_commands():
        words = runnable(command)
        if words and tuple(words) not in seen:
            seen[tuple(words)] = page
    seen["scripts/demo.py",] = "make demo"
    check(len(seen) >= (12 if HDF5 else 5), "commands are found: %d" % len(seen))
    for words, page in seen.items():
        what = "%s: %s" % (page, " ".join(words))
        show(what)
        unknown = [w for w in words if re.search(r"\b[A-Z]{3,}\b(?!:)", w)]
        unknown = [w for w in unknown if w not in PLACES.values()]
        check(not unknown, "%s: what do %s stand for? (PLACES)" % (what, unknown))
        path, *rest = map(place_of, words)
        link = os.path.join(LINKS, os.path.basename(path))
        if not os.path.exists(link):
            os.symlink(path, link)
        for program, environment in ((path, full), (link, bare)):
            code, _, errors = call(program, *rest, cwd=WORK, env=environment)
            check(code == 0 and "Traceback" not in errors, "%s: %d %s" % (what, code, errors))


def alone():
    """bipact copied away from bipact-hdf5 runs what needs no fields; else it says which file it
    looked for. A file of that name that cannot be run is told apart."""
    copy = os.path.join(TMP, "alone", "bipact" + SUFFIX)
    os.mkdir(os.path.dirname(copy))
    shutil.copy(os.path.join(BIN, "bipact" + SUFFIX), copy)
    link = os.path.join(LINKS, "other-name")
    os.symlink(copy, link)
    missing = os.path.join(TMP, "alone", "bipact-hdf5" + SUFFIX)
    check(call(link, "first.k", "--quiet", cwd=WORK)[0] == 0, "alone, by a link")
    with open(os.path.join(WORK, "fields.k"), "w") as out:
        with open(os.path.join(WORK, "first.k")) as file:
            out.write(file.read().replace("*END", "*BIPACT_FIELD\n0.01,\n*END"))
    code, _, errors = call(link, "fields.k", "-o", "nothing", cwd=WORK)
    check(code == 3 and 'the program "%s", which is not there' % missing in errors, errors)
    check("beside bipact" in errors and "make install" in errors, errors)
    check(not os.path.exists(os.path.join(WORK, "nothing")), "no folder")
    with open(missing, "w") as file:
        file.write("no program\n")
    code, _, errors = call(link, "fields.k", "-o", "nothing", cwd=WORK)
    check(code == 3 and 'the program "%s", which cannot be started' % missing in errors, errors)


def uninstalled():
    """Nothing is left but what others put there."""
    for path in (os.path.join(SHARE, "input", "mine.k"), os.path.join(BIN, "mine")):
        with open(path, "w"):
            pass
    make("uninstall")
    check(files(TOP) == ["bin/mine", "share/bipact/input/mine.k"], "left: %s" % files(TOP))
    make("uninstall")


installed()
prepare()
venv.create(BARE, symlinks=True)
for test in (pages, completion, commands, alone, uninstalled):
    test()
finish()
