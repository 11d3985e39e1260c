#!/usr/bin/env bash
# parameters in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" parameters
