#!/usr/bin/env bash
# further in further_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/restart/further_tests.py" further
