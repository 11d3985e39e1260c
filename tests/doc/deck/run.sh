#!/usr/bin/env bash
# The pages and decks that come from the table of keywords are up to date, and the decks with every
# keyword run and give the same tables from their echoes.
set -euo pipefail
scripts="$ROOT/scripts"
"$scripts/make_doc.sh" "$TMP/deck.md" "$TMP"
diff -u "$ROOT/doc/deck.md" "$TMP/deck.md" || { echo "doc/deck.md is stale: run make doc"; exit 1; }
for deck in every_keyword every_keyword_in_space every_keyword_at_finite_deformation; do
  diff -u "$ROOT/input/cards/$deck.k" "$TMP/$deck.k" \
    || { echo "input/cards/$deck.k is stale: run make doc"; exit 1; }
  (
    cd "$TMP"
    "$BIPACT" $deck.k -o $deck.once --quiet
    "$BIPACT" $deck.once/deck.echo.k -o $deck.again --quiet
    for table in $deck.once/*.tab; do
      [ "${table##*/}" = timing.tab ] || cmp "$table" "$deck.again/${table##*/}"
    done
  )
done
