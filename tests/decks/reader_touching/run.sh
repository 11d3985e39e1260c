#!/usr/bin/env bash
# touching in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" touching
