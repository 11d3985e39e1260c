#!/usr/bin/env bash
# oblique in scenes_exact.py says what is exact and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/scenes_exact.py" oblique
