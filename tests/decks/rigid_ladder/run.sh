#!/usr/bin/env bash
# ladder in rigid.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/rigid.py" ladder
