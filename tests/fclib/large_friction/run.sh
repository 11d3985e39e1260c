#!/usr/bin/env bash
# large_friction in fclib_tests.py says what is tested.
exec "$PYTHON" "$ROOT/tests/fclib/fclib_tests.py" large_friction
