#!/usr/bin/env bash
# parts_without in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" parts_without
