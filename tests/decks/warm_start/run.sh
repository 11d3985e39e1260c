#!/usr/bin/env bash
# warm_start in invariants.py says what is kept and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/invariants.py" warm_start
