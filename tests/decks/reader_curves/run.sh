#!/usr/bin/env bash
# curves in preprocessors_motion.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_motion.py" curves
