#!/usr/bin/env bash
# pressed_flats in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" pressed_flats
