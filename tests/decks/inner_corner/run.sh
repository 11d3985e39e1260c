#!/usr/bin/env bash
# inner_corner in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" inner_corner
