#!/usr/bin/env bash
# axis_tube in axis.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/axis.py" axis_tube
