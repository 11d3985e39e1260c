#!/usr/bin/env bash
# node_card in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" node_card
