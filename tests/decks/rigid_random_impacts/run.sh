#!/usr/bin/env bash
# random_impacts in rigid.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/rigid.py" random_impacts
