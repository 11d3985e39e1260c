#!/usr/bin/env bash
# contact_storage.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_storage.py"
