#!/usr/bin/env bash
# titles in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" titles
