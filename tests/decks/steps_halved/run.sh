#!/usr/bin/env bash
# halved_where_refused in steps.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/steps.py" halved_where_refused
