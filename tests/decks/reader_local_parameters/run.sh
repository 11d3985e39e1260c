#!/usr/bin/env bash
# local_parameters in preprocessors.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors.py" local_parameters
