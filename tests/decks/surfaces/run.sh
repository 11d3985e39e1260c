#!/usr/bin/env bash
# surfaces in loads.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/loads.py" surfaces
