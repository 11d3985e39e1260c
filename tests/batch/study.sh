#!/usr/bin/env bash
# scripts/study.py: see study_tests.py.
exec "$PYTHON" "$ROOT/tests/batch/study_tests.py"
