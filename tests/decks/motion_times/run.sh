#!/usr/bin/env bash
# motion_times in loads.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/loads.py" motion_times
