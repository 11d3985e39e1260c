#!/usr/bin/env bash
# bullet in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" bullet
