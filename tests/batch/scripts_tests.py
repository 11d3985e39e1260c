"""Every script of scripts/: executable with its shebang, --help and a short run from another
folder by a link, started with a Python that has no packages; a reader that has gone is no
traceback; where there is no .venv the message names the package and the remedy."""

import os
import re
import shutil
import signal
import subprocess
import sys
import venv

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import ROOT, TMP, check, finish

SCRIPTS = os.path.join(ROOT, "scripts")
BARE = os.path.join(TMP, "bare")  # a Python without packages, first in the PATH
ENVIRONMENT = dict(os.environ, PATH=os.path.join(BARE, "bin") + os.pathsep + os.environ["PATH"])


def call(*command, **options):
    """(exit code, output, messages) of a command in TMP/elsewhere."""
    options = dict(dict(stdout=subprocess.PIPE, env=ENVIRONMENT), **options)
    done = subprocess.run(
        command,
        cwd=os.path.join(TMP, "elsewhere"),
        stderr=subprocess.PIPE,
        text=True,
        **options
    )
    return done.returncode, done.stdout, done.stderr


def to_nobody(*command):
    """(exit code, messages) of a command whose output nobody reads."""
    reader, writer = os.pipe()
    os.close(reader)
    code, _, errors = call(*command, stdout=writer)
    os.close(writer)
    return code, errors


def programs():
    """(name, text) of the Python scripts that can be started."""
    for name in sorted(os.listdir(SCRIPTS)):
        with open(os.path.join(SCRIPTS, name), encoding="utf-8") as file:
            text = file.read()
        runs = os.access(os.path.join(SCRIPTS, name), os.X_OK)
        starts = "__main__" in text and name.endswith(".py") and name != "startup.py"
        if name.endswith((".py", ".sh")):
            check(
                runs == text.startswith("#!"), "%s: shebang and executable, or neither" % name
            )
            check(runs or not starts, "%s: can be started, so it is executable" % name)
        if not starts:
            continue
        check(text.startswith("#!/usr/bin/env python3\n"), "%s: shebang" % name)
        first = re.search(r"(?m)^(?:import|from) (startup|numpy|matplotlib|h5py)", text)
        check(first and first.group(1) == "startup", "%s: begins with startup" % name)
        yield name, text


def help_of_all():
    """--help by a link from another folder, with the Python that has no packages."""
    for name, _ in programs():
        link = os.path.join(TMP, "link-" + name)
        os.symlink(os.path.join(SCRIPTS, name), link)
        code, output, errors = call(link, "--help")
        check(code == 0 and not errors, "%s --help: %d %s" % (name, code, errors))
        check(output.startswith("usage: ") and len(output) > 60, "%s: %s" % (name, output[:60]))
        code, errors = to_nobody(link, "--help")
        check(code == -signal.SIGPIPE and not errors, "%s to nobody: %s" % (name, errors))


def long_output():
    """As `| head -n 1` reads: the first line, silence."""
    script = os.path.join(SCRIPTS, "analytic.py")
    pipe = 'set -o pipefail; "$0" --rows 20000 | head -n 1'
    code, output, errors = call("bash", "-c", pipe, script)
    check(code == 128 + signal.SIGPIPE and not errors, "head: %d %s" % (code, errors))
    check(output.count("\n") == 1, "one line")


def without_venv():
    """A tree without .venv: a script of the standard library alone runs, another one says what
    it misses; with a .venv it is found; an error that is no missing package is shown whole."""
    tree = os.path.join(TMP, "tree")
    shutil.copytree(SCRIPTS, os.path.join(tree, "scripts"))
    shutil.copy(os.path.join(ROOT, "requirements.txt"), tree)
    script = os.path.join(tree, "scripts", "tables.py")
    code, _, errors = call(os.path.join(tree, "scripts", "make_bars.py"), "--nx", "2")
    check(code == 0 and not errors, "the standard library: " + errors)
    code, _, errors = call(script, "--help")
    check(code == 1 and errors.startswith('tables.py: the Python package "numpy"'), errors)
    check(os.path.join(tree, "scripts", "setup-venv.sh") in errors, "the remedy: " + errors)
    check("Traceback" not in errors, errors)
    os.symlink(os.path.realpath(os.path.join(ROOT, ".venv")), os.path.join(tree, ".venv"))
    code, output, errors = call(script, "--help")
    check(code == 0 and output.startswith("usage: "), "the .venv of the tree: " + errors)
    with open(os.path.join(tree, "scripts", "broken.py"), "w") as file:
        file.write("import startup\nimport nowhere\n")
    code, _, errors = call("python3", os.path.join(tree, "scripts", "broken.py"))
    check(code == 1 and "Traceback" in errors and "nowhere" in errors, errors)


def imported():
    """A program of another folder that imports a script keeps its Python and its signals."""
    text = (
        "import signal, sys; sys.path.insert(0, %r); import startup; "
        "print(sys.prefix, signal.getsignal(signal.SIGPIPE) == signal.SIG_IGN)" % SCRIPTS
    )
    code, output, errors = call("python3", "-c", text)
    check(code == 0 and output.split() == [BARE, "True"], "imported: %s%s" % (output, errors))


if not os.path.exists(os.path.join(ROOT, ".venv", "bin", "python")):
    print("there is no .venv: make venv makes it")
    sys.exit(77)
os.mkdir(os.path.join(TMP, "elsewhere"))
venv.create(BARE, symlinks=True)
for test in (help_of_all, long_output, without_venv, imported):
    test()
finish()
