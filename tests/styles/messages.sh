#!/usr/bin/env bash
# Decks in the handwriting of several programs: what is said of each (styles.py).
exec "$PYTHON" "$ROOT/tests/styles/styles.py"
