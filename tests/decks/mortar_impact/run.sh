#!/usr/bin/env bash
# impact in mortar.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/mortar.py" impact
