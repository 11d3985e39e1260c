#!/usr/bin/env bash
# parameters in preprocessors_parameters.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_parameters.py" parameters
