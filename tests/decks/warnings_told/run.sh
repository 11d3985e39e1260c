#!/usr/bin/env bash
# told in screen.py says what is shown, and where.
exec "$PYTHON" "$ROOT/tests/decks/screen.py" told
