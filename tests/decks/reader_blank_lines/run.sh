#!/usr/bin/env bash
# blank_lines in preprocessors_files.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_files.py" blank_lines
