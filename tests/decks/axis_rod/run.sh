#!/usr/bin/env bash
# axis_rod in axis_finite.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/axis_finite.py" axis_rod
