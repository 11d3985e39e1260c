#!/usr/bin/env bash
# Field files read by VTK and PyVista: see vtk_tests.py. Skipped where they cannot be had.
cd "$ROOT" || exit 1
if ! VENV=.venv-vtk REQUIREMENTS=requirements-vtk.txt scripts/setup-venv.sh; then
  echo "VTK cannot be installed here: field files were NOT read by it"
  exit 77
fi
exec .venv-vtk/bin/python tests/fields/vtk_tests.py
