#!/bin/sh
# Geometry of contact by the second implementation.  Last line: 'N passed, N failed'.
# PYTHON=... chooses the interpreter (default: the project's .venv, else python3); it needs numpy.
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd) || exit 1
root=$(dirname -- "$(dirname -- "$here")")
if [ -z "$PYTHON" ]; then
  PYTHON=$root/.venv/bin/python
  [ -x "$PYTHON" ] || PYTHON=python3
fi
exec "$PYTHON" "$here/test_geometry.py" "$@"
