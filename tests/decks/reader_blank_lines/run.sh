#!/usr/bin/env bash
# blank_lines in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" blank_lines
