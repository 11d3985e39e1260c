#!/usr/bin/env bash
# zero_gap in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" zero_gap
