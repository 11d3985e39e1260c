#!/usr/bin/env bash
# local_parameters in preprocessors_parameters.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_parameters.py" local_parameters
