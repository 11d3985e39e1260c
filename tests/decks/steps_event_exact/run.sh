#!/usr/bin/env bash
# event_is_exact in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" event_is_exact
