#!/usr/bin/env bash
# dumps in fclib_tests.py says what is tested.
exec "$PYTHON" "$ROOT/tests/fclib/fclib_tests.py" dumps
