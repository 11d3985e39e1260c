#!/usr/bin/env bash
# Mesh files of every format but Gmsh's become decks: see format_tests.py.
exec "$PYTHON" "$ROOT/tests/meshes/format_tests.py"
