#!/usr/bin/env bash
# space_hertz in space_hertz.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/space_hertz.py" space_hertz
