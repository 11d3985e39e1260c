#!/usr/bin/env bash
# terminal in screen.py says what is shown, and where.
exec "$PYTHON" "$ROOT/tests/decks/screen.py" terminal
