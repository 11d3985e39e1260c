#!/bin/sh
# Adds Gmsh and its Python interface (requirements-gmsh.txt) to .venv. Exit code 1 where they cannot
# be had; the last line says why.
set -u
cd "$(dirname "$0")/.." || exit 1
ADD=requirements-gmsh.txt scripts/setup-venv.sh || {
  echo "Gmsh's package cannot be installed here"
  exit 1
}
# The package needs libraries of the system, of which the first that is missing is named.
missing=$(.venv/bin/python -c 'import gmsh' 2>&1) && exit 0
echo "$missing" | grep -q 'cannot open shared object' &&
  echo "On Debian: apt-get install libglu1-mesa libgl1 libxrender1 libxcursor1 libxft2 libxinerama1 libgomp1"
echo "Gmsh's package cannot be loaded here: $(echo "$missing" | tail -n 1)"
exit 1
