#!/usr/bin/env bash
# Field files read by the current VTK.
exec "$ROOT/tests/fields/with_vtk" .venv-vtk requirements-vtk.txt
