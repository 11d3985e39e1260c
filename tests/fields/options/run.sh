#!/usr/bin/env bash
# options in fields_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/fields/fields_tests.py" options
