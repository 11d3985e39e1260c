#!/usr/bin/env bash
# sober in screen.py says what is shown, and where.
exec "$PYTHON" "$ROOT/tests/decks/screen.py" sober
