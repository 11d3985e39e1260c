#!/usr/bin/env bash
# finite_ledgers in finite_laws.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/finite_laws.py" finite_ledgers
