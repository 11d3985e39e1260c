#!/usr/bin/env bash
# flight in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" flight
