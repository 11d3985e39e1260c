#!/usr/bin/env bash
# steps in restart_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/restart/restart_tests.py" steps
