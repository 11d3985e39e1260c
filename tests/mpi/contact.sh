#!/usr/bin/env bash
# contact in ranks_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/mpi/ranks_tests.py" contact
