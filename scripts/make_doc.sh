#!/usr/bin/env bash
# Makes doc/deck.md and input/cards/every_keyword.k from the table of keywords in the program:
# make_doc.sh [PAGE DECK]
set -euo pipefail
cd "$(dirname "$0")/.."
page=${1:-doc/deck.md}
deck=${2:-input/cards/every_keyword.k}
program=${BIPACT:-bin/bipact}
{
  cat scripts/deck_head.md
  "$program" --keywords
} > "$page"
"${PYTHON:-python3}" scripts/make_cards.py --bin "$program" -o "$deck"
