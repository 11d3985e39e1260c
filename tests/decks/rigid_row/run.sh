#!/usr/bin/env bash
# row in rigid.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/rigid.py" row
