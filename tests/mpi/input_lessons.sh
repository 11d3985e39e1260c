#!/usr/bin/env bash
# input_lessons in ranks_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/mpi/ranks_tests.py" input_lessons
