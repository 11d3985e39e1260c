#!/usr/bin/env bash
# smooth_order in cases.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/cases.py" smooth_order
