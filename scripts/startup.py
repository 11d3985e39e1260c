"""What every script begins with: `import startup`, before it imports numpy and the like.

A script that is started (not one that another program imports)

- goes on with the .venv of this tree, or of this installation, where the Python that started it
  lacks one of the packages of requirements.txt;
- names the package and the remedy where there is no such .venv, instead of a traceback;
- ends silently, as other programs do, when the reader of its output has gone (`| head -1`).

ROOT is the top folder of the tree or of the installation, program() the bipact beside it.
"""

import importlib.util
import os
import re
import shutil
import signal
import sys

SCRIPTS = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.dirname(SCRIPTS)
VENV = os.path.join(ROOT, ".venv")


def program():
    """Path of bipact: that of BIPACT, of the tree, of the installation, or of the PATH."""
    tree = os.path.join(ROOT, "bin", "bipact")
    installed = os.path.join(os.path.dirname(os.path.dirname(ROOT)), "bin", "bipact")
    for path in (os.environ.get("BIPACT"), tree, installed, shutil.which("bipact")):
        if path and os.path.exists(path):
            return path
    return tree


def packages():
    """Names of the packages in requirements.txt."""
    try:
        with open(os.path.join(ROOT, "requirements.txt"), encoding="ascii") as lines:
            names = [re.match(r"[A-Za-z][\w.-]*", line) for line in lines]
    except OSError:
        return []
    return sorted({name.group().lower().replace("-", "_") for name in names if name})


def started():
    """The script that was started, if it is one of ours; else None."""
    path = getattr(sys.modules.get("__main__"), "__file__", None)
    return path if path and os.path.dirname(os.path.realpath(path)) == SCRIPTS else None


def explain(kind, problem, trace):
    """Ends a script that misses a package with the remedy; shows other failures as they are."""
    if kind is not ModuleNotFoundError or problem.name not in packages():
        return sys.__excepthook__(kind, problem, trace)
    print(
        '%s: the Python package "%s" is missing\n    hint: "%s" makes a .venv with it, which '
        "the scripts then find by themselves"
        % (os.path.basename(sys.argv[0]), problem.name, os.path.join(SCRIPTS, "setup-venv.sh")),
        file=sys.stderr,
    )


def prepare(script):
    """Sets up a script that was started; may begin it again with the Python of the .venv."""
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.excepthook = explain
    if os.path.realpath(sys.prefix) == os.path.realpath(VENV):
        return
    python = os.path.join(VENV, "bin", "python")
    if os.access(python, os.X_OK) and not all(map(importlib.util.find_spec, packages())):
        os.execv(python, [python, script] + sys.argv[1:])


if started():
    prepare(started())
