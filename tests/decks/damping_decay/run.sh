#!/usr/bin/env bash
# decay in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" decay
