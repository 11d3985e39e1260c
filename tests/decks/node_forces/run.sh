#!/usr/bin/env bash
# node_forces in loads.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/loads.py" node_forces
