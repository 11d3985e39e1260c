#!/usr/bin/env bash
# wall_figures in invariants.py says what is kept and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/invariants.py" wall_figures
