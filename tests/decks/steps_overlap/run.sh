#!/usr/bin/env bash
# overlap_is_halved in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" overlap_is_halved
