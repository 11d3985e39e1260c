#!/usr/bin/env bash
# held_bodies in loads.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/loads.py" held_bodies
