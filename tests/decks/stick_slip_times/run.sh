#!/usr/bin/env bash
# times in stick_slip.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/stick_slip.py" times
