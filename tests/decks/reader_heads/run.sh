#!/usr/bin/env bash
# heads in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" heads
