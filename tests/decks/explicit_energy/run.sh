#!/usr/bin/env bash
# energy in explicit.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/explicit.py" energy
