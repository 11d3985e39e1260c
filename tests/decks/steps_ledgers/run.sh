#!/usr/bin/env bash
# every_scheme in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" every_scheme
