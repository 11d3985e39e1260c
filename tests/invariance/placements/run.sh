#!/usr/bin/env bash
# See invariance.py: placements.
exec "$PYTHON" "$ROOT/tests/invariance/invariance.py" placements
