#!/usr/bin/env bash
# incline in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" incline
