#!/usr/bin/env bash
# finite_disc in finite.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/finite.py" finite_disc
