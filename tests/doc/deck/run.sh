#!/usr/bin/env bash
# The pages and decks that come from the table of keywords are up to date, and the deck with every
# keyword runs and gives the same tables from its echo.
set -euo pipefail
scripts="$ROOT/scripts"
"$scripts/make_doc.sh" "$TMP/deck.md" "$TMP/every_keyword.k"
diff -u "$ROOT/doc/deck.md" "$TMP/deck.md" || { echo "doc/deck.md is stale: run make doc"; exit 1; }
diff -u "$ROOT/input/cards/every_keyword.k" "$TMP/every_keyword.k" \
  || { echo "input/cards/every_keyword.k is stale: run make doc"; exit 1; }
cd "$TMP"
"$BIPACT" every_keyword.k -o once --quiet
"$BIPACT" once/deck.echo.k -o again --quiet
for table in once/*.tab; do
  [ "${table#once/}" = timing.tab ] || cmp "$table" "again/${table#once/}"
done
