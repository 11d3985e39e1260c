#!/usr/bin/env bash
# way_on in further_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/restart/further_tests.py" way_on
