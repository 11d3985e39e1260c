#!/usr/bin/env bash
# damped in explicit.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/explicit.py" damped
