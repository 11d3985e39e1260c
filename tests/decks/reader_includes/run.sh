#!/usr/bin/env bash
# includes in preprocessors_files.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_files.py" includes
