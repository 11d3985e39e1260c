#!/usr/bin/env bash
# awkward in cases.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/cases.py" awkward
