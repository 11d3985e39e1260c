#!/usr/bin/env bash
# rigid_bowl in walls.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/walls.py" rigid_bowl
