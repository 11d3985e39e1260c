#!/usr/bin/env bash
# paoli_force_does_not_alternate in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" paoli_force_does_not_alternate
