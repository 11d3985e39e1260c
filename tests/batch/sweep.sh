#!/usr/bin/env bash
# scripts/sweep.py: see sweep_tests.py.
exec "$PYTHON" "$ROOT/tests/batch/sweep_tests.py"
