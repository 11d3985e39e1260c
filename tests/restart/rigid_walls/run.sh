#!/usr/bin/env bash
# rigid_walls in restart_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/restart/restart_tests.py" rigid_walls
