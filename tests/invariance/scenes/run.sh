#!/usr/bin/env bash
# placements in scenes_exact.py: walls, friction, several pairs, triangles.
exec "$PYTHON" "$ROOT/tests/decks/scenes_exact.py" placements
