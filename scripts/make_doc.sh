#!/usr/bin/env bash
# Makes doc/deck.md from the table of keywords in the program: make_doc.sh [FILE]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-doc/deck.md}
{
  cat scripts/deck_head.md
  "${BIPACT:-bin/bipact}" --keywords
} > "$out"
