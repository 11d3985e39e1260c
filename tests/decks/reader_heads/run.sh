#!/usr/bin/env bash
# heads in preprocessors_names.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_names.py" heads
