#!/usr/bin/env bash
# effects in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" effects
