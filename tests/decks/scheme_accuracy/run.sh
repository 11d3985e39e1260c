#!/usr/bin/env bash
# accuracy_on_impact in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" accuracy_on_impact
