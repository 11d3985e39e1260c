#!/usr/bin/env bash
# Makes doc/deck.md and the decks of input/cards from the table of keywords in the program:
# make_doc.sh [PAGE FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
page=${1:-doc/deck.md}
folder=${2:-input/cards}
program=${BIPACT:-bin/bipact}
{
  cat scripts/deck_head.md
  "$program" --keywords
} > "$page"
"${PYTHON:-python3}" scripts/make_cards.py --bin "$program" -o "$folder/every_keyword.k"
"${PYTHON:-python3}" scripts/make_cards.py --bin "$program" --space -o "$folder/every_keyword_in_space.k"
"${PYTHON:-python3}" scripts/make_cards.py --bin "$program" --finite -o "$folder/every_keyword_at_finite_deformation.k"
