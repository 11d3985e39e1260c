#!/usr/bin/env bash
# shared in fclib_tests.py says what is tested.
export FCLIB=${FCLIB:-$ROOT/../shared/fclib}    # published problems, where somebody has put them
exec "$PYTHON" "$ROOT/tests/fclib/fclib_tests.py" shared
