#!/usr/bin/env bash
# oblique in rigid.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/rigid.py" oblique
