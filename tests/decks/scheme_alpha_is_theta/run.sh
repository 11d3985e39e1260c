#!/usr/bin/env bash
# alpha_is_theta in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" alpha_is_theta
