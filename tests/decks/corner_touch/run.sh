#!/usr/bin/env bash
# corner_touch in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" corner_touch
