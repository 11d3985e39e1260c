#!/usr/bin/env bash
# full_disk in fields_tests.py says what must hold and why.
exec "$PYTHON" "$ROOT/tests/fields/fields_tests.py" full_disk
