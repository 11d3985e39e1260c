#!/usr/bin/env bash
# whole_reals in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" whole_reals
