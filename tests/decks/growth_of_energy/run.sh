#!/usr/bin/env bash
# growth_of_energy in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" growth_of_energy
