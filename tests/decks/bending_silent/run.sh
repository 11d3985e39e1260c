#!/usr/bin/env bash
# silent in bending.py says what must be told, and where the bounds come from.
exec "$PYTHON" "$ROOT/tests/decks/bending.py" silent
