#!/usr/bin/env bash
# random_scenes_close_their_ledger in schemes.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/schemes.py" random_scenes_close_their_ledger
