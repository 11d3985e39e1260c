#!/usr/bin/env bash
# supported in preprocessors_motion.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/preprocessors_motion.py" supported
