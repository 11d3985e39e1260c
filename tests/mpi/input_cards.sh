#!/usr/bin/env bash
# input_cards in ranks_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/mpi/ranks_tests.py" input_cards
