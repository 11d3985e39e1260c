#!/usr/bin/env bash
# supported in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" supported
