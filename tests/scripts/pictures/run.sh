#!/usr/bin/env bash
# Which exact solution a run has, and what its pictures show: see pictures.py.
exec "$PYTHON" "$ROOT/tests/scripts/pictures/pictures.py"
