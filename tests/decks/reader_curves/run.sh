#!/usr/bin/env bash
# curves in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" curves
