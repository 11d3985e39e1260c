#!/usr/bin/env bash
# deformed_edge in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" deformed_edge
