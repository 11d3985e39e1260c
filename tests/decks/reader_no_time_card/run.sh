#!/usr/bin/env bash
# no_time_card in preprocessors_motion.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_motion.py" no_time_card
