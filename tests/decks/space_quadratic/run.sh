#!/usr/bin/env bash
# space_quadratic in space_contact.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/space_contact.py" space_quadratic
