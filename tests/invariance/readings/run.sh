#!/usr/bin/env bash
# See invariance.py: readings.
exec "$PYTHON" "$ROOT/tests/invariance/invariance.py" readings
