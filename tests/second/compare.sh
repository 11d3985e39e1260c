#!/bin/sh
# Scenes by bipact and by the second implementation.  Last line: 'N passed, N failed'.
# compare.sh [SCENE...]: without numbers those below, a minute; compare.py alone takes them all.
# PYTHON=... chooses the interpreter (default: the project's .venv, else python3); it needs numpy.
# BIPACT=... chooses the program.
here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd) || exit 1
root=$(dirname -- "$(dirname -- "$here")")
if [ -z "$PYTHON" ]; then
  PYTHON=$root/.venv/bin/python
  [ -x "$PYTHON" ] || PYTHON=python3
fi
export BIPACT="${BIPACT:-$root/bin/bipact}"
export OPENBLAS_NUM_THREADS=1 # the matrices are small
if [ $# -eq 0 ]; then
  set -- 1 2 3 4 6 8 9 10 12 14 15 18 20 21 22 23 25 26 27 29 31 32 33 34 35 36 38 39 41 43 \
    45 46 47 48 49 50 51 52 53 54 57 58 60 62 65 66 67 68 69 70 71 73
fi
exec "$PYTHON" "$here/compare.py" "$@"
