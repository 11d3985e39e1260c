#!/usr/bin/env bash
# Field files read by the VTK before the current one.
exec "$ROOT/tests/fields/with_vtk" .venv-vtk-before requirements-vtk-before.txt
