#!/usr/bin/env bash
# open_obstacle in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" open_obstacle
