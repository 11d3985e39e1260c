#!/usr/bin/env bash
# doc/deck.md is what the program would write now.
set -e
cd "$ROOT"
scripts/make_doc.sh "$TMP/deck.md"
diff -u doc/deck.md "$TMP/deck.md" || { echo "doc/deck.md is stale: run make doc"; exit 1; }
