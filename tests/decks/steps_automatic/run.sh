#!/usr/bin/env bash
# automatic_is_halve in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" automatic_is_halve
