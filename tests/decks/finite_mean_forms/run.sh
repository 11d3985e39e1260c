#!/usr/bin/env bash
# finite_mean_forms in finite_newton.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/finite_newton.py" finite_mean_forms
