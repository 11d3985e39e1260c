#!/bin/sh
# Tests of the Python scripts.  Last line of output: 'N passed, N failed'.
# PYTHON=... chooses the interpreter (default: the project's .venv, else python3); it needs
# numpy and matplotlib.
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd) || exit 1
root=$(dirname -- "$(dirname -- "$here")")
if [ -z "$PYTHON" ]; then
  PYTHON=$root/.venv/bin/python
  [ -x "$PYTHON" ] || PYTHON=python3
fi
exec "$PYTHON" "$here/test_scripts.py" "$@"
