#!/usr/bin/env bash
# threads in threads.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/threads.py" threads
