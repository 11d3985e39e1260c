#!/usr/bin/env bash
# 150 random forms of the plain scene: see random_forms.py. Any number: random_forms.py COUNT SEED.
exec "$PYTHON" "$ROOT/tests/decks/random_forms.py"
