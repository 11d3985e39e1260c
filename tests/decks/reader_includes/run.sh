#!/usr/bin/env bash
# includes in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" includes
