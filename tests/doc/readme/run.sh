#!/usr/bin/env bash
# The deck of the README runs with friction as shown, its tables are read by the lines shown, and
# its mistake gets the message as shown.
set -euo pipefail
cd "$TMP"
"$ROOT/tests/support/first_deck.sh" > first.k
"$BIPACT" first.k > summary
grep -q 'certificate met' summary
grep -q 'friction    on' first.out/bipact.log
grep -q '^# end: done' first.out/glstat.tab
"$PYTHON" "$ROOT/tests/batch/snippets.py" README.md numpy
sed -i 's/^         1    0.0001/         l    0.0001/' first.k
code=0
"$BIPACT" first.k 2> message || code=$?
[ $code = 2 ]
sed -n '/^    first.k:9,/,/^$/s/^    //p' "$ROOT/README.md" | sed '/^$/d' > expected
diff expected <(head -n 3 message)
