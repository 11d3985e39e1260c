#!/usr/bin/env bash
# sets in preprocessors_sets.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_sets.py" sets
