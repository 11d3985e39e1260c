#!/usr/bin/env bash
# axis_taylor_implicit in taylor.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/taylor.py" axis_taylor_implicit
