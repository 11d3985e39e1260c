#!/usr/bin/env bash
# no_time_card in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" no_time_card
