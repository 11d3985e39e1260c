#!/usr/bin/env bash
# exact_dispersion in cases.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/cases.py" exact_dispersion
