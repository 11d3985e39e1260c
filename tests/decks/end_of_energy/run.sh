#!/usr/bin/env bash
# end_of_energy in loads.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/loads.py" end_of_energy
