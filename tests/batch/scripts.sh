#!/usr/bin/env bash
# All scripts, started as documented: see scripts_tests.py.
exec "$PYTHON" "$ROOT/tests/batch/scripts_tests.py"
