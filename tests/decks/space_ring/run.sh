#!/usr/bin/env bash
# space_ring in space_walls.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/space_walls.py" space_ring
