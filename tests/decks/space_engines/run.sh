#!/usr/bin/env bash
# space_engines in space.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/space.py" space_engines
