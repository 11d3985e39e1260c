#!/usr/bin/env bash
# defaults in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" defaults
