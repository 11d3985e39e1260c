#!/usr/bin/env bash
# restart in press_fit.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/press_fit.py" restart
