#!/usr/bin/env bash
# The lines of README.md that read a table with numpy: see snippets.py.
set -euo pipefail
cd "$TMP"
sed -n '/^    \*KEYWORD/,/^    \*END/s/^    //p' "$ROOT/README.md" >first.k
"$BIPACT" first.k --quiet
exec "$PYTHON" "$ROOT/tests/batch/snippets.py" README.md numpy
