#!/usr/bin/env bash
# Every faulty deck gives its message, to the letter, and writes nothing.
exec "$PYTHON" "$ROOT/tests/bad_decks/faults.py" "$@"
