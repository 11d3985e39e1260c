#!/usr/bin/env bash
# mass_on_rod in walls.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/walls.py" mass_on_rod
