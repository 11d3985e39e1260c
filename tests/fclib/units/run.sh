#!/usr/bin/env bash
# units in fclib_tests.py says what is tested.
exec "$PYTHON" "$ROOT/tests/fclib/fclib_tests.py" units
