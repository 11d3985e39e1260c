#!/usr/bin/env bash
# make install, the documented commands, make uninstall: see install_tests.py.
exec "$PYTHON" "$ROOT/tests/batch/install_tests.py"
