#!/usr/bin/env bash
# rows_and_loads in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" rows_and_loads
