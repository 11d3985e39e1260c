#!/usr/bin/env bash
# An independent client of the format reads our decks: see compare.py. Skipped where it cannot be had.
cd "$ROOT" || exit 1
if ! VENV=.venv-pydyna REQUIREMENTS=requirements-pydyna.txt scripts/setup-venv.sh; then
  echo "PyDyna (ansys-dyna-core) cannot be installed here: our decks were NOT read by it"
  exit 77
fi
exec .venv-pydyna/bin/python tests/pydyna/compare.py
