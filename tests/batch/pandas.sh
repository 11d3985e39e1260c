#!/usr/bin/env bash
# The lines of doc/output.md that read a table with pandas: see snippets.py. Skipped where pandas
# cannot be had.
set -euo pipefail
cd "$ROOT"
if ! VENV=.venv-pandas REQUIREMENTS=requirements-pandas.txt scripts/setup-venv.sh; then
  echo "pandas cannot be installed here: tables were NOT read by it"
  exit 77
fi
cd "$TMP"
"$ROOT/tests/support/first_deck.sh" >first.k
"$BIPACT" first.k --quiet
exec "$ROOT/.venv-pandas/bin/python" "$ROOT/tests/batch/snippets.py" doc/output.md pandas
