#!/usr/bin/env bash
# Files of Gmsh become decks; the commands of doc/meshes.md lead from a geometry to a picture:
# see gmsh_tests.py. Skipped where Gmsh's package cannot be had.
cd "$ROOT" || exit 1
cmp -s requirements.txt .venv/installed-requirements.txt ||
  { echo ".venv is not that of requirements.txt: make venv"; exit 1; }
why=$(scripts/setup-gmsh.sh) || {
  echo "$why"
  echo "${why##*$'\n'}: .msh files were NOT read, the commands of doc/meshes.md were NOT run"
  exit 77
}
exec .venv/bin/python tests/meshes/gmsh_tests.py
