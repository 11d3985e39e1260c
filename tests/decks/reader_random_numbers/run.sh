#!/usr/bin/env bash
# random_numbers in expressions.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/expressions.py" random_numbers
