#!/usr/bin/env bash
# static_bar in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" static_bar
