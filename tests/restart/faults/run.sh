#!/usr/bin/env bash
# faults in restart_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/restart/restart_tests.py" faults
