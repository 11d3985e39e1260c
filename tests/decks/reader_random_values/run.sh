#!/usr/bin/env bash
# random_values in expressions.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/expressions.py" random_values
