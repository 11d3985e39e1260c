#!/usr/bin/env bash
# flush_tables in contact_geometry.py says what must hold and why the bounds are what they are.
exec "$PYTHON" "$ROOT/tests/decks/contact_geometry.py" flush_tables
