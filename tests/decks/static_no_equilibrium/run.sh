#!/usr/bin/env bash
# no_equilibrium in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" no_equilibrium
