#!/usr/bin/env bash
# stacked_blocks in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" stacked_blocks
