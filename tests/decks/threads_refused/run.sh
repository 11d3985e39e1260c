#!/usr/bin/env bash
# threads_refused in threads.py says what must hold.
exec "$PYTHON" "$ROOT/tests/decks/threads.py" threads_refused
