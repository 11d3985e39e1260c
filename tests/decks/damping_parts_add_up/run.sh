#!/usr/bin/env bash
# parts_add_up in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" parts_add_up
