#!/usr/bin/env bash
# damaged in fclib_tests.py says what is tested.
exec "$PYTHON" "$ROOT/tests/fclib/fclib_tests.py" damaged
