#!/usr/bin/env bash
# every_scheme_closes_its_ledger in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" every_scheme_closes_its_ledger
