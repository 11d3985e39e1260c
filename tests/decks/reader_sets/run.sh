#!/usr/bin/env bash
# sets in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" sets
