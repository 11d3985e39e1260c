#!/usr/bin/env bash
# See invariance.py: units.
exec "$PYTHON" "$ROOT/tests/invariance/invariance.py" units
