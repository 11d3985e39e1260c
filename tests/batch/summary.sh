#!/usr/bin/env bash
# summary.json: see summary_tests.py.
exec "$PYTHON" "$ROOT/tests/batch/summary_tests.py"
