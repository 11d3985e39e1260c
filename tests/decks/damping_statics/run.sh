#!/usr/bin/env bash
# statics in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" statics
