#!/usr/bin/env bash
# Meshes of solids become decks that run: see solid_tests.py.
exec "$PYTHON" "$ROOT/tests/meshes/solid_tests.py"
