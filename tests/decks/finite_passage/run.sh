#!/usr/bin/env bash
# finite_passage in finite_runs.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/finite_runs.py" finite_passage
