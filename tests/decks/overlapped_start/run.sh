#!/usr/bin/env bash
# overlapped_start in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" overlapped_start
