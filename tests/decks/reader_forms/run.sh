#!/usr/bin/env bash
# forms in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" forms
