#!/usr/bin/env bash
# ledgers in damping.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/decks/damping.py" ledgers
