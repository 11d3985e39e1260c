#!/usr/bin/env bash
# space_incline in space_walls.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/space_walls.py" space_incline
