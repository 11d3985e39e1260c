#!/usr/bin/env bash
# solvers in invariants.py says what is kept and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/invariants.py" solvers
