#!/usr/bin/env bash
# catalogue.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/catalogue.py"
