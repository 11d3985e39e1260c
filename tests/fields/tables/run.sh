#!/usr/bin/env bash
# tables in fields_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/fields/fields_tests.py" tables
